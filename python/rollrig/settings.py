"""Keyword arguments as the settings and names that the library reads."""

from __future__ import annotations

import decimal
import numbers
import operator
import os
import re
from collections.abc import Iterable, Iterator, Mapping
from typing import Any, Union

from .errors import InputError

PathLike = Union[str, bytes, "os.PathLike[Any]"]


def show(value: Any) -> str:
    """A value as messages show it: its repr, or the start of a long one."""
    try:
        shown = repr(value)
    except Exception:  # such as a whole number with more digits than Python writes
        return f"a value of type {type(value).__name__}"
    return shown if len(shown) <= 200 else shown[:200] + "..."


def wrong_type(argument: str, expected: str, value: Any) -> TypeError:
    """The same words as in python/bindings/text.cpp."""
    return TypeError(f"argument '{argument}': {expected}, not {show(value)}")


def to_path(value: Any, argument: str) -> bytes:
    """A path, or text, as the library takes it. A name of a file that is not UTF-8 keeps its bytes."""
    try:
        given = os.fspath(value)
    except TypeError:
        raise wrong_type(argument, "a path is expected", value) from None
    encoded = to_bytes(given, argument)
    if b"\0" in encoded:
        what = f"argument '{argument}' has a NUL character"
        raise InputError(what, key=argument, value=show(value), allowed="text without one")
    return encoded


def to_bytes(text: str | bytes, argument: str) -> bytes:
    if isinstance(text, bytes):
        return text
    try:
        return text.encode("utf-8", "surrogateescape")
    except UnicodeEncodeError:
        what = f"argument '{argument}' has a lone surrogate"
        raise InputError(what, key=argument, value=show(text), allowed="text in Unicode") from None


def to_optional_path(value: Any, argument: str) -> bytes | None:
    return None if value is None else to_path(value, argument)


def to_paths(values: Any, argument: str) -> list[bytes]:
    if isinstance(values, (str, bytes, os.PathLike)) or not isinstance(values, Iterable):
        raise wrong_type(argument, "a list of paths is expected", values)
    return [to_path(value, argument) for value in values]


def to_list(values: Any, argument: str) -> list[Any]:
    """What is repeated on the command line. One text stands for a list of it."""
    if isinstance(values, (str, bytes)):
        return [values]
    if not isinstance(values, Iterable):
        raise wrong_type(argument, "a list is expected", values)
    return [*values]


def is_bool(value: Any) -> bool:
    """Whether it is a bool of Python or NumPy."""
    of = type(value)
    return isinstance(value, bool) or (of.__module__ == "numpy" and of.__name__ in ("bool_", "bool"))  # NumPy 1 and 2


def to_flag(value: Any, argument: str) -> bool:
    if is_bool(value):
        return bool(value)
    raise wrong_type(argument, "True or False is expected", value)


def to_skip(skip_bad_rows: Any) -> bool:
    return to_flag(skip_bad_rows, "skip_bad_rows")


def to_count(value: Any, argument: str) -> str:
    """A whole number of any size."""
    try:
        if not is_bool(value):
            return write_whole_number(operator.index(value), argument)
    except TypeError:
        pass
    raise wrong_type(argument, "a whole number is expected", value)


def write_whole_number(value: int, argument: str) -> str:
    try:
        return str(value)
    except ValueError:  # it has more digits than Python writes
        what = f"argument '{argument}' is out of range"
        raise InputError(what, key=argument, value=show(value), allowed="a number with fewer digits") from None


def to_load_index(value: Any, argument: str) -> str | bytes | None:
    """91 is "91"."""
    return value if value is None or isinstance(value, (str, bytes)) else to_count(value, argument)


def to_text(value: Any, argument: str) -> str:
    """A value as it stands after "key=". Numbers keep every bit."""
    if hasattr(value, "tolist"):  # of NumPy
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, Mapping) and not value:
        return "{}"  # an effect without numbers, or a wrong name
    if isinstance(value, float):
        return float.__repr__(value)
    if isinstance(value, int):
        return write_whole_number(value, argument)
    if isinstance(value, (str, bytes, os.PathLike)):
        return os.fsdecode(value)
    if isinstance(value, Iterable) and not isinstance(value, Mapping):
        return "[" + ",".join(_to_element(each, argument) for each in value) + "]"
    if isinstance(value, decimal.Decimal):
        return str(value)
    if isinstance(value, numbers.Real):  # such as a fraction
        return float.__repr__(float(value))
    raise wrong_type(argument, "a number, a text or a list is expected", value)


def _to_element(value: Any, argument: str) -> str:
    if isinstance(value, str):
        return '"' + value.replace("\\", "\\\\").replace('"', '\\"') + '"'
    return to_text(value, argument)


def list_settings(settings: Mapping[str, Any], prefix: str = "") -> Iterator[str]:
    """Each as "key=value". A mapping stands for keys with a dot: effects={"bearing_warmup": {"fall_per_K": 0.02}}."""
    for key, value in settings.items():
        if not isinstance(key, str):
            raise wrong_type(prefix[:-1], "a dict with texts as keys is expected", settings)
        if not re.fullmatch(r"[\w.\-]+", key):
            what = f"{prefix + key!r} is no key of a setting"
            raise InputError(what, what, key=prefix + key, allowed="letters, digits, '_', '-' and '.'")
        if isinstance(value, Mapping) and value:
            yield from list_settings(value, f"{prefix}{key}.")
        elif value is not None:
            yield f"{prefix}{key}={to_text(value, prefix + key)}"


def to_names(names: str | Iterable[str], argument: str) -> list[str]:
    """A list of names; of one text those between its commas, as on the command line."""
    return [name.strip() for name in names.split(",")] if isinstance(names, str) else to_list(names, argument)


def to_plain(value: Any) -> Any:
    """A mapping as a dict."""
    return dict(value) if isinstance(value, Mapping) else value


def take_given(arguments: Mapping[str, Any]) -> dict[str, Any]:
    """The arguments that are not None; for the others the library uses its defaults. Mappings become dicts."""
    return {key: to_plain(value) for key, value in arguments.items() if value is not None}


def make_uncertainty_options(uncertainty: bool, monte_carlo: int, seed: int, threads: int) -> dict[str, Any]:
    return {"uncertainty": uncertainty, "monte_carlo": monte_carlo, "seed": seed, "threads": threads}


def make_run_input(scenario: PathLike, names: Mapping[str, Any],
                   settings: Mapping[str, Any]) -> dict[str, Any]:
    given = {key: to_count(value, key) if key == "seed" else value for key, value in names.items() if value is not None}
    return {**given, "scenario": scenario, "settings": list(list_settings(settings))}
