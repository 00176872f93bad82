"""Keyword arguments as the settings and names that the library reads."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Mapping
from typing import Any, Union

PathLike = Union[str, "os.PathLike[str]"]


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
    if isinstance(value, (str, os.PathLike)):
        return os.fspath(value)
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


def to_names(names: str | Iterable[str]) -> list[str]:
    """A list of names; of one text those between its commas, as on the command line."""
    return [name.strip() for name in names.split(",")] if isinstance(names, str) else [*names]


def take_given(arguments: Mapping[str, Any]) -> dict[str, Any]:
    """Without what is None: of that, the library knows the default. Paths become text, mappings become dicts."""
    return {key: _to_plain(value) for key, value in arguments.items() if value is not None}


def _to_plain(value: Any) -> Any:
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    return dict(value) if isinstance(value, Mapping) else value


def make_uncertainty_options(uncertainty: bool, monte_carlo: int, threads: int = 0) -> dict[str, Any]:
    return {"budget": uncertainty, "monte_carlo_trials": monte_carlo, "threads": threads}


def make_run_input(scenario: PathLike, names: Mapping[str, Any],
                   settings: Mapping[str, Any]) -> dict[str, Any]:
    given = {key: to_text(value) for key, value in names.items() if value is not None}
    return {**given, "scenario_or_file": os.fspath(scenario), "settings": list(list_settings(settings))}
