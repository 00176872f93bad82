"""Arrays that know their unit, and tables of them. Imported where they are asked for: a number needs no NumPy."""

from __future__ import annotations

from typing import Any

import numpy as np


class Channel(np.ndarray[Any, np.dtype[np.float64]]):
    """A NumPy array with `name` and `unit`. A slice or a copy keeps both. Arithmetic and NumPy's ufuncs give a plain array;
    some other functions, such as np.gradient(), keep the unit although it no longer applies.

    Channels of results cannot be changed; copy() of one can.
    """

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

    def __reduce__(self) -> tuple[Any, ...]:
        return (_unpickle_channel, (np.array(self), self.unit, self.name, self.flags.writeable))

    def __deepcopy__(self, memo: Any) -> Channel:
        return Channel(np.array(self), self.unit, self.name)

    def __repr__(self) -> str:
        return f"{self.name} [{self.unit or '-'}] {np.asarray(self)!r}"


def _unpickle_channel(values: Any, unit: str, name: str, is_writeable: bool) -> Channel:
    values.flags.writeable = is_writeable
    return Channel(values, unit, name)


def freeze(values: Any) -> Any:
    """Makes an array of a result read-only. All callers get the same array, so that none may change it."""
    values.flags.writeable = False
    return values


def to_channels(listed: list[tuple[str, str, Any]]) -> dict[str, Channel]:
    return {name: Channel(freeze(values), unit, name) for name, unit, values in listed}


def to_data_frame(columns: dict[str, Any], units: dict[str, str], index: str | None = None) -> Any:
    """A pandas.DataFrame; its attrs["units"] has the unit of each column."""
    import pandas

    frame = pandas.DataFrame({name: np.asarray(values) for name, values in columns.items()})
    if index is not None:
        frame = frame.set_index(index)
    frame.attrs["units"] = units
    return frame
