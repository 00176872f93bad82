"""Keyword arguments as the settings and names that the library reads."""

from __future__ import annotations

import operator
import os
from collections.abc import Iterable, Iterator, Mapping
from typing import Any, Union

from .errors import InputError

PathLike = Union[str, bytes, "os.PathLike[Any]"]


def to_path(value: Any, argument: str) -> bytes:
    """A path, or text, as the library takes it. A name of a file that is not UTF-8 keeps its bytes."""
    try:
        return to_bytes(os.fspath(value), argument)
    except TypeError:
        raise TypeError(f"argument '{argument}': a path is expected, not {value!r}") from None


def to_bytes(text: str | bytes, argument: str) -> bytes:
    if isinstance(text, bytes):
        return text
    try:
        return text.encode("utf-8", "surrogateescape")
    except UnicodeEncodeError:
        what = f"argument '{argument}' holds half of a character"
        raise InputError(what, key=argument, value=ascii(text), allowed="text in Unicode") from None


def to_paths(values: Any, argument: str) -> list[bytes]:
    if isinstance(values, (str, bytes, os.PathLike)) or not isinstance(values, Iterable):
        raise TypeError(f"argument '{argument}': a list of paths is expected, not {values!r}")
    return [to_path(value, argument) for value in values]


def to_list(values: Any, argument: str) -> list[Any]:
    """What is repeated on the command line. One text stands for a list of it."""
    if isinstance(values, (str, bytes)):
        return [values]
    if not isinstance(values, Iterable):
        raise TypeError(f"argument '{argument}': a list is expected, not {values!r}")
    return [*values]


def to_flag(value: Any, argument: str) -> bool:
    if isinstance(value, (bool, int)) or type(value).__name__ == "bool_":  # the last is NumPy's
        if value in (False, True):
            return bool(value)
    raise TypeError(f"argument '{argument}': True or False is expected, not {value!r}")


def to_skip(skip_bad_rows: Any) -> bool:
    return to_flag(skip_bad_rows, "skip_bad_rows")


def to_count(value: Any, argument: str) -> int:
    try:
        return operator.index(value)
    except TypeError:
        raise TypeError(f"argument '{argument}': a whole number is expected, not {value!r}") from None


def to_text(value: Any) -> str:
    """A value as it stands after "key=". Numbers keep every bit."""
    if hasattr(value, "tolist"):  # of NumPy
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, Mapping):
        return "{}"  # an empty one: an effect without numbers, or a wrong name
    if isinstance(value, float):
        return float.__repr__(value)
    if isinstance(value, (str, bytes, os.PathLike)):
        return os.fsdecode(value)
    if isinstance(value, Iterable):
        return "[" + ",".join(_to_element(each) for each in value) + "]"
    return str(value)


def _to_element(value: Any) -> str:
    return '"' + value.replace("\\", "\\\\").replace('"', '\\"') + '"' if isinstance(value, str) else to_text(value)


def list_settings(settings: Mapping[str, Any], prefix: str = "") -> Iterator[str]:
    """Each as "key=value". A mapping stands for keys with a dot: effects={"bearing_warmup": {"fall_per_K": 0.02}}."""
    for key, value in settings.items():
        if isinstance(value, Mapping) and value:
            yield from list_settings(value, f"{prefix}{key}.")
        elif value is not None:
            yield f"{prefix}{key}={to_text(value)}"


def to_names(names: str | Iterable[str], argument: str) -> list[str]:
    """A list of names; of one text those between its commas, as on the command line."""
    return [name.strip() for name in names.split(",")] if isinstance(names, str) else to_list(names, argument)


def take_given(arguments: Mapping[str, Any]) -> dict[str, Any]:
    """The arguments that are not None; for the others the library uses its defaults. Mappings become dicts."""
    return {key: _to_plain(value) for key, value in arguments.items() if value is not None}


def _to_plain(value: Any) -> Any:
    return dict(value) if isinstance(value, Mapping) else value


def make_uncertainty_options(uncertainty: bool, monte_carlo: int, threads: int = 0) -> dict[str, Any]:
    return {"uncertainty": uncertainty, "monte_carlo": monte_carlo, "threads": threads}


def make_run_input(scenario: PathLike, names: Mapping[str, Any],
                   settings: Mapping[str, Any]) -> dict[str, Any]:
    given = {key: to_text(value) for key, value in names.items() if value is not None}
    return {**given, "scenario": scenario, "settings": list(list_settings(settings))}
