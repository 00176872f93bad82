"""Files for a user's own tire, rig, vehicle and logs. write(folder) of what is returned writes the file."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any

from . import _rollrig
from .notebook import Progress, progress_display
from .report import Report
from .runs import Name
from .settings import PathLike, take_given, to_flag, to_load_index, to_path


def new_tire(size: str, *, name: str | None = None, load_index: str | int | None = None, tire_class: str | None = None,
             is_reinforced: bool = False, rrc_N_per_kN: float | None = None, tir: Name = None,
             rrc_sd_N_per_kN: float | None = None, pressure_kPa: float | None = None,
             speed_symbol: str | None = None, warm_up: Name = None, progress: Progress = None,
             **log: Any) -> Report:
    """
    :api make_new_tire

    :members NewTireOptions
    * load_index: "91"; of "156/150" the first; None: that of the size.
    * rrc_N_per_kN: of ISO 28580, at 25 degC on the 2 m drum; None: by the property file.
    * tir: path of a tire property file (.tir) whose coefficients give the RRc; None: no such file.
    * warm_up: log of a warm-up, or a folder of such logs, to which the tire is fitted; None: no fit.
    * log: further arguments tell of the log, as those of import_folder().
    """
    if "folder" in log:
        raise TypeError("unexpected keyword argument 'folder'")
    given = {"size": size, "name": name, "load_index": to_load_index(load_index, "load_index"),
             "tire_class": tire_class, "is_reinforced": to_flag(is_reinforced, "is_reinforced"),
             "rrc_N_per_kN": rrc_N_per_kN, "tir": tir,
             "rrc_sd_N_per_kN": rrc_sd_N_per_kN, "pressure_kPa": pressure_kPa, "speed_symbol": speed_symbol}
    with progress_display(progress) as show:
        of_log = {"folder": None if warm_up is None else to_path(warm_up, "warm_up"), **log}
        return Report(_rollrig.make_new_tire(show, take_given(given, "size"), take_given(of_log)))


def new_rig(*, name: str | None = None, kind: str | None = None, diameter_m: float | None = None,
            inertia_kg_m2: float | None = None, moving_mass_kg: float | None = None,
            skim_load_N: float | None = None, ambient_degC: float | None = None,
            bearing_loss_N: float | None = None) -> Report:
    """
    :api make_new_rig

    * name: of the rig; None: my_ and its kind.
    :members NewRigOptions that of the usual rig of this kind
    * diameter_m: of a drum, which needs it, or of the rollers of a dyno; None: that of the usual dyno.
    * inertia_kg_m2: of drum or roller; None: that of the usual rig, in proportion to the cube of the diameter.
    * moving_mass_kg: of a belt with its drums and motor; None: that of the usual belt.
    * skim_load_N: load of the skim test of a drum or a belt; None: that of the usual rig of this kind.
    * ambient_degC: usual temperature of the air; None: that of the usual rig of this kind.
    """
    return Report(_rollrig.make_new_rig(take_given(locals())))


def new_vehicle(*, mass_kg: float, name: str | None = None, drag_area_m2: float | None = None,
                rotating_mass_kg: float | None = None, wheelbase_m: float | None = None,
                front_load_share: float | None = None, road_load: tuple[float, float, float] | None = None,
                driven_axle: str | None = None) -> Report:
    """
    :api make_new_vehicle

    * mass_kg: as tested.
    * name: of the vehicle; None: my_vehicle.
    * drag_area_m2: drag coefficient times frontal area; None: from C of the road load, which is then needed.
    * rotating_mass_kg: of all rotating parts; None: 3 % of the mass.
    * wheelbase_m: between the axles; None: 2.7.
    * front_load_share: share of the weight on the front axle; None: 0.5.
    :members NewVehicleOptions no road load
    """
    return Report(_rollrig.make_new_vehicle(take_given(locals(), "mass_kg")))


def new_set(folder: PathLike, *, beside: PathLike | None = None, tire: Name = None, rig: Name = None,
            vehicle: Name = None, sensors: Name = None, name: str | None = None,
            columns: Mapping[str, str] | None = None, units: Mapping[str, str] | None = None,
            values: Mapping[str, float] | None = None, date_order: str | None = None,
            cold_pressure_kPa: float | None = None, rests_min: Mapping[str, float] | None = None) -> Report:
    """A mapping for import_logs(), or a set.toml where the logs are files of a set as they are.

    It is guessed from logs of which nothing is known, with a comment on each guess, as `rollrig new set` does.

    :members GuessOptions what the logs tell
    * beside: folder into which the file is to be written; None: that of the logs.
    """
    given = {"folder": folder, "tire": tire, "rig": rig, "vehicle": vehicle, "sensors": sensors, "name": name,
             "columns": columns, "units": units, "values": values, "date_order": date_order,
             "cold_pressure_kPa": cold_pressure_kPa, "rests_min": rests_min}
    logs = os.fsdecode(to_path(folder, "folder"))
    of_file = beside if beside is not None else logs if os.path.isdir(logs) else os.path.dirname(logs) or os.curdir
    return Report(_rollrig.guess_set(take_given(given, "folder"), to_path(of_file, "beside")))
