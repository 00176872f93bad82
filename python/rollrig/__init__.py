"""rollrig: a virtual rolling-resistance laboratory.

    import rollrig
    result = rollrig.run("iso_28580", tire="a50")
    print(result["rrc_25degC_2m_N_per_kN"])

docs/python.md describes the package; rollrig.describe() tells of a scenario, an effect or a file.
"""

from . import _rollrig
from .errors import Error, InputError, RunFailure
from .report import Report
from .run import Result, Run, run
from .values import Channel, Estimate, Value

__version__: str = _rollrig.version
__all__ = ["Channel", "Error", "Estimate", "InputError", "Report", "Result", "Run", "RunFailure", "Value", "run"]
