"""Many runs, or many diagnoses, in a folder: shared among processes, and resumed where they stopped."""

from __future__ import annotations

import io
from collections.abc import Mapping, Sequence
from typing import Any

from . import _rollrig
from .notebook import Progress, progress_display
from .report import Report
from .runs import Name
from .settings import PathLike, make_run_input, take_given, to_list, to_names, to_path, to_paths, to_skip
from .sweeps import Values, make_axes


class CampaignState(Report):
    """
    :api CampaignState
    """

    _made: _rollrig.CampaignState
    _kept_properties = (*Report._kept_properties, "items", "done", "failed")

    @property
    def items(self) -> int:
        return self._made.items

    @property
    def done(self) -> int:
        """Number of items that are done, including those that failed."""
        return self._made.done

    @property
    def failed(self) -> int:
        return self._made.failed


class Campaign:
    """
    :api ItemCampaign

    * folder: of the campaign.
    """

    def __init__(self, folder: PathLike) -> None:
        self._campaign = _rollrig.ItemCampaign(to_path(folder, "folder"))

    def run(self, *, part: str | None = None, threads: int = 0, progress: Progress = None) -> CampaignState:
        """
        :api ItemCampaign::carry_out
        * part: "3/10" is the third of ten parts; None is all.
        """
        with progress_display(progress) as show:
            return CampaignState(self._campaign.carry_out(show, part, threads))

    @property
    def state(self) -> CampaignState:
        """
        :api ItemCampaign::read_state
        """
        return CampaignState(self._campaign.read_state())

    def merge(self) -> CampaignState:
        """
        :api ItemCampaign::merge
        """
        return CampaignState(self._campaign.merge())

    def csv(self) -> str:
        """
        :api ItemCampaign::write_csv
        """
        return self._campaign.write_csv()

    def to_pandas(self) -> Any:
        """The table of csv() as a pandas.DataFrame over the items."""
        import pandas

        return pandas.read_csv(io.StringIO(self.csv()), index_col=0, float_precision="round_trip")

    def sensitivity(self, result: str) -> Report:
        """
        :api ItemCampaign::calc_sensitivity

        * result: its name, as in the columns of csv().
        """
        return Report(self._campaign.calc_sensitivity(result))

    def summary(self) -> Report:
        """
        :api ItemCampaign::summarize_diagnoses
        """
        return Report(self._campaign.summarize_diagnoses())


def new_campaign(folder: PathLike, scenario: PathLike, *,
                 vary: Mapping[str, Values] | None = None, drawn: Sequence[str] = (), drawn_sd: Sequence[str] = (),
                 list: PathLike | None = None, design: str | None = None, points: int = 0,
                 tire: Name = None, rig: Name = None, vehicle: Name = None, fidelity: str | None = None,
                 baseline: str | None = None, sensors: Name = None, seed: int | None = None,
                 **settings: Any) -> Campaign:
    """
    :api define_run_campaign

    :members RunCampaignInput
    :members RunInput as the scenario or the run file has it
    * folder: of the campaign; made where it is not there.
    * vary: by name of a setting the values that it takes; None: none.
    * list: CSV file of a list: a column for each setting, a row for each item; None: none.
    """
    names = {"tire": tire, "rig": rig, "vehicle": vehicle, "fidelity": fidelity, "baseline": baseline,
             "sensors": sensors, "seed": seed}
    options = {"drawn": to_list(drawn, "drawn"), "drawn_sd": to_list(drawn_sd, "drawn_sd"), "list": list,
               "design": design, "points": points}
    _rollrig.define_run_campaign(to_path(folder, "folder"), make_run_input(scenario, names, settings),
                                 make_axes({} if vary is None else vary), take_given(options))
    return Campaign(folder)


def new_diagnosis_campaign(folder: PathLike, sets: Sequence[PathLike], *,
                           only: Sequence[str] = (), without: Sequence[str] = (),
                           smallest_effect_percent: float | None = None, skip_bad_rows: bool = False) -> Campaign:
    """
    :api define_diagnosis_campaign

    * folder: of the campaign; made where it is not there.
    :members DiagnosisCampaignInput
    """
    options = {"sets": to_paths(sets, "sets"), "only": to_names(only, "only"), "without": to_names(without, "without"),
               "smallest_effect_percent": smallest_effect_percent, "skip_bad_rows": to_skip(skip_bad_rows)}
    _rollrig.define_diagnosis_campaign(to_path(folder, "folder"), take_given(options))
    return Campaign(folder)
