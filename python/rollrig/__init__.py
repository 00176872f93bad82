"""rollrig: a virtual rolling-resistance laboratory.

    import rollrig
    result = rollrig.run("iso_28580", tire="a50")
    print(result["rrc_25degC_2m_N_per_kN"])

docs/python.md describes the package; rollrig.describe() tells of a scenario, an effect or a file.
"""

from . import _rollrig
from .asset_files import assets, assets_folder, describe, effects, find_asset, scenarios
from .campaigns import Campaign, CampaignState, new_campaign, new_diagnosis_campaign
from .diagnoses import (Diagnosis, Loop, advance_loop, diagnose, diagnose_fleet, diagnose_pair, explain,
                       plan_campaign)
from .errors import Error, InputError, RunFailure
from .fits import (Fit, default_road_load, evaluate_road_load, fit_drum_coastdown, fit_j1269, fit_j2452,
                   fit_road_load, fit_tire)
from .new_files import new_rig, new_set, new_tire, new_vehicle
from .report import Report
from .results import (align, apply_alignment, compare, convert, export_hdf5, export_mat, label, make_fmu, regress,
                      vecto_tire)
from .runs import Result, Run, run
from .sets import FileCheck, MeasuredRun, MeasurementSet, find_sets, import_folder, import_logs, validate
from .sweeps import SweepResult, sweep
from .values import Estimate, Value

__version__: str = _rollrig.version
__all__ = [
    "Campaign", "CampaignState", "Diagnosis", "Error", "Estimate", "FileCheck", "Fit", "InputError", "Loop",
    "MeasuredRun", "MeasurementSet", "Report", "Result", "Run", "RunFailure", "SweepResult", "Value", "advance_loop",
    "align", "apply_alignment", "assets", "assets_folder", "compare", "convert", "default_road_load", "describe",
    "diagnose", "diagnose_fleet", "diagnose_pair", "effects", "evaluate_road_load", "explain", "export_hdf5",
    "export_mat", "find_asset", "find_sets", "fit_drum_coastdown", "fit_j1269", "fit_j2452", "fit_road_load",
    "fit_tire", "import_folder", "import_logs", "label", "make_fmu", "new_campaign", "new_diagnosis_campaign",
    "new_rig", "new_set", "new_tire", "new_vehicle", "plan_campaign", "regress", "run", "scenarios", "sweep",
    "validate", "vecto_tire",
]
