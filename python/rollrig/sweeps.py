"""A scenario at every point of a grid."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import Any, Union

from . import _rollrig
from .notebook import Progress, progress_display
from .report import Report
from .runs import Name
from .settings import PathLike, make_run_input, to_list, to_text, wrong_type

Values = Union[str, Sequence[Any], Any]
"""Of a setting: a list, a range or an array, or a text such as "210:310:20"."""


def make_axes(vary: Mapping[str, Values]) -> dict[str, str | list[str]]:
    if not isinstance(vary, Mapping):
        raise wrong_type("vary", "a dict is expected", vary)
    return {key: make_axis(values, f"vary: {key}") for key, values in vary.items()}


def make_axis(values: Values, argument: str) -> str | list[str]:
    return values if isinstance(values, str) else [to_text(value, argument) for value in to_list(values, argument)]


def to_number(text: str) -> float | str:
    """What a column of a table holds: a number where the text is one."""
    try:
        return float(text)
    except ValueError:
        return text


class SweepResult(Report):
    """
    :api SweepResult
    """

    _made: _rollrig.SweepResult
    _kept_properties = (*Report._kept_properties, "axes", "points", "columns", "failures")

    @cached_property
    def axes(self) -> dict[str, list[float | str]]:
        """By key of each axis its value at each point, the last axis fastest."""
        points = self._made.points
        return {key: [to_number(point[i]) for point in points] for i, key in enumerate(self._made.axes)}

    @cached_property
    def results(self) -> dict[str, Any]:
        """By name of each result an array with a number for each point; NaN where it has none."""
        from .arrays import freeze

        return {name: freeze(values) for name, values in self._made.columns.items()}

    @property
    def failures(self) -> list[str]:
        """For each point the reason why it failed, or an empty text."""
        return self._made.failures

    def to_pandas(self) -> Any:
        """A pandas.DataFrame with a row for each point: axes, then results; names have their units."""
        from .arrays import to_data_frame

        return to_data_frame({**self.axes, **self.results}, {})

    def __getitem__(self, name: str) -> Any:
        return self.results[name]


def sweep(scenario: PathLike, *, vary: Mapping[str, Values], tire: Name = None, rig: Name = None,
          vehicle: Name = None, fidelity: str | None = None, baseline: str | None = None, sensors: Name = None,
          seed: int | None = None, shown_results: Sequence[str] = (), threads: int = 0, progress: Progress = None,
          **settings: Any) -> SweepResult:
    """Runs a scenario at every point of a grid: sweep("iso_28580", tire="a50", vary={"pressure_kPa": [210, 250]}).

    :members RunInput as the scenario or the run file has it
    * vary: by name of a setting its values: a list, a range, an array, or a text such as "210:310:20"; also of "tire".
    * shown_results: results in the tables and charts of the report; where there are none, those that change.
    """
    names = {"tire": tire, "rig": rig, "vehicle": vehicle, "fidelity": fidelity, "baseline": baseline,
             "sensors": sensors, "seed": seed}
    run = make_run_input(scenario, names, settings)
    options = {"shown_results": to_list(shown_results, "shown_results"), "threads": threads}
    with progress_display(progress) as show:
        return SweepResult(_rollrig.sweep(show, run, make_axes(vary), options))
