"""Files for a user's own tire, rig and vehicle. write(folder) of what is returned writes the file."""

from __future__ import annotations

from typing import Any

from . import _rollrig
from .notebook import Progress, shown
from .report import Report
from .runs import Name
from .settings import take_given


def new_tire(size: str, *, name: str | None = None, load_index: str | None = None, tire_class: str | None = None,
             is_reinforced: bool = False, rrc_N_per_kN: float | None = None, tir: Name = None,
             rrc_sd_N_per_kN: float | None = None, pressure_kPa: float | None = None,
             speed_symbol: str | None = None, warm_up: Name = None, progress: Progress = None,
             **log: Any) -> Report:
    """
    :api make_new_tire

    :members NewTireOptions
    * warm_up: log of a warm-up, or a folder of such logs, to which the tire is fitted; further arguments tell of the
      log, as those of import_folder().
    """
    given = {"size": size, "name": name, "load_index": load_index and str(load_index), "tire_class": tire_class,
             "is_reinforced": is_reinforced, "rrc_N_per_kN": rrc_N_per_kN, "tir": tir,
             "rrc_sd_N_per_kN": rrc_sd_N_per_kN, "pressure_kPa": pressure_kPa, "speed_symbol": speed_symbol}
    with shown(progress) as show:
        return Report(_rollrig.make_new_tire(show, take_given(given), take_given({"folder": warm_up, **log})))


def new_rig(*, name: str | None = None, kind: str | None = None, diameter_m: float | None = None,
            inertia_kg_m2: float | None = None, moving_mass_kg: float | None = None,
            skim_load_N: float | None = None, ambient_degC: float | None = None,
            bearing_loss_N: float | None = None) -> Report:
    """
    :api make_new_rig

    :members NewRigOptions
    """
    return Report(_rollrig.make_new_rig(take_given(locals())))


def new_vehicle(*, mass_kg: float, name: str | None = None, drag_area_m2: float | None = None,
                rotating_mass_kg: float | None = None, wheelbase_m: float | None = None,
                front_load_share: float | None = None, road_load: tuple[float, float, float] | None = None,
                driven_axle: str | None = None) -> Report:
    """
    :api make_new_vehicle

    :members NewVehicleOptions
    """
    return Report(_rollrig.make_new_vehicle(take_given(locals())))
