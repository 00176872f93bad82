"""Sweeps, campaigns, sets, fits and what is made of results: in Python as on the command line, to the bit."""

import contextlib
import csv
import io
import json
import math
import random
import re
import shutil
import unittest

import numpy as np
import rollrig
from support import EXAMPLES, InFolder, run_failing_program, run_program

QUICK = {"tire": "a50", "fidelity": "quasi_static", "warm_up_min": 2}
QUICK_OPTIONS = ["--tire", "a50", "--fidelity", "quasi_static", "--set", "warm_up_min=2"]


class ManyRuns(InFolder):
    def test_a_sweep(self):
        run_program("sweep", "iso_28580", *QUICK_OPTIONS, "--vary", "pressure_kPa=210:250:20", "--vary",
                    "load_N=5000,6000.5", "--out", self.folder / "out")
        sweep = rollrig.sweep("iso_28580", vary={"pressure_kPa": range(210, 251, 20), "load_N": np.array([5000, 6000.5])},
                              **QUICK)
        as_text = rollrig.sweep("iso_28580", vary={"pressure_kPa": "210:250:20", "load_N": "5000,6000.5"}, **QUICK)
        self.assert_same_files(as_text.files(), self.read_files("out"))
        rows = list(csv.DictReader(io.StringIO(self.read_files("out")["sweep.csv"])))
        self.assertEqual([float(row["load_N"]) for row in rows], sweep.axes["load_N"])
        self.assertEqual([point["result"]["rrc_N_per_kN"] for point in json.loads(as_text.json)["points"]],
                         list(sweep["rrc_N_per_kN"]))
        self.assertEqual(list(as_text["rrc_N_per_kN"]), list(sweep["rrc_N_per_kN"]))
        self.assertEqual(len(sweep.to_pandas()), 6)
        self.assertEqual(sweep.failures, [""] * 6)

    def test_a_sweep_over_tires(self):
        sweep = rollrig.sweep("iso_28580", vary={"tire": ["a40", "a50"]}, fidelity="quasi_static", warm_up_min=2)
        self.assertEqual(sweep.axes["tire"], ["a40", "a50"])

    def test_a_campaign(self):
        run_program("campaign", "new", "told", "iso_28580", *QUICK_OPTIONS, "--draw-sd", "tire", "--points", 8,
                    "--seed", 3, folder=self.folder)
        run_program("campaign", "run", "told", folder=self.folder)
        run_program("campaign", "export", "told", "--csv", "told.csv", folder=self.folder)
        campaign = rollrig.new_campaign(self.folder / "made", "iso_28580", drawn_sd=["tire"], points=8, seed=3, **QUICK)
        self.assertEqual(campaign.run(part="1/2").done, 4)
        state = campaign.run()
        self.assertEqual((state.items, state.done, state.failed), (8, 8, 0))
        self.assertEqual(campaign.csv(), (self.folder / "told.csv").read_text())
        frame = campaign.to_pandas()
        self.assertEqual(len(frame), 8)
        self.assertGreater(frame["rrc_N_per_kN"].std(), 0)
        with self.assertRaises(rollrig.InputError):
            rollrig.Campaign(self.folder / "nowhere")
        for words, report in ((["status"], campaign.state), (["merge"], campaign.merge())):
            made = json.loads(report.json)
            told = json.loads(run_program("campaign", *words, "told", "--json", "-", folder=self.folder))
            self.assertEqual({**made, "folder": None}, {**told, "folder": None})

    def test_a_campaign_of_a_sensitivity(self):
        words = ["--design", "morris", "--points", 4]
        run_program("campaign", "new", "told", "iso_28580", *QUICK_OPTIONS, "--draw", "pressure_kPa=uniform:200:260",
                    "--draw", "load_N=normal:5000:300", *words, folder=self.folder)
        run_program("campaign", "run", "told", folder=self.folder)
        campaign = rollrig.new_campaign(self.folder / "made", "iso_28580", design="morris", points=4, **QUICK,
                                        drawn=["pressure_kPa=uniform:200:260", "load_N=normal:5000:300"])
        campaign.run(threads=1)
        self.assertEqual(campaign.sensitivity("rrc_N_per_kN").json,
                         run_program("campaign", "sensitivity", "told", "--result", "rrc_N_per_kN", "--json", "-",
                                     folder=self.folder))

    def test_a_campaign_of_diagnoses(self):
        shutil.copytree(EXAMPLES / "hidden_effect", self.folder / "sets" / "one")
        run_program("campaign", "new-diagnoses", "told", "sets", "--only", "bearing_warmup", folder=self.folder)
        run_program("campaign", "run", "told", folder=self.folder)
        campaign = rollrig.new_diagnosis_campaign(self.folder / "made", rollrig.find_sets(self.folder / "sets"),
                                                  only="bearing_warmup")
        campaign.run()
        self.assertEqual(campaign.summary().json,
                         run_program("campaign", "summary", "told", "--json", "-", folder=self.folder))
        run_program("campaign", "export", "told", "--csv", "told.csv", folder=self.folder)
        self.assertEqual(campaign.csv(), (self.folder / "told.csv").read_text())

    def test_a_regression(self):
        (self.folder / "runs").mkdir()
        run = 'format = "rollrig-run/1"\nscenario = "iso_28580"\ntire = "a50"\nfidelity = "quasi_static"\n'
        (self.folder / "runs" / "usual.toml").write_text(run)
        run_program("regress", "runs", "--update", "--quiet", folder=self.folder)
        (self.folder / "runs" / "changed.toml").write_text(run + "[settings]\npressure_kPa = 240.0\n")
        shutil.copy(self.folder / "runs" / "usual.golden.csv", self.folder / "runs" / "changed.golden.csv")
        told = run_program("regress", "runs", "--json", "-", "--threads", 0, folder=self.folder, status=1)
        with contextlib.chdir(self.folder):
            self.assertEqual(rollrig.regress("runs", threads=2).json, told)

    def test_a_plan(self):
        few = "bearing_warmup,torque_zero_drift"
        words = ["plan", "--rig", "drum", "--hours", 6, "--only", few, "--json", "-", "--out", self.folder / "told"]
        plan = rollrig.plan_campaign(rig="drum", hours=6, only=few)
        self.assertEqual(plan.json, run_program(*words))
        self.assert_same_files(plan.files(), self.read_files("told"))


class Measurements(InFolder):
    def test_a_set_has_the_numbers_of_its_files(self):
        measured = rollrig.MeasurementSet(EXAMPLES / "hidden_effect")
        run = measured.runs["1-warm-up-120"]
        with open(EXAMPLES / "hidden_effect" / "1-warm-up-120.csv", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        written = [float(row["drum_torque_Nm"] or math.nan) for row in rows]
        np.testing.assert_array_equal(run.columns["drum_torque_Nm"], written)
        self.assertEqual(run.columns["drum_torque_Nm"].unit, "N m")
        self.assertAlmostEqual(run.cold_pressure_Pa, 280e3)
        self.assertEqual(len(run.to_pandas()), len(rows))
        self.assertTrue(rollrig.validate(EXAMPLES / "hidden_effect" / "tire.toml").is_good)

    def test_logs_become_the_same_set(self):
        known = {"tire": EXAMPLES / "hidden_effect" / "tire.toml", "rig": EXAMPLES / "hidden_effect" / "rig.toml"}
        run_program("import", "--guess", EXAMPLES / "own_logs", "--tire", known["tire"], "--rig", known["rig"], "--out",
                    "told", folder=self.folder)
        with contextlib.chdir(self.folder):  # files name the logs relative to it
            made = rollrig.import_folder(EXAMPLES / "own_logs", "made", **known)
        self.assert_same_files(self.read_files("made"), self.read_files("told"))
        self.assertEqual(len(made.runs), 3)
        report = rollrig.import_logs(EXAMPLES / "logs" / "import.toml")
        run_program("import", EXAMPLES / "logs" / "import.toml", "--out", "joined", folder=self.folder)
        self.assert_same_files(report.files(), self.read_files("joined"))
        for path in (self.folder / "joined", EXAMPLES / "hidden_effect" / "rig.toml"):
            check = rollrig.validate(path)
            told = run_program("validate", path)
            self.assertTrue(check.is_good)
            for text in (check.what, *check.warnings):
                self.assertIn(" ".join(text.split()), " ".join(told.split()))

    def test_a_run_becomes_a_set(self):
        result = rollrig.run("speed_sweep", tire="a50", fidelity="quasi_static", sensors="source",
                             speeds_km_h=[80, 120], warm_up_min=5, settle_min=0)
        result.write_set(self.folder / "set")
        self.assertEqual(rollrig.MeasurementSet(self.folder / "set").tire, "a50")
        with self.assertRaises(rollrig.InputError):
            result.write_set(self.folder / "set")  # it is there


class Fits(InFolder):
    def check(self, fit, *words):
        told = run_program(*words, "--json", "-")
        self.assertEqual(fit.json, told)
        return fit

    def test_a_road_load(self):
        fit = self.check(rollrig.fit_road_load(EXAMPLES / "coastdowns.csv", mass_kg=2203), "fit", "road-load",
                         EXAMPLES / "coastdowns.csv", "--mass", 2203)
        self.assertLess(fit.parameters["A_N"].low_95, fit.parameters["A_N"].value)

    def test_a_road_load_by_a_procedure(self):
        file = EXAMPLES / "coastdowns.csv"
        for method, given, words in (
                ("wltp", {"corrected_to_mass_kg": 1550}, ["--corrected-mass", 1550]),
                ("j1263", {"speed_to_m_s": 100 / 3.6}, ["--speed-to", 100])):
            self.check(rollrig.evaluate_road_load(file, method, mass_kg=1500, rotating_mass_kg=40, **given), "fit",
                       "road-load", file, "--method", method, "--mass", 1500, "--rotating-mass", 40, *words)

    def test_a_drum_that_coasts_down(self):
        coasts = EXAMPLES / "drum_coastdown" / "coasts.toml"
        fit = self.check(rollrig.fit_drum_coastdown(coasts), "fit", "drum-coastdown", coasts)
        run_program("fit", "drum-coastdown", coasts, "--out", self.folder / "told")
        self.assert_same_files(fit.files(), self.read_files("told"))

    def test_laws_of_rolling_resistance(self):
        self.check(rollrig.fit_j2452(EXAMPLES / "j2452_points.csv", uncertainty=True), "fit", "j2452",
                   EXAMPLES / "j2452_points.csv", "--uncertainty")
        self.check(rollrig.fit_j1269(EXAMPLES / "j1269_points.csv"), "fit", "j1269", EXAMPLES / "j1269_points.csv")

    def test_their_uncertainty_with_a_seed_of_its_own(self):
        asked = {"uncertainty": True, "monte_carlo": 500, "seed": 5}
        words = ["--uncertainty", "--monte-carlo", 500, "--seed", 5]
        file = EXAMPLES / "coastdowns.csv"
        fit = self.check(rollrig.fit_road_load(file, mass_kg=1500, **asked), "fit", "road-load", file, "--mass", 1500,
                         *words)
        self.assertNotEqual(fit.json, rollrig.fit_road_load(file, mass_kg=1500, **{**asked, "seed": 6}).json)
        self.check(rollrig.evaluate_road_load(file, "wltp", mass_kg=1500, **asked), "fit", "road-load", file, "--mass",
                   1500, "--method", "wltp", *words)
        coasts = EXAMPLES / "drum_coastdown" / "coasts.toml"
        self.check(rollrig.fit_drum_coastdown(coasts, **asked), "fit", "drum-coastdown", coasts, *words)
        for law, call in (("j2452", rollrig.fit_j2452), ("j1269", rollrig.fit_j1269)):
            points = EXAMPLES / f"{law}_points.csv"
            self.check(call(points, **asked), "fit", law, points, *words)

    def test_bounds_that_no_number_can_meet_are_refused(self):
        none = (math.inf, math.inf, math.inf)
        for lower, upper, what in (((math.nan, 0, 0), none, "a bound of A is not a number"),
                                   ((0, 0, 0), (math.inf, math.nan, 1), "a bound of B is not a number"),
                                   ((0, 0, math.inf), none, "no number is within the bounds of C"),
                                   ((-math.inf, 0, 0), (-math.inf, 1, 1), "no number is within the bounds of A"),
                                   ((2, 0, 0), (1, 1, 1), "the bounds of A have their ends swapped")):
            with self.assertRaises(rollrig.InputError) as caught:
                rollrig.fit_road_load(EXAMPLES / "coastdowns.csv", mass_kg=1500, bounds=(lower, upper))
            self.assertEqual((caught.exception.what, caught.exception.key), (what, "--bounds"))
        rollrig.fit_road_load(EXAMPLES / "coastdowns.csv", mass_kg=1500, bounds=((-math.inf, 0, 0), none))

    def test_a_default_road_load(self):
        self.check(rollrig.default_road_load(mass_kg=1500, width_m=1.8, height_m=1.5), "fit", "default-road-load",
                   "--mass", 1500, "--width", 1.8, "--height", 1.5)


class Limits(InFolder):
    """The library refuses what the command line refuses, in the same words."""

    def check(self, call, *words):
        done = run_failing_program(*words)
        with self.assertRaises(rollrig.InputError) as caught:
            call()
        told, error = " ".join(done.split()), caught.exception
        for part in (error.what, error.key, error.value, error.allowed):
            self.assertIn(part, told)
        return error

    def test_of_a_road_load(self):
        file = EXAMPLES / "coastdowns.csv"
        for name, value, option, shown in (
                ("reference_temperature_K", 20.0, "--reference-temperature", 20.0 - 273.15),
                ("reference_pressure_Pa", 98.21, "--reference-pressure", 0.09821),
                ("rotating_mass_kg", -1.0, "--rotating-mass", -1.0),
                ("rotating_mass_kg", 1501.0, "--rotating-mass", 1501.0),
                ("rolling_fall_per_K", 1.0, "--rolling-coefficient-temperature", 1.0),
                ("speed_from_m_s", -1.0, "--speed-from", -3.6),
                ("speed_to_m_s", 2.0, "--speed-to", 7.2)):
            for method in ("least-squares", "j1263"):
                with self.subTest(name, value=value, method=method):
                    given = {"mass_kg": 1500, name: value}
                    error = self.check((lambda: rollrig.evaluate_road_load(file, method, **given)) if method == "j1263"
                                       else (lambda: rollrig.fit_road_load(file, **given)),
                                       "fit", "road-load", file, "--method", method, "--mass", 1500,
                                       f"{option}={shown!r}")
                    self.assertEqual(error.key, option)
        self.check(lambda: rollrig.fit_road_load(file, mass_kg=-1500.0), "fit", "road-load", file, "--mass=-1500")
        self.check(lambda: rollrig.fit_road_load(file, mass_kg=math.nan), "fit", "road-load", file, "--mass=nan")
        self.check(lambda: rollrig.fit_road_load(file, mass_kg=1500, bin_width_m_s=0.0), "fit", "road-load", file,
                   "--mass", 1500, "--bin-width", 0)
        self.check(lambda: rollrig.fit_road_load(file, mass_kg=1500, drag_area_m2=-0.6), "fit", "road-load", file,
                   "--mass", 1500, "--drag-area=-0.6")
        self.check(lambda: rollrig.fit_road_load(file, rotating_mass_kg=40), "fit", "road-load", file,
                   "--rotating-mass", 40)
        self.check(lambda: rollrig.evaluate_road_load(file, "wltp", mass_kg=1500, corrected_to_mass_kg=0.0), "fit",
                   "road-load", file, "--method", "wltp", "--mass", 1500, "--corrected-mass", 0)
        for key, value in (("yaw_degree", 9), ("wheel_radius_m", 33.0), ("wheel_radius_m", 0.3)):
            with self.assertRaises(rollrig.InputError) as caught:
                rollrig.evaluate_road_load(file, "j2263", mass_kg=1500, **{key: value})
            self.assertEqual(caught.exception.key, {"y": "--yaw-degree", "w": "--wheel-radius"}[key[0]])
        self.check(lambda: rollrig.default_road_load(mass_kg=1500, width_m=1800.0, height_m=1.5), "fit",
                   "default-road-load", "--mass", 1500, "--width", 1800, "--height", 1.5)
        self.check(lambda: rollrig.default_road_load(mass_kg=1500, width_m=1.8, height_m=1.5, rrc_N_per_kN=8.0), "fit",
                   "default-road-load", "--mass", 1500, "--width", 1.8, "--height", 1.5, "--rrc", 8)

    def test_are_those_that_the_help_shows(self):
        """What --help shows of a limit is what the library says when it is exceeded."""
        file = EXAMPLES / "coastdowns.csv"
        shown = re.findall(r"(--[a-z-]+) (?:FLOAT|INT) in \[(\S+) - (\S+)\]", run_program("fit", "road-load", "--help"))
        self.assertGreater(len(shown), 10)
        methods = {"--wheel-radius": "torque-meter", "--yaw-degree": "j2263", "--corrected-mass": "wltp"}
        for option, lowest, highest in shown:
            if option in ("--effective-mass", "--threads", "--seed"):  # of the command line alone
                continue
            mass = [] if option == "--mass" else ["--mass", 1500]
            for beyond in (float(lowest) - 1, 2 * float(highest)):
                words = [*mass, "--method", methods.get(option, "least-squares"), f"{option}={beyond:g}"]
                told = " ".join(run_failing_program("fit", "road-load", file, *words).split())
                self.assertIn(f"{option} is out of range", told)
                self.assertIn(f"{float(lowest):.10g} to {float(highest):.10g}", told)

    def test_of_a_law_of_rolling_resistance(self):
        points = EXAMPLES / "j2452_points.csv"
        self.check(lambda: rollrig.fit_j2452(points, base_pressure_Pa=250.0), "fit", "j2452", points,
                   "--base-pressure", 0.25)
        self.check(lambda: rollrig.fit_j1269(EXAMPLES / "j1269_points.csv", maximum_load_N=-5000.0), "fit", "j1269",
                   EXAMPLES / "j1269_points.csv", "--maximum-load=-5000")

    def test_of_effects_and_of_dates(self):
        both = {"only": "bearing_warmup", "without": "bearing_warmup"}
        self.check(lambda: rollrig.diagnose(EXAMPLES / "hidden_effect", **both), "diagnose", EXAMPLES / "hidden_effect",
                   "--only", "bearing_warmup", "--without", "bearing_warmup")
        self.check(lambda: rollrig.plan_campaign(**both), "plan", "--only", "bearing_warmup", "--without",
                   "bearing_warmup")
        self.check(lambda: rollrig.plan_campaign(only="bearing_warmpu"), "plan", "--only", "bearing_warmpu")
        with self.assertRaises(rollrig.InputError) as caught:
            rollrig.new_set(EXAMPLES / "own_logs", date_order="mydd", tire=EXAMPLES / "hidden_effect" / "tire.toml",
                            rig=EXAMPLES / "hidden_effect" / "rig.toml")
        self.assertEqual((caught.exception.key, caught.exception.value), ("--date-order", "mydd"))

    def test_of_threads(self):
        """0 is as many as the machine has; a number below it is refused, as on the command line."""
        points = EXAMPLES / "j1269_points.csv"
        told = run_program("fit", "j1269", points, "--monte-carlo", 500, "--threads", 0, "--json", "-")
        self.assertEqual(rollrig.fit_j1269(points, monte_carlo=500, threads=0).json, told)
        self.assertEqual(rollrig.fit_j1269(points, monte_carlo=500, threads=3).json, told)
        for refused in (-1, 1025):
            self.assertIn("0 to 1024", run_failing_program("fit", "j1269", points, f"--threads={refused}"))
        for call in (lambda: rollrig.fit_j1269(EXAMPLES / "j1269_points.csv", threads=-1),
                     lambda: rollrig.sweep("iso_28580", vary={"pressure_kPa": [210]}, threads=2000, **QUICK),
                     lambda: rollrig.diagnose(EXAMPLES / "hidden_effect", threads=-1),
                     lambda: rollrig.fit_tire(EXAMPLES / "hidden_effect", threads=-1),
                     lambda: rollrig.plan_campaign(threads=-1),
                     lambda: rollrig.run("iso_28580", threads=-1, **QUICK),
                     lambda: rollrig.run("iso_28580", threads=1025, **QUICK),
                     lambda: rollrig.align(EXAMPLES / "alignment.csv", threads=-1),
                     lambda: rollrig.regress(self.folder, threads=-1)):
            with self.assertRaises(rollrig.InputError) as caught:
                call()
            self.assertEqual(caught.exception.key, "--threads")


class Diagnoses(InFolder):
    """Of several sets, with so few effects that it is quick; diagnose_test.py has those of one."""

    FEW = "bearing_warmup"

    def copy_set(self, name):
        shutil.copytree(EXAMPLES / "hidden_effect", self.folder / name)
        return self.folder / name

    def test_of_a_fleet(self):
        self.copy_set("fleet/good")
        (self.copy_set("fleet/broken") / "set.toml").write_text("format = 3\n")
        run_program("diagnose", "fleet", "--only", self.FEW, "--json", "told.json", folder=self.folder, status=2)
        with contextlib.chdir(self.folder):  # the report names the sets relative to it
            fleet = rollrig.diagnose_fleet(rollrig.find_sets("fleet"), only=self.FEW)
        self.assertEqual(fleet.json, (self.folder / "told.json").read_text())

    def test_of_a_pair_of_machines(self):
        other = self.copy_set("other")
        noise = {"drum_torque_Nm": 0.3, "liner_temperature_degC": 0.1, "cavity_pressure_kPa": 0.1}
        random_numbers = random.Random(2)
        for path in sorted(other.glob("*.csv")):  # as another machine would have measured it
            with open(path, encoding="utf-8") as file:
                rows = list(csv.DictReader(file))
            for row in rows:
                for channel in (name for name in noise if row.get(name)):
                    row[channel] = f"{float(row[channel]) + random_numbers.gauss(0.0, noise[channel]):.6f}"
            with open(path, "w", encoding="utf-8", newline="") as file:
                writer = csv.DictWriter(file, rows[0])
                writer.writeheader()
                writer.writerows(rows)
        text = (other / "rig.toml").read_text()
        (other / "rig.toml").write_text(re.sub(r'name = "[^"]*"', 'name = "other"', text, count=1))
        told = run_program("diagnose", EXAMPLES / "hidden_effect", "--against", other, "--only", self.FEW, "--json",
                           "-")
        self.assertEqual(rollrig.diagnose_pair(EXAMPLES / "hidden_effect", other, only=self.FEW).json, told)


class FurtherResults(InFolder):
    def check(self, report, *words):
        self.assertEqual(report.json, run_program(*words, "--json", "-"))
        return report

    def test_a_label(self):
        label = self.check(rollrig.label(rrc_N_per_kN=8.4, tire_class="C1"), "label", "--rrc", 8.4, "--class", "C1")
        self.assertIn("label_class", str(label.data))

    def test_a_conversion(self):
        self.check(rollrig.convert(force_N=32, tire="a50", measured={"drum_curvature_per_m": 1 / 1.0},
                                   wanted={"drum_curvature_per_m": 1 / 0.6}), "convert", "--force", 32, "--from-drum",
                   2.0, "--to-drum", 1.2, "--tire", "a50")

    def test_an_alignment(self):
        words = ["align", EXAMPLES / "alignment.csv", "--reference-machine", "drum_A", "--reference", 1.003, -0.05]
        self.check(rollrig.align(EXAMPLES / "alignment.csv", reference_machine="drum_A", reference=(1.003, -0.05)),
                   *words)
        self.check(rollrig.align(EXAMPLES / "alignment.csv", reference_machine="drum_A", reference=(1.003, -0.05),
                                 uncertainty=True, monte_carlo=500, seed=4), *words, "--uncertainty", "--monte-carlo",
                   500, "--seed", 4)

    def test_an_aligned_value(self):
        rollrig.align(EXAMPLES / "alignment.csv", reference_machine="drum_A").write(self.folder / "out")
        alignment = self.folder / "out" / "alignment.json"
        self.check(rollrig.apply_alignment(alignment, 8.1, measurements=3, on="2026-06-01"), "align", "--apply",
                   alignment, "--rrc", 8.1, "--measurements", 3, "--on", "2026-06-01")
        self.check(rollrig.apply_alignment(alignment, 8.1, on="2026-06-01", uncertainty=True, monte_carlo=500, seed=4),
                   "align", "--apply", alignment, "--rrc", 8.1, "--on", "2026-06-01", "--uncertainty", "--monte-carlo",
                   500, "--seed", 4)

    def test_a_comparison(self):
        rollrig.run("iso_28580", **QUICK).write(self.folder / "a")
        rollrig.run("iso_28580", pressure_kPa=210, **QUICK).write(self.folder / "b")
        self.check(rollrig.compare([self.folder / "a", self.folder / "b"]), "compare", self.folder / "a",
                   self.folder / "b")

    def test_exports(self):
        rollrig.run("iso_28580", **QUICK).write(self.folder / "a")
        run_program("export", "a", "--mat", "a.mat", "--hdf5", "a.h5", folder=self.folder)
        self.assertEqual(rollrig.export_mat(self.folder / "a"), (self.folder / "a.mat").read_bytes())
        self.assertEqual(rollrig.export_hdf5(self.folder / "a"), (self.folder / "a.h5").read_bytes())
        run_program("export", "c3_315_80r22_5", "--vecto", "tire.xml", folder=self.folder)
        self.assertEqual(rollrig.vecto_tire("c3_315_80r22_5"), (self.folder / "tire.xml").read_text())
        run_program("export", "fmu", "--tire", "a50", "--effects", "slip_loss", "--fmi", 3, "--out", "tire.fmu",
                    folder=self.folder)
        self.assertEqual(rollrig.make_fmu("a50", effects=["slip_loss"], fmi_version=3),
                         (self.folder / "tire.fmu").read_bytes())

    def test_new_files(self):
        run_program("new", "tire", "--size", "205/55R16", "--load-index", 91, "--rrc", 8.2, "--out", "tire.toml",
                    folder=self.folder)
        tire = rollrig.new_tire("205/55R16", load_index=91, rrc_N_per_kN=8.2)
        self.assertEqual(list(tire.files().values()), [(self.folder / "tire.toml").read_text()])
        run_program("new", "vehicle", "--mass", 1900, "--drag-area", 0.6, "--out", "car.toml", folder=self.folder)
        self.assertEqual(list(rollrig.new_vehicle(mass_kg=1900, drag_area_m2=0.6).files().values()),
                         [(self.folder / "car.toml").read_text()])
        run_program("new", "rig", "--diameter", 1.7, "--out", "rig.toml", folder=self.folder)
        self.assertEqual(list(rollrig.new_rig(diameter_m=1.7).files().values()),
                         [(self.folder / "rig.toml").read_text()])
        known = {"tire": EXAMPLES / "hidden_effect" / "tire.toml", "rig": EXAMPLES / "hidden_effect" / "rig.toml"}
        run_program("new", "set", EXAMPLES / "own_logs", "--tire", known["tire"], "--rig", known["rig"], "--out",
                    self.folder / "import.toml")
        guessed = rollrig.new_set(EXAMPLES / "own_logs", beside=self.folder, **known)
        self.assertEqual(guessed.files(), {"import.toml": (self.folder / "import.toml").read_text()})
        with self.assertRaises(rollrig.InputError):
            rollrig.new_tire("205/55R", rrc_N_per_kN=8.2)
        with self.assertRaisesRegex(TypeError, "rrc"):
            rollrig.new_tire("205/55R16", rrc=8.2)

    def test_commands_that_have_no_function_are_those_of_the_documentation(self):
        """All others are compared in this folder; a new command belongs to one of the two."""
        compared = {"run", "sweep", "regress", "validate", "list", "describe", "diagnose", "plan", "import", "convert",
                    "align", "compare", "label", "export", "campaign new", "campaign new-diagnoses", "campaign run",
                    "campaign status", "campaign merge", "campaign export", "campaign sensitivity", "campaign summary",
                    "fit road-load", "fit tire", "fit drum-coastdown", "fit j2452", "fit j1269",
                    "fit default-road-load", "new tire", "new rig", "new vehicle", "new set", "export fmu"}
        without = {"serve", "completion", "man", "help", "campaign slurm"}
        listed = set()
        for command in self.list_commands():
            inner = self.list_commands(command) if command not in ("help", "man") else []
            listed.update(f"{command} {name}" for name in inner)
            if not inner or command == "export":
                listed.add(command)
        self.assertEqual(listed, compared | without)

    def list_commands(self, *of):
        """Names of subcommands, as the help has them."""
        _, found, after = run_program(*of, "--help").partition("\nSubcommands:\n")
        return re.findall(r"^  ([a-z][a-z0-9-]*)$", after.split("\n\n")[0], re.MULTILINE) if found else []

    def test_names(self):
        self.assertEqual(str(rollrig.describe("warm_up")), run_program("describe", "warm_up"))
        listed = run_program("list")
        for name in [*rollrig.scenarios(), *rollrig.effects(), *rollrig.assets("tires"), *rollrig.assets("cycles")]:
            self.assertIn(name, listed)
        self.assertEqual(rollrig.explain("bearing_warmup"), run_program("diagnose", "--explain", "bearing_warmup"))


if __name__ == "__main__":
    unittest.main()
