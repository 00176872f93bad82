"""Numbers that know their unit."""

from __future__ import annotations

from typing import NamedTuple


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


class Estimate(NamedTuple):
    """A fitted number with its standard uncertainty and its interval of 95 %."""

    name: str
    value: float
    sd: float
    low_95: float
    high_95: float
    unit: str
