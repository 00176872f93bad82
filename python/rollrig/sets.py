"""Measurement sets, and the logs that become such sets."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple

from . import _rollrig
from .report import Report
from .runs import Name
from .settings import PathLike, take_given, to_flag, to_optional_path, to_path, to_skip

if TYPE_CHECKING:
    from .arrays import Channel


class MeasuredRun:
    """
    :api MeasuredRun
    """

    def __init__(self, listed: tuple[Any, ...]) -> None:
        from .arrays import Channel, freeze, to_channels

        (self.id, self.session, self.initial_tire_temperature_K, self.cold_pressure_Pa, self.rest_before_s, time_s,
         columns) = listed
        self.time_s = Channel(freeze(time_s), "s", "time_s")
        self.columns: dict[str, Channel] = to_channels(columns)

    def to_pandas(self) -> Any:
        """The columns as a pandas.DataFrame over time_s; attrs["units"] has the unit of each column."""
        from .arrays import to_data_frame

        return to_data_frame({"time_s": self.time_s, **self.columns},
                             {name: at.unit for name, at in self.columns.items()}, "time_s")

    def __repr__(self) -> str:
        return f"MeasuredRun({self.id!r}, {len(self.time_s)} rows: {', '.join(self.columns)})"


class MeasurementSet:
    """
    :api MeasurementSet

    * folder: of the set.
    * skip_bad_rows: whether rows that cannot be used are left out instead of refused.
    """

    def __init__(self, folder: PathLike, *, skip_bad_rows: bool = False) -> None:
        self._set = _rollrig.MeasurementSet(to_path(folder, "folder"), to_skip(skip_bad_rows))

    @property
    def name(self) -> str:
        return self._set.name

    @property
    def kind(self) -> str:
        """
        :api MeasurementSet::kind
        """
        return self._set.kind

    @property
    def tire(self) -> str:
        """
        :api MeasurementSet::tire
        """
        return self._set.tire

    @cached_property
    def runs(self) -> dict[str, MeasuredRun]:
        """The runs by id."""
        return {run.id: run for run in map(MeasuredRun, self._set.list_runs())}

    def __repr__(self) -> str:
        return f"MeasurementSet({self.name!r}, kind {self.kind}, tire {self.tire}, {len(self.runs)} runs)"


def as_set(given: MeasurementSet | PathLike, argument: str, skip_bad_rows: bool) -> MeasurementSet:
    to_skip(skip_bad_rows)
    if isinstance(given, MeasurementSet):
        return given
    return MeasurementSet(to_path(given, argument), skip_bad_rows=skip_bad_rows)


class FileCheck(NamedTuple):
    """
    :api FileCheck
    """

    what: str
    warnings: list[str]
    is_good: bool


def validate(path: PathLike, *, skip_bad_rows: bool = False) -> FileCheck:
    """
    :api check_file

    * path: of a file, or of the folder of a measurement set.
    """
    return FileCheck(*_rollrig.check_file(to_path(path, "path"), to_skip(skip_bad_rows)))


def find_sets(folder: PathLike) -> list[str]:
    """
    :api find_sets

    * folder: that holds folders of sets.
    """
    return _rollrig.find_sets(to_path(folder, "folder"))


def import_logs(mapping: PathLike, *, data: PathLike | None = None, skip_bad_rows: bool = False) -> Report:
    """
    :api import_logs

    * mapping: file that tells of the logs (import.toml).
    * data: folder of the logs; None: that of the mapping.
    """
    return Report(_rollrig.import_logs(to_path(mapping, "mapping"), to_optional_path(data, "data"),
                                       to_skip(skip_bad_rows)))


def import_folder(folder: PathLike, out: PathLike, *, tire: Name = None, rig: Name = None, vehicle: Name = None,
                  sensors: Name = None, name: str | None = None, columns: Mapping[str, str] | None = None,
                  units: Mapping[str, str] | None = None, values: Mapping[str, float] | None = None,
                  date_order: str | None = None, cold_pressure_kPa: float | None = None,
                  rests_min: Mapping[str, float] | None = None, skip_bad_rows: bool = False,
                  force: bool = False) -> MeasurementSet:
    """Makes a measurement set in the folder `out` from logs of which nothing is known, as `rollrig import --guess`.

    :api import_guessed

    * out: folder for the set.
    :members GuessOptions what the logs tell
    * force: whether a folder that holds files is written into.
    """
    given = {"folder": folder, "tire": tire, "rig": rig, "vehicle": vehicle, "sensors": sensors, "name": name,
             "columns": columns, "units": units, "values": values, "date_order": date_order,
             "cold_pressure_kPa": cold_pressure_kPa, "rests_min": rests_min}
    into = to_path(out, "out")
    overwrite = to_flag(force, "force")
    Report(_rollrig.import_guessed(take_given(given, "folder"), into, to_skip(skip_bad_rows))).write(into, overwrite)
    return MeasurementSet(into, skip_bad_rows=skip_bad_rows)
