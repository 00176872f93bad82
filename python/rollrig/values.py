"""Numbers and arrays that know their unit."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np


class Value(float):
    """A number with its unit. It is a float, so that it goes wherever a float goes.

    `name` is its key in the JSON, `label` the same in words, `unit` its symbol ("" for ratios), `doc` what it means.
    """

    name: str
    label: str
    unit: str
    doc: str

    def __new__(cls, number: float, unit: str = "", name: str = "", label: str = "", doc: str = "") -> Value:
        made = super().__new__(cls, number)
        made.unit, made.name, made.label, made.doc = unit, name, label, doc
        return made

    def __repr__(self) -> str:
        return f"{float(self)!r} {self.unit}".rstrip()

    __str__ = __repr__

    def __format__(self, spec: str) -> str:
        return format(float(self), spec) if spec else str(self)

    def __reduce__(self) -> tuple[type[Value], tuple[object, ...]]:
        return (type(self), (float(self), self.unit, self.name, self.label, self.doc))


class Channel(np.ndarray[Any, np.dtype[np.float64]]):
    """A NumPy array with `name` and `unit`. A slice keeps both; what is computed from it is a plain array."""

    name: str
    unit: str

    def __new__(cls, values: Any, unit: str = "", name: str = "") -> Channel:
        made = np.asarray(values).view(cls)
        made.unit, made.name = unit, name
        return made

    def __array_finalize__(self, source: Any) -> None:
        self.unit = getattr(source, "unit", "")
        self.name = getattr(source, "name", "")

    def __array_wrap__(self, computed: Any, context: Any = None, return_scalar: bool = False) -> Any:
        plain = np.asarray(computed)
        return plain[()] if plain.ndim == 0 else plain

    def __repr__(self) -> str:
        return f"{self.name} [{self.unit or '-'}] {np.asarray(self)!r}"


class Estimate(NamedTuple):
    """A fitted number with its standard uncertainty and its interval of 95 %."""

    name: str
    value: float
    sd: float
    low_95: float
    high_95: float
    unit: str


def to_channels(listed: list[tuple[str, str, Any]]) -> dict[str, Channel]:
    return {name: Channel(values, unit, name) for name, unit, values in listed}


def to_data_frame(columns: dict[str, Any], units: dict[str, str], index: str | None = None) -> Any:
    """A pandas.DataFrame; its attrs["units"] has the unit of each column."""
    import pandas

    frame = pandas.DataFrame({name: np.asarray(values) for name, values in columns.items()})
    if index is not None:
        frame = frame.set_index(index)
    frame.attrs["units"] = units
    return frame
