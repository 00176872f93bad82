"""Keyword arguments as the settings and names that the library reads."""

from __future__ import annotations

import decimal
import json
import math
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


def input_error(what: str, key: str, value: str, allowed: str, nearest: str = "") -> InputError:
    """With a message like those of the library."""
    shown = [("key", key), ("value", value), ("allowed", allowed), ("nearest", nearest)]
    message = what + "".join(f"\n  {label:<8} {content}" for label, content in shown if content)
    return InputError(message, what, key=key, value=value, allowed=allowed, nearest=nearest)


PATHS = frozenset(["alignment", "file", "folder", "highway_cycle", "list", "reference_values", "rig", "scenario",
                   "sensors", "set", "tir", "tire", "urban_cycle", "vehicle"])
"""Arguments that are paths, or names that stand for files."""


def to_path(value: Any, argument: str) -> bytes:
    """A path, or text, as the library takes it. A name of a file that is not UTF-8 keeps its bytes."""
    try:
        given = os.fspath(value)
    except TypeError:
        raise wrong_type(argument, "a text or a path is expected", value) from None
    encoded = to_bytes(given, argument)
    if not encoded:
        raise input_error(f"argument '{argument}' is empty", argument, show(value), "a name or a path")
    if b"\0" in encoded:
        raise input_error(f"argument '{argument}' has a NUL character", argument, show(value), "text without one")
    return encoded


def to_bytes(text: str | bytes, argument: str) -> bytes:
    if isinstance(text, bytes):
        return text
    try:
        return text.encode("utf-8", "surrogateescape")
    except UnicodeEncodeError:
        what = f"argument '{argument}' has a lone surrogate"
        raise input_error(what, argument, show(text), "text in Unicode") from None


def to_optional_path(value: Any, argument: str) -> bytes:
    """Empty for None, which stands for what the library does without one."""
    return b"" if value is None else to_path(value, argument)


def to_elements(values: Any, argument: str, expected: str) -> list[Any]:
    """Those of a list or of what can stand for one. The order of a set changes from process to process."""
    if isinstance(values, (set, frozenset)):
        raise wrong_type(argument, f"{expected} (a set has no order; sorted() makes a list of it)", values)
    try:
        iterator = None if isinstance(values, (str, bytes, os.PathLike, Mapping)) else iter(values)
    except TypeError:  # also of an array without dimensions
        iterator = None
    if iterator is None:
        raise wrong_type(argument, expected, values)
    return [*iterator]


def to_paths(values: Any, argument: str) -> list[bytes]:
    return [to_path(value, argument) for value in to_elements(values, argument, "a list of paths is expected")]


def to_list(values: Any, argument: str) -> list[Any]:
    """What is repeated on the command line. One text stands for a list of it."""
    return [values] if isinstance(values, (str, bytes)) else to_elements(values, argument, "a list is expected")


def to_word(value: Any, argument: str) -> str | bytes:
    """A text that is no path."""
    if isinstance(value, (str, bytes)):
        return value
    raise wrong_type(argument, "a text is expected", value)


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


def out_of_range(value: Any, argument: str, allowed: str) -> InputError:
    """The same words as in python/bindings/keywords.cpp."""
    return input_error(f"argument '{argument}' is out of range", argument, show(value), allowed)


def write_whole_number(value: int, argument: str) -> str:
    try:
        return str(value)
    except ValueError:  # it has more digits than Python writes
        raise out_of_range(value, argument, "a number with fewer digits") from None


def write_real_number(value: Any, argument: str) -> str:
    """Of a number that is no float: the nearest one, with every bit."""
    try:
        nearest = float(value)
    except (OverflowError, ValueError):  # of a signaling NaN
        nearest = math.inf
    if math.isinf(nearest):
        raise out_of_range(value, argument, "a number that a float can hold")
    return float.__repr__(nearest)


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
    if isinstance(value, int) and value.bit_length() < 64:  # as the library reads it
        return str(value)
    if isinstance(value, (str, bytes, os.PathLike)):
        return os.fsdecode(value)
    if isinstance(value, (numbers.Real, decimal.Decimal)):  # also a fraction
        return write_real_number(value, argument)
    elements = to_elements(value, argument, "a number, a text or a list is expected")
    return "[" + ",".join(_to_element(each, argument) for each in elements) + "]"


def _to_element(value: Any, argument: str) -> str:
    if isinstance(value, (str, bytes, os.PathLike)):
        return json.dumps(os.fsdecode(value), ensure_ascii=False)
    return to_text(value, argument)


def require_table(value: Any, argument: str) -> None:
    """Of effects, or of one: a dict. No effect at all is an empty one, an effect with its usual numbers likewise."""
    if value is None or isinstance(value, Mapping):
        return
    example = '{"bearing_warmup": {}}' if argument == "effects" else "{} for its usual numbers"
    raise wrong_type(argument, f"a dict is expected, such as {example}", value)


def list_settings(settings: Mapping[str, Any], prefix: str = "") -> Iterator[str]:
    """Each as "key=value". A mapping stands for keys with a dot: effects={"bearing_warmup": {"fall_per_K": 0.02}}."""
    for key, value in settings.items():
        if not isinstance(key, str):
            raise wrong_type(prefix[:-1], "a dict with texts as keys is expected", settings)
        if not re.fullmatch(r"[\w.\-]+", key):
            what = f"{prefix + key!r} is no key of a setting"
            raise input_error(what, prefix + key, "", "letters, digits, '_', '-' and '.'")
        if prefix + key == "effects" or prefix == "effects.":
            require_table(value, prefix + key)
        if isinstance(value, Mapping) and (value or prefix + key == "effects"):
            yield from list_settings(value, f"{prefix}{key}.")
        elif value is not None:
            yield f"{prefix}{key}={to_text(value, prefix + key)}"


def to_names(names: str | Iterable[str], argument: str) -> list[str]:
    """A list of names; of one text those between its commas, as on the command line."""
    return [name.strip() for name in names.split(",")] if isinstance(names, str) else to_list(names, argument)


def to_plain(value: Any) -> Any:
    """A mapping as a dict."""
    return dict(value) if isinstance(value, Mapping) else value


def take_given(arguments: Mapping[str, Any], *required: str) -> dict[str, Any]:
    """The arguments that are not None, and those that are required; for the others the library uses its defaults.

    Mappings become dicts.
    """
    return {key: to_path(value, key) if key in PATHS else to_plain(value)
            for key, value in arguments.items() if value is not None or key in required}


def make_uncertainty_options(uncertainty: bool, monte_carlo: int, seed: int, threads: int) -> dict[str, Any]:
    return {"uncertainty": uncertainty, "monte_carlo": monte_carlo, "seed": seed, "threads": threads}


def to_seed(value: Any) -> str:
    if not is_bool(value) and isinstance(value, int) and value.bit_length() > 63:
        raise out_of_range(value, "seed", "0 to 9007199254740991")  # the library takes it for a text
    return to_count(value, "seed")


def make_run_input(scenario: PathLike, names: Mapping[str, Any],
                   settings: Mapping[str, Any]) -> dict[str, Any]:
    given = {key: to_seed(value) if key == "seed" else value for key, value in names.items() if value is not None}
    return {**take_given(given), "scenario": to_path(scenario, "scenario"), "settings": list(list_settings(settings))}
