"""Why a measurement and the simulation differ."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from . import _rollrig
from .notebook import Progress, progress_display
from .report import Report
from .runs import Name
from .sets import MeasurementSet, as_set
from .settings import PathLike, take_given, to_flag, to_names, to_path, to_paths, to_skip


class Diagnosis(Report):
    """The diagnosis of one set. `data` has all that it finds, under the keys of docs/diagnosis.md."""

    _made: _rollrig.Diagnosis
    _kept_methods = (*Report._kept_methods, "make_plan")

    @property
    def verdict(self) -> str:
        """ "no_gap", "explained" or "unexplained"."""
        return str(self.data["verdict"])

    @property
    def probability(self) -> dict[str, float]:
        """Of "none", "unknown" and every effect in the comparison."""
        return dict(self.data["probability"])

    @property
    def causes(self) -> list[dict[str, Any]]:
        """The likeliest first: effects, probability, parameters with their intervals, and more."""
        return list(self.data["causes"])

    @property
    def next_tests(self) -> list[dict[str, Any]]:
        """Tests that would tell more, the best first."""
        return list(self.data["next_test"])

    def write_plan(self, folder: PathLike, force: bool = False) -> bool:
        """Writes the first proposed test as files for run(), with plan.txt. False: no test is proposed.

        * folder: for the files; made where it is not there.
        * force: whether a folder that holds files is written into.
        """
        files = self._made.make_plan()
        if files:
            _rollrig.write_folder(to_path(folder, "folder"), files, to_flag(force, "force"))
        return bool(files)


class Loop(Report):
    """
    :api Loop
    """

    def __init__(self, made: tuple[_rollrig.Report, list[str]]) -> None:
        super().__init__(made[0])
        self.missing = made[1]

    def _get_own_state(self) -> dict[str, Any]:
        return {"missing": self.missing}

    @property
    def state(self) -> str:
        """ "waiting", "named", "hours_gone" or "nothing_to_test"."""
        return str(self.data["state"])

    @property
    def tests(self) -> list[dict[str, Any]]:
        """The tests of the loop, in their order."""
        return list(self.data["tests"])

    @property
    def answers(self) -> list[dict[str, Any]]:
        """What the diagnosis says after so many tests."""
        return list(self.data["answers"])


def diagnose(set: MeasurementSet | PathLike, *, only: Sequence[str] = (), without: Sequence[str] = (),
             smallest_effect_percent: float | None = None, threads: int = 0, skip_bad_rows: bool = False,
             progress: Progress = None) -> Diagnosis:
    """
    :api diagnose

    * set: a MeasurementSet, or the folder of one.
    :members DiagnosisOptions
    """
    given = {"only": to_names(only, "only"), "without": to_names(without, "without"), "threads": threads,
             "smallest_effect_percent": smallest_effect_percent}
    with progress_display(progress) as show:
        return Diagnosis(_rollrig.diagnose(show, as_set(set, "set", skip_bad_rows)._set, take_given(given)))


def diagnose_fleet(folders: Sequence[PathLike], *, only: Sequence[str] = (), without: Sequence[str] = (),
                   smallest_effect_percent: float | None = None, threads: int = 0, skip_bad_rows: bool = False,
                   progress: Progress = None) -> Report:
    """
    :api diagnose_fleet

    * folders: of measurement sets.
    :members DiagnosisOptions
    """
    given = {"only": to_names(only, "only"), "without": to_names(without, "without"), "threads": threads,
             "smallest_effect_percent": smallest_effect_percent}
    with progress_display(progress) as show:
        return Report(_rollrig.diagnose_fleet(show, to_paths(folders, "folders"), to_skip(skip_bad_rows),
                                              take_given(given)))


def diagnose_pair(a: MeasurementSet | PathLike, b: MeasurementSet | PathLike, *, only: Sequence[str] = (),
                  without: Sequence[str] = (), threads: int = 0, skip_bad_rows: bool = False,
                  progress: Progress = None) -> Report:
    """
    :api diagnose_pair

    * a, b: a MeasurementSet each, or the folder of one.
    :members DiagnosisOptions
    """
    given = {"only": to_names(only, "only"), "without": to_names(without, "without"), "threads": threads}
    with progress_display(progress) as show:
        return Report(_rollrig.diagnose_pair(show, as_set(a, "a", skip_bad_rows)._set,
                                             as_set(b, "b", skip_bad_rows)._set,
                                             take_given(given)))


def advance_loop(set: PathLike, folder: PathLike, *, hours: float | None = None, test_failed: bool = False,
                 only: Sequence[str] = (), without: Sequence[str] = (),
                 smallest_effect_percent: float | None = None, threads: int = 0, skip_bad_rows: bool = False,
                 progress: Progress = None) -> Loop:
    """
    :api advance_loop

    :members LoopInput
    :members DiagnosisOptions
    """
    given = {"set": set, "folder": folder, "hours": hours,
             "test_failed": to_flag(test_failed, "test_failed"), "only": to_names(only, "only"),
             "without": to_names(without, "without"), "threads": threads,
             "smallest_effect_percent": smallest_effect_percent, "skip_bad_rows": to_skip(skip_bad_rows)}
    with progress_display(progress) as show:
        return Loop(_rollrig.advance_loop(show, take_given(given, "set", "folder")))


def plan_campaign(*, rig: Name = None, tire: Name = None, vehicle: Name = None, sensors: Name = None,
                  hours: float | None = None, only: Sequence[str] = (), without: Sequence[str] = (),
                  threads: int = 0, progress: Progress = None) -> Report:
    """
    :api plan_campaign

    :members CampaignInput
    """
    given = {"rig": rig, "tire": tire, "vehicle": vehicle, "sensors": sensors, "hours": hours,
             "only": to_names(only, "only"), "without": to_names(without, "without"), "threads": threads}
    with progress_display(progress) as show:
        return Report(_rollrig.plan_campaign(show, take_given(given)))


def explain(effect: str) -> str:
    """
    :api explain_effect

    * effect: its name; effects() lists them.
    """
    return _rollrig.explain_effect(effect)
