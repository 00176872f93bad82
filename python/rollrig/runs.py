"""Runs of a scenario, and their results."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Any, Optional, Union

from . import _rollrig
from .notebook import Progress, progress_display
from .report import Report
from .settings import PathLike, make_run_input, to_flag, to_path
from .values import Value

if TYPE_CHECKING:
    import numpy as np

    from .arrays import Channel

Name = Optional[PathLike]
ResultItem = Union[Value, str, None]


def to_items(listed: list[tuple[str, str, str, str, Any]]) -> dict[str, ResultItem]:
    """Values by name: numbers with their unit, words as they are."""
    return {name: Value(value, unit, name, label, doc) if isinstance(value, float) else value
            for name, label, unit, doc, value in listed}


class Result(Report, Mapping[str, ResultItem]):
    """Results, records and recording of a run.

    It is a mapping: result["rrc_25degC_2m_N_per_kN"] is a number with its unit. A word is a str, and what has no value
    is None. Answers to yes/no questions are 1 or 0.
    """

    _made: _rollrig.RunResult
    _kept_properties = (*Report._kept_properties, "values", "records", "warnings", "mechanical_closure",
                        "thermal_closure")
    _kept_methods = (*Report._kept_methods, "make_recording", "make_set_files")

    @cached_property
    def values_by_name(self) -> dict[str, ResultItem]:
        """Results that are one number or word, by name."""
        return to_items(self._made.values)

    @cached_property
    def records(self) -> dict[str, list[dict[str, ResultItem]]]:
        """Lists of results by name: one record for each cycle, section or speed."""
        return {name: [to_items(record) for record in listed] for name, (doc, listed) in self._made.records.items()}

    @property
    def warnings(self) -> list[str]:
        """A sentence each."""
        return self._made.warnings

    @property
    def mechanical_closure(self) -> float:
        """Error of the mechanical energy balance divided by the work done (a ratio)."""
        return self._made.mechanical_closure

    @property
    def thermal_closure(self) -> float:
        """Error of the thermal energy balance divided by the work done (a ratio)."""
        return self._made.thermal_closure

    @cached_property
    def _recording(self) -> tuple[Any, Any, list[tuple[str, float, float]], list[tuple[str, str, Any]]]:
        return self._made.make_recording()

    @cached_property
    def time_s(self) -> Channel:
        """Times of the rows of the recording."""
        from .arrays import Channel, freeze

        return Channel(freeze(self._recording[0]), "s", "time_s")

    @cached_property
    def channels(self) -> dict[str, Channel]:
        """
        :api Recording
        """
        from .arrays import to_channels

        return to_channels(self._recording[3])

    @property
    def phases(self) -> list[tuple[str, float, float]]:
        """Name, start and end in s of each phase of the procedure."""
        return self._recording[2]

    @cached_property
    def phase(self) -> np.ndarray[Any, Any]:
        """Name of the phase of each row."""
        import numpy as np

        from .arrays import freeze

        names = np.array([name for name, start_s, end_s in self.phases], dtype=object)
        return freeze(np.asarray(names[self._recording[1]]))  # type: ignore[no-any-return]

    def to_pandas(self) -> Any:
        """The recording as a pandas.DataFrame over time_s; attrs["units"] has the unit of each column."""
        from .arrays import to_data_frame

        columns = {"time_s": self.time_s, "phase": self.phase, **self.channels}
        return to_data_frame(columns, {name: at.unit for name, at in self.channels.items()}, "time_s")

    def write_set(self, folder: PathLike, force: bool = False) -> None:
        """Writes the run as a measurement set. Raises ValueError for a scenario that writes none.

        * folder: for the set; made where it is not there.
        * force: whether a folder that holds files is written into.
        """
        files = self._made.make_set_files()
        if files is None:
            raise ValueError(f"scenario '{self.data['scenario']}' writes no measurement set")
        _rollrig.write_folder(to_path(folder, "folder"), files, to_flag(force, "force"))

    def __getitem__(self, name: str) -> ResultItem:
        return self.values_by_name[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self.values_by_name)

    def __len__(self) -> int:
        return len(self.values_by_name)

    def _ipython_key_completions_(self) -> list[str]:
        return list(self)


class Run:
    """
    :api Run
    """

    def __init__(self, scenario: PathLike, *, tire: Name = None, rig: Name = None, vehicle: Name = None,
                 fidelity: str | None = None, baseline: str | None = None, sensors: Name = None,
                 seed: int | None = None, **settings: Any) -> None:
        """
        :members RunInput as the scenario or the run file has it
        """
        names = {"tire": tire, "rig": rig, "vehicle": vehicle, "fidelity": fidelity, "baseline": baseline,
                 "sensors": sensors, "seed": seed}
        self._run = _rollrig.Run(make_run_input(scenario, names, settings))

    @property
    def scenario(self) -> str:
        """Name of the scenario."""
        return self._run.scenario

    @property
    def writes_set(self) -> bool:
        """Whether the scenario can write a measurement set."""
        return self._run.writes_set

    @property
    def has_sensors(self) -> bool:
        """Whether virtual sensors are there for it."""
        return self._run.has_sensors

    @property
    def has_uncertainty(self) -> bool:
        """Whether its results have an uncertainty budget."""
        return self._run.has_uncertainty

    def carry_out(self, *, progress: Progress = None, uncertainty: bool = False, monte_carlo: int = 0,
                  threads: int = 0) -> Result:
        """
        :api Run::carry_out
        * threads: for these trials; 0: as many as the machine has.
        """
        options = {"uncertainty": uncertainty, "monte_carlo": monte_carlo, "threads": threads}
        with progress_display(progress) as show:
            return Result(self._run.carry_out(show, options))


def run(scenario: PathLike, *, tire: Name = None, rig: Name = None, vehicle: Name = None,
        fidelity: str | None = None, baseline: str | None = None, sensors: Name = None, seed: int | None = None,
        progress: Progress = None, uncertainty: bool = False, monte_carlo: int = 0, threads: int = 0,
        **settings: Any) -> Result:
    """Runs a scenario: rollrig.run("iso_28580", tire="a50", pressure_kPa=210).

    :members RunInput as the scenario or the run file has it
    * threads: for these trials; 0: as many as the machine has.
    """
    prepared = Run(scenario, tire=tire, rig=rig, vehicle=vehicle, fidelity=fidelity, baseline=baseline,
                   sensors=sensors, seed=seed, **settings)
    return prepared.carry_out(progress=progress, uncertainty=uncertainty, monte_carlo=monte_carlo, threads=threads)
