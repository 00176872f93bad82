"""Every public function refuses an argument of a wrong type by a TypeError of its own, which names the argument."""

import datetime
import decimal
import fractions
import inspect
import os
import pathlib
import types
import unittest

import numpy as np
import rollrig
from support import EXAMPLES, InFolder

HIDDEN = EXAMPLES / "hidden_effect"
QUICK = {"tire": "a50", "fidelity": "quasi_static", "soak_h": 1, "warm_up_min": 2}
HUGE = 10**400  # more than a float holds
LONG = 10**5000  # more digits than Python writes


class Unlike:
    """What no argument takes."""


# By the annotation of an argument: values of a wrong type, then values of the right type that cannot be right.
PATHS = [Unlike(), 5, 1.5, ["a"], {"a": 1}, datetime.date(2026, 3, 2), np.array("a"), {"a"}]
TEXTS = [*PATHS, pathlib.Path("a")]
BAD_TEXTS = ["a\0b", b"a\0b", "a\ud800"]
BAD_PATHS = [*BAD_TEXTS, "", b""]
NUMBERS = [Unlike(), "1.5", [1.5], True, np.True_, 1j]
BAD_NUMBERS = [HUGE]
FLAGS = [Unlike(), "no", 5, 1, 0, 1.0, None, [True], np.array([True, False])]
COUNTS = [Unlike(), "many", 1.5, [1], True, np.float64(1)]
BAD_COUNTS = [2**70, -2**70, LONG]
LISTS = [Unlike(), 5, [Unlike()], [5], np.array("a"), {"a"}, frozenset("ab"), {"a": 1}]
DICTS = [Unlike(), 5, ["a"], "a"]
KINDS = {
    "bool": (FLAGS, []),
    "int": (COUNTS, BAD_COUNTS),
    "float": (NUMBERS, BAD_NUMBERS),
    "str": (TEXTS, BAD_TEXTS),
    "str | int": ([Unlike(), 1.5, ["a"], True], BAD_TEXTS),
    "PathLike": (PATHS, BAD_PATHS),
    "Name": (PATHS, BAD_PATHS),
    "MeasurementSet | PathLike": (PATHS, BAD_PATHS),
    "Sequence[str]": (LISTS, []),
    "Sequence[PathLike]": ([*LISTS, "a"], [[""]]),
    "Mapping[str, str]": ([*DICTS, {"a": 5}, {5: "a"}], []),
    "Mapping[str, float]": ([*DICTS, {"load_N": "a"}, {5: 1.0}], []),
    "Mapping[str, Values]": ([*DICTS, {"pressure_kPa": 210}, {"pressure_kPa": [Unlike()]}, {5: [1]},
                              {"pressure_kPa": np.array(5)}, {"pressure_kPa": {210, 250}}], []),
    "Abc": ([Unlike(), 5, "abc", [1, 2], ["a", "b", "c"], [1, 2, HUGE], np.array(5), {1, 2, 3},
             [True, 1, 2], np.array([True, False, True])], []),
    "tuple[Abc, Abc]": ([Unlike(), 5, (1, 2), ([1, 2], [3, 4]), np.array(5), (np.array(5), np.array(6)),
                         ([1, 2, 3], [4, 5, True])], []),
    "tuple[float, float]": ([Unlike(), 5, (1,), ("a", "b"), np.array(5), {1, 2}], []),
    "tuple[float, float, float]": ([Unlike(), 5, (1, 2), np.array(5), {1, 2, 3}], []),
    "Progress": ([Unlike(), "yes", 1], []),
}


class Arguments(InFolder):
    def list_calls(self):
        """By name of each public function a call of it that is right, as function and arguments."""
        road, points = EXAMPLES / "coastdowns.csv", EXAMPLES / "j1269_points.csv"
        known = {"tire": HIDDEN / "tire.toml", "rig": HIDDEN / "rig.toml"}
        runs = {"scenario": "iso_28580", "tire": "a50"}
        report = rollrig.default_road_load(mass_kg=1500, width_m=1.8, height_m=1.5)
        result = rollrig.run("speed_sweep", tire="a50", fidelity="quasi_static", sensors="source",
                             speeds_km_h=[80, 120], warm_up_min=5, settle_min=0)
        campaign = rollrig.new_campaign(self.folder / "known", "iso_28580", vary={"pressure_kPa": [210]}, **QUICK)
        diagnosis = rollrig.Diagnosis(types.SimpleNamespace(make_plan=lambda: {"plan.txt": ""}))
        return {
            "Campaign": (rollrig.Campaign, {"folder": self.folder / "known"}),
            "Campaign.run": (campaign.run, {}),
            "Campaign.sensitivity": (campaign.sensitivity, {"result": "rrc_N_per_kN"}),
            "Diagnosis.write_plan": (diagnosis.write_plan, {"folder": self.folder / "plan"}),
            "MeasurementSet": (rollrig.MeasurementSet, {"folder": HIDDEN}),
            "Report.write": (report.write, {"folder": self.folder / "out"}),
            "Result.write_set": (result.write_set, {"folder": self.folder / "set"}),
            "Run": (rollrig.Run, runs),
            "Run.carry_out": (rollrig.Run("iso_28580", **QUICK).carry_out, {}),
            "advance_loop": (rollrig.advance_loop, {"set": HIDDEN, "folder": self.folder / "loop"}),
            "align": (rollrig.align, {"file": EXAMPLES / "alignment.csv"}),
            "apply_alignment": (rollrig.apply_alignment, {"alignment": self.folder, "rrc_N_per_kN": 8.0}),
            "assets": (rollrig.assets, {"folder": "tires"}),
            "assets_folder": (rollrig.assets_folder, {}),
            "compare": (rollrig.compare, {"compared": ["a50", "a60"]}),
            "convert": (rollrig.convert, {"force_N": 32, "measured": {"load_N": 4000}, "wanted": {"load_N": 5000}}),
            "default_road_load": (rollrig.default_road_load, {"mass_kg": 1500, "width_m": 1.8, "height_m": 1.5}),
            "describe": (rollrig.describe, {"name": "warm_up"}),
            "diagnose": (rollrig.diagnose, {"set": HIDDEN}),
            "diagnose_fleet": (rollrig.diagnose_fleet, {"folders": [HIDDEN]}),
            "diagnose_pair": (rollrig.diagnose_pair, {"a": HIDDEN, "b": HIDDEN}),
            "effects": (rollrig.effects, {}),
            "evaluate_road_load": (rollrig.evaluate_road_load, {"file": road, "method": "wltp", "mass_kg": 1500}),
            "explain": (rollrig.explain, {"effect": "bearing_warmup"}),
            "export_hdf5": (rollrig.export_hdf5, {"source": HIDDEN}),
            "export_mat": (rollrig.export_mat, {"source": HIDDEN}),
            "find_asset": (rollrig.find_asset, {"folder": "tires", "name_or_path": "a50"}),
            "find_sets": (rollrig.find_sets, {"folder": self.folder}),
            "fit_drum_coastdown": (rollrig.fit_drum_coastdown, {"set": EXAMPLES / "drum_coastdown" / "coasts.toml"}),
            "fit_j1269": (rollrig.fit_j1269, {"path": points}),
            "fit_j2452": (rollrig.fit_j2452, {"path": EXAMPLES / "j2452_points.csv"}),
            "fit_road_load": (rollrig.fit_road_load, {"file": road, "mass_kg": 1500}),
            "fit_tire": (rollrig.fit_tire, {"set": HIDDEN}),
            "import_folder": (rollrig.import_folder, {"folder": EXAMPLES / "own_logs", "out": self.folder / "in",
                                                      **known}),
            "import_logs": (rollrig.import_logs, {"mapping": EXAMPLES / "logs" / "import.toml"}),
            "label": (rollrig.label, {"rrc_N_per_kN": 8.4, "tire_class": "C1"}),
            "make_fmu": (rollrig.make_fmu, {"tire": "a50"}),
            "new_campaign": (rollrig.new_campaign, {"folder": self.folder / "campaign", **runs}),
            "new_diagnosis_campaign": (rollrig.new_diagnosis_campaign, {"folder": self.folder / "campaign",
                                                                        "sets": [HIDDEN]}),
            "new_rig": (rollrig.new_rig, {"diameter_m": 1.7}),
            "new_set": (rollrig.new_set, {"folder": EXAMPLES / "own_logs", **known}),
            "new_tire": (rollrig.new_tire, {"size": "205/55R16", "load_index": 91, "rrc_N_per_kN": 8.2}),
            "new_vehicle": (rollrig.new_vehicle, {"mass_kg": 1500}),
            "plan_campaign": (rollrig.plan_campaign, {"tire": "a50"}),
            "regress": (rollrig.regress, {"folder": self.folder}),
            "run": (rollrig.run, runs),
            "scenarios": (rollrig.scenarios, {}),
            "sweep": (rollrig.sweep, {"vary": {"pressure_kPa": [210]}, **runs}),
            "validate": (rollrig.validate, {"path": HIDDEN}),
            "vecto_tire": (rollrig.vecto_tire, {"tire": "c3_315_80r22_5"}),
        }

    def test_calls_are_those_of_all_public_functions(self):
        made_by_the_package = {"Estimate", "Fit", "Loop", "MeasuredRun", "SweepResult", "Value", "CampaignState",
                               "Diagnosis", "Error", "FileCheck", "InputError", "Report", "Result", "RunFailure"}
        public = {name for name in rollrig.__all__ if name not in made_by_the_package}
        for name in made_by_the_package | {"Campaign", "MeasurementSet", "Run"}:
            of = getattr(rollrig, name)
            for method, function in vars(of).items():
                takes_more = inspect.isfunction(function) and len(inspect.signature(function).parameters) > 1
                if takes_more and not method.startswith("_"):
                    public.add(f"{name}.{method}")
        self.assertEqual(set(self.list_calls()), public)

    def refuse(self, errors, function, arguments, name, value):
        """The message of the error that the call raises."""
        with self.assertRaises(errors) as caught:
            function(**{**arguments, name: value})
        message = str(caught.exception)
        self.assertNotRegex(message, r"incompatible function arguments|Unable to cast|std::|object is not|0-d|unsized")
        self.assertLess(len(message), 1000)
        return message

    def test_of_a_wrong_type_are_refused_by_name(self):
        for call, (function, arguments) in self.list_calls().items():
            for name, parameter in inspect.signature(function).parameters.items():
                if parameter.kind is inspect.Parameter.VAR_KEYWORD:
                    continue
                kind = parameter.annotation.removesuffix(" | None")
                wrong, bad = KINDS[kind]
                if parameter.default is parameter.empty:
                    wrong = [*wrong, None]
                for value in wrong:
                    with self.subTest(f"{call}: {name}", value=repr(value)[:50]):
                        message = self.refuse(TypeError, function, arguments, name, value)
                        self.assertRegex(message, f"argument '{name}(: [^']*)?'")
                        self.assertRegex(message, "expected")
                        if kind in ("PathLike", "Name", "str"):
                            self.assertEqual("path is expected" in message, kind != "str", message)
                for value in bad:
                    with self.subTest(f"{call}: {name}", value=repr(value)[:50] if value is not LONG else "LONG"):
                        message = self.refuse(rollrig.InputError, function, arguments, name, value)
                        self.assertRegex(message, f"argument '{name}(: [^']*)?'")
        self.assertEqual(os.listdir(self.folder / "known"), ["campaign.json"])
        for name in ("out", "set", "plan", "loop", "in", "campaign"):
            self.assertFalse((self.folder / name).exists(), name)

    def test_unknown_are_refused_by_name(self):
        for call in (lambda: rollrig.new_tire("205/55R16", folder="logs"),
                     lambda: rollrig.new_tire("205/55R16", warm_up="logs", fodler="logs"),
                     lambda: rollrig.fit_tire(HIDDEN, load_mpa=True)):
            with self.assertRaisesRegex(TypeError, "unexpected keyword argument '(folder|fodler|load_mpa)'"):
                call()
        with self.assertRaisesRegex(TypeError, "argument 'measured': unexpected key 'laod_N'"):
            rollrig.convert(force_N=32, measured={"laod_N": 4000}, wanted={})

    def test_that_are_threads_have_a_range(self):
        alignment = self.folder / "alignment"
        rollrig.align(EXAMPLES / "alignment.csv", machine="drum_B", reference_machine="drum_A").write(alignment)
        for call, (function, arguments) in self.list_calls().items():
            if "threads" not in inspect.signature(function).parameters:
                continue
            if call == "apply_alignment":
                arguments = {**arguments, "alignment": alignment / "alignment.json"}
            if call == "align":
                arguments = {**arguments, "machine": "drum_B", "reference_machine": "drum_A"}
            for threads in (-1, 1025):
                with self.subTest(call, threads=threads):
                    with self.assertRaises(rollrig.InputError) as caught:
                        function(**{**arguments, "threads": threads})
                    self.assertEqual(caught.exception.key, "--threads")

    def test_that_name_no_folder_of_assets_are_refused(self):
        for call in (lambda: rollrig.assets("tyres"), lambda: rollrig.find_asset("tyres", "a50")):
            with self.assertRaises(rollrig.InputError) as caught:
                call()
            self.assertEqual((caught.exception.key, caught.exception.nearest), ("folder", "tires"))
        self.assertIn("udds", rollrig.assets("cycles"))

    def test_whose_key_would_set_another_setting_is_refused(self):
        for key in ("pressure_kPa=300 #", "a=b", "pressure kPa", ""):
            with self.assertRaises(rollrig.InputError, msg=key):
                rollrig.run("iso_28580", tire="a50", **{key: 210})

    def test_that_is_a_place_without_access_is_an_input_error(self):
        os.symlink("loop", self.folder / "loop")  # to itself
        calls = {"MeasurementSet": rollrig.MeasurementSet, "compare": lambda path: rollrig.compare([path, "a50"]),
                 "find_sets": rollrig.find_sets, "regress": rollrig.regress, "validate": rollrig.validate}
        for name, call in calls.items():
            for path in ("x" * 300 + "/set", self.folder / "loop"):
                with self.assertRaisesRegex(rollrig.InputError, "cannot (read|access) '", msg=name):
                    call(path)

    def test_that_are_settings_are_named_too(self):
        for value in (Unlike(), [Unlike()], [{"a": 1}], 1j):
            with self.assertRaisesRegex(TypeError, "argument 'pressure_kPa'"):
                rollrig.run("iso_28580", pressure_kPa=value, **QUICK)
            with self.assertRaisesRegex(TypeError, "argument 'effects.slip_loss.of'"):
                rollrig.run("iso_28580", effects={"slip_loss": {"of": value}}, **QUICK)
        with self.assertRaisesRegex(TypeError, "argument 'effects'"):
            rollrig.run("iso_28580", effects={5: {"of": 1}}, **QUICK)
        with self.assertRaises(rollrig.InputError):
            rollrig.run("iso_28580", pressure_kPa=LONG, **QUICK)
        usual = rollrig.run("iso_28580", pressure_kPa=210.5, **QUICK)
        for value in (decimal.Decimal("210.5"), fractions.Fraction(421, 2), np.float64(210.5), np.array(210.5), "210.5", b"210.5"):
            self.assertEqual(rollrig.run("iso_28580", pressure_kPa=value, **QUICK).json, usual.json)

    def test_that_no_float_can_hold_are_refused(self):
        for value in (HUGE, fractions.Fraction(HUGE), decimal.Decimal(HUGE), decimal.Decimal("sNaN")):
            with self.assertRaises(rollrig.InputError) as caught:
                rollrig.run("iso_28580", pressure_kPa=value, **QUICK)
            self.assertEqual((caught.exception.key, caught.exception.allowed),
                             ("pressure_kPa", "a number that a float can hold"))
            self.assertIn("\n  allowed  a number that a float can hold", str(caught.exception))

    def test_that_are_effects_are_dicts(self):
        usual = rollrig.run("iso_28580", **QUICK)
        for none in ({}, None):
            self.assertEqual(rollrig.run("iso_28580", effects=none, **QUICK).json, usual.json)
        for value in ("bearing_warmup", ["bearing_warmup"], [], True):
            with self.assertRaisesRegex(TypeError, "argument 'effects': a dict is expected, such as .\"bearing_warmup"):
                rollrig.run("iso_28580", effects=value, **QUICK)
        for value in (True, [], 0.02):
            with self.assertRaisesRegex(TypeError, "argument 'effects.bearing_warmup': a dict is expected"):
                rollrig.run("iso_28580", effects={"bearing_warmup": value}, **QUICK)
        self.assertNotEqual(rollrig.run("iso_28580", effects={"bearing_warmup": {}}, **QUICK).json, usual.json)

    def test_without_an_order_are_refused(self):
        for value in ({80, 120}, frozenset([80, 120])):
            with self.assertRaisesRegex(TypeError, r"argument 'speeds_km_h': .* \(a set has no order;"):
                rollrig.run("speed_sweep", tire="a50", speeds_km_h=value)
        keys = dict.fromkeys([80, 120]).keys()  # they have an order
        given = {"fidelity": "quasi_static", "tire": "a50", "warm_up_min": 5, "settle_min": 0}
        self.assertEqual(rollrig.run("speed_sweep", speeds_km_h=keys, **given).json,
                         rollrig.run("speed_sweep", speeds_km_h=[80, 120], **given).json)

    def test_that_are_names_of_effects_may_be_one_text(self):
        self.assertEqual(rollrig.make_fmu("a50", effects="slip_loss, toe_camber_drag"),
                         rollrig.make_fmu("a50", effects=["slip_loss", "toe_camber_drag"]))

    def test_that_numpy_made_are_taken(self):
        given = {"mass_kg": 1500, "uncertainty": True, "monte_carlo": 1000, "seed": 3, "threads": 1}
        of_numpy = {"mass_kg": np.float64(1500), "uncertainty": np.True_, "monte_carlo": np.int64(1000),
                    "seed": np.uint8(3), "threads": np.int32(1)}
        fits = [rollrig.fit_road_load(EXAMPLES / "coastdowns.csv", **each) for each in (given, of_numpy)]
        self.assertEqual(fits[0].json, fits[1].json)

    def test_are_shown_as_they_are_given(self):
        with self.assertRaisesRegex(TypeError, "argument 'proportional': True or False is expected, not 'no'$"):
            rollrig.fit_j1269(EXAMPLES / "j1269_points.csv", proportional="no")
        with self.assertRaisesRegex(TypeError, "argument 'uncertainty': True or False is expected, not 5$"):
            rollrig.run("iso_28580", uncertainty=5, **QUICK)
        with self.assertRaises(rollrig.InputError) as caught:
            rollrig.sweep("iso_28580", vary={"pressure_kPa": [210]}, threads=2**40, **QUICK)
        error = caught.exception
        self.assertEqual((error.key, error.value, error.allowed), ("threads", "1099511627776", "2147483647 or less"))
        with self.assertRaises(rollrig.InputError) as caught:
            rollrig.new_campaign(self.folder / "campaign", "iso_28580", drawn_sd=["tire"], points=-1, **QUICK)
        self.assertEqual((caught.exception.key, caught.exception.allowed), ("points", "0 or more"))
        with self.assertRaisesRegex(rollrig.InputError, "argument 'path' has a NUL character"):
            rollrig.fit_j1269("points.csv\0.txt")
        with self.assertRaises(rollrig.InputError) as caught:
            rollrig.assets("tires\0")
        self.assertEqual((caught.exception.what, caught.exception.value),
                         ("argument 'folder' has a NUL character", r"'tires\x00'"))
        with self.assertRaisesRegex(rollrig.InputError, "argument 'path' has a lone surrogate"):
            rollrig.fit_j1269("points\ud800.csv")
        self.assertFalse((self.folder / "campaign").exists())


if __name__ == "__main__":
    unittest.main()
