"""Models from measurements."""

from __future__ import annotations

from collections.abc import Sequence

from . import _rollrig
from .notebook import Progress, progress_display
from .report import Report
from .runs import Name
from .sets import MeasurementSet, as_set
from .settings import (PathLike, input_error, make_uncertainty_options, take_given, to_flag, to_list, to_optional_path,
                       to_path, to_skip, to_word)
from .values import Estimate

Abc = Sequence[float]


class Fit(Report):
    """A fitted model. `data` has its JSON (docs/formats.md), files() the file of the model."""

    _made: _rollrig.Fit
    _kept_properties = (*Report._kept_properties, "parameters", "warnings", "suspicion")

    @property
    def parameters(self) -> dict[str, Estimate]:
        """By name the value, its standard uncertainty and its interval of 95 %."""
        return {listed[0]: Estimate(*listed) for listed in self._made.parameters}

    @property
    def warnings(self) -> list[str]:
        """A sentence each."""
        return self._made.warnings

    @property
    def suspicion(self) -> str:
        """Why columns, units or files cannot be what they are said to be; else empty."""
        return self._made.suspicion


def fit_tire(set: MeasurementSet | PathLike, *, name: str | None = None, load_map: bool = False, free_H: bool = False,
             threads: int = 0, skip_bad_rows: bool = False, progress: Progress = None) -> Fit:
    """A tire from warm-ups.

    :api fit_tire

    * set: a MeasurementSet, or the folder of one.
    :members TireFitOptions
    """
    given = {"name": name, "load_map": to_flag(load_map, "load_map"),
             "free_H": to_flag(free_H, "free_H"), "threads": threads}
    with progress_display(progress) as show:
        return Fit(_rollrig.fit_tire(show, as_set(set, "set", skip_bad_rows)._set, take_given(given)))


def fit_road_load(file: PathLike, *, mass_kg: float | None = None, rotating_mass_kg: float | None = None,
                  drag_area_m2: float | None = None, reference_temperature_K: float | None = None,
                  reference_pressure_Pa: float | None = None, rolling_fall_per_K: float | None = None,
                  speed_from_m_s: float | None = None, speed_to_m_s: float | None = None,
                  bin_width_m_s: float | None = None, bounds: tuple[Abc, Abc] | None = None,
                  target: Abc | None = None, leave_out: Sequence[str] = (), per_mass: bool = False,
                  sessions: Sequence[str] = (), skip_bad_rows: bool = False, uncertainty: bool = False,
                  monte_carlo: int = 0, seed: int = 1, threads: int = 0, progress: Progress = None) -> Fit:
    """A, B, C of a vehicle by least squares.

    :api fit_road_load

    * file: CSV file of coastdowns, or the folder of a recorded run.
    * per_mass: forces per unit of effective mass; no mass is needed. Without a mass and without this, the file has to
      be a recording, which tells the vehicle.

    * bounds: lowest and highest A, B, C in SI units; None: none.
    * target: A, B, C in SI units, with which the result is compared; None: none.
    * sessions: those that are used; none: all.
    :members RoadLoadFitOptions
    :members UncertaintyOptions
    """
    if to_flag(per_mass, "per_mass") and (mass_kg is not None or rotating_mass_kg is not None):
        raise input_error("per_mass and a mass exclude each other", "per_mass", "", "one of them")
    given = {"mass_kg": mass_kg, "rotating_mass_kg": rotating_mass_kg, "drag_area_m2": drag_area_m2,
             "reference_temperature_K": reference_temperature_K, "reference_pressure_Pa": reference_pressure_Pa,
             "rolling_fall_per_K": rolling_fall_per_K, "speed_from_m_s": speed_from_m_s,
             "speed_to_m_s": speed_to_m_s, "bin_width_m_s": bin_width_m_s, "bounds": bounds, "target": target,
             "leave_out": to_list(leave_out, "leave_out"), "recorded_vehicle": mass_kg is None and not per_mass}
    with progress_display(progress) as show:
        return Fit(_rollrig.fit_road_load(show, to_path(file, "file"), None, to_list(sessions, "sessions"),
                                          to_skip(skip_bad_rows),
                                          make_uncertainty_options(uncertainty, monte_carlo, seed, threads),
                                          take_given(given)))


def evaluate_road_load(file: PathLike, method: str, *, mass_kg: float | None = None,
                       rotating_mass_kg: float | None = None, corrected_to_mass_kg: float | None = None,
                       reference_temperature_K: float | None = None, reference_pressure_Pa: float | None = None,
                       rolling_fall_per_K: float | None = None, speed_from_m_s: float | None = None,
                       speed_to_m_s: float | None = None, yaw_degree: int | None = None,
                       wheel_radius_m: float | None = None, sensor_accuracy: bool = True,
                       leave_out: Sequence[str] = (), sessions: Sequence[str] = (), skip_bad_rows: bool = False,
                       uncertainty: bool = False, monte_carlo: int = 0, seed: int = 1, threads: int = 0,
                       progress: Progress = None) -> Fit:
    """
    :api evaluate_road_load

    * file: CSV file of coastdowns or of a torque-meter test, or the folder of a recorded run.
    * method: "wltp", "j2263", "j1263" or "torque-meter".
    * wheel_radius_m: dynamic radius, of a torque-meter test; None: from its wheel speeds.
    * sessions: those that are used; none: all.
    :members RoadLoadProcedureOptions
    :members UncertaintyOptions
    """
    given = {"mass_kg": mass_kg, "rotating_mass_kg": rotating_mass_kg, "corrected_to_mass_kg": corrected_to_mass_kg,
             "reference_temperature_K": reference_temperature_K, "reference_pressure_Pa": reference_pressure_Pa,
             "rolling_fall_per_K": rolling_fall_per_K, "speed_from_m_s": speed_from_m_s,
             "speed_to_m_s": speed_to_m_s, "yaw_degree": yaw_degree, "wheel_radius_m": wheel_radius_m,
             "sensor_accuracy": to_flag(sensor_accuracy, "sensor_accuracy"),
             "leave_out": to_list(leave_out, "leave_out")}
    with progress_display(progress) as show:
        return Fit(_rollrig.fit_road_load(show, to_path(file, "file"), to_word(method, "method"),
                                          to_list(sessions, "sessions"), to_skip(skip_bad_rows),
                                          make_uncertainty_options(uncertainty, monte_carlo, seed, threads),
                                          take_given(given)))


def default_road_load(*, mass_kg: float, width_m: float, height_m: float, tire_class: str | None = None,
                      rrc_N_per_kN: float | None = None) -> Fit:
    """
    :api calc_default_road_load

    :members DefaultRoadLoadOptions
    * rrc_N_per_kN: of the tire, with its class; None: no rolling resistance class.
    """
    given = {"mass_kg": mass_kg, "width_m": width_m, "height_m": height_m, "tire_class": tire_class,
             "rrc_N_per_kN": rrc_N_per_kN}
    return Fit(_rollrig.calc_default_road_load(take_given(given, "mass_kg", "width_m", "height_m")))


def fit_j2452(path: PathLike, *, maximum_load_N: float | None = None, base_pressure_Pa: float | None = None,
              warm_pressure: bool = False, urban_cycle: Name = None, highway_cycle: Name = None,
              uncertainty: bool = False, monte_carlo: int = 0, seed: int = 1, threads: int = 0,
              progress: Progress = None) -> Fit:
    """
    :api fit_j2452

    * path: CSV file of test points, or the folder or result.json of a run.
    * base_pressure_Pa: gauge, of the standard reference condition; None: that of the result, else no such condition.
    * highway_cycle: likewise; None: "hwfet".
    :members RollingLawOptions
    :members UncertaintyOptions
    """
    given = {"maximum_load_N": maximum_load_N, "base_pressure_Pa": base_pressure_Pa,
             "warm_pressure": to_flag(warm_pressure, "warm_pressure"),
             "urban_cycle": urban_cycle, "highway_cycle": highway_cycle}
    with progress_display(progress) as show:
        return Fit(_rollrig.fit_law(show, "j2452", to_path(path, "path"),
                                    make_uncertainty_options(uncertainty, monte_carlo, seed, threads),
                                    take_given(given)))


def fit_j1269(path: PathLike, *, proportional: bool = False, maximum_load_N: float | None = None,
              base_pressure_Pa: float | None = None, warm_pressure: bool = False, uncertainty: bool = False,
              monte_carlo: int = 0, seed: int = 1, threads: int = 0, progress: Progress = None) -> Fit:
    """
    :api fit_j1269

    * path: CSV file of test points, or the folder or result.json of a run.
    * base_pressure_Pa: gauge, of the standard reference condition; None: that of the result, else no such condition.
    * proportional: F = Z (A1 + A3/P) instead of A0 + A1 Z + A2/P + A3 Z/P.
    :members RollingLawOptions
    :members UncertaintyOptions
    """
    given = {"maximum_load_N": maximum_load_N, "base_pressure_Pa": base_pressure_Pa,
             "warm_pressure": to_flag(warm_pressure, "warm_pressure")}
    law = "j1269_proportional" if to_flag(proportional, "proportional") else "j1269"
    with progress_display(progress) as show:
        return Fit(_rollrig.fit_law(show, law, to_path(path, "path"),
                                    make_uncertainty_options(uncertainty, monte_carlo, seed, threads),
                                    take_given(given)))


def fit_drum_coastdown(set: PathLike, *, data: PathLike | None = None, skip_bad_rows: bool = False,
                       uncertainty: bool = False, monte_carlo: int = 0, seed: int = 1, threads: int = 0,
                       progress: Progress = None) -> Report:
    """
    :api fit_drum_coastdown

    * set: file of a set of coast-downs (.toml).
    * data: folder of its CSV files; None: that of the set.
    :members UncertaintyOptions
    """
    logs = to_optional_path(data, "data")
    with progress_display(progress) as show:
        return Report(_rollrig.fit_drum_coastdown(show, to_path(set, "set"), logs, to_skip(skip_bad_rows),
                                                  make_uncertainty_options(uncertainty, monte_carlo, seed, threads)))
