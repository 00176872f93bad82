"""Sweeps, campaigns, sets, fits and what is made of results: in Python as on the command line, to the bit."""

import contextlib
import csv
import io
import json
import math
import unittest

import numpy as np
import rollrig
from support import EXAMPLES, InFolder, run_program

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
        self.assertEqual(set(report.files()), set(self.read_files("joined")))

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

    def test_laws_of_rolling_resistance(self):
        self.check(rollrig.fit_j2452(EXAMPLES / "j2452_points.csv", uncertainty=True), "fit", "j2452",
                   EXAMPLES / "j2452_points.csv", "--uncertainty")
        self.check(rollrig.fit_j1269(EXAMPLES / "j1269_points.csv"), "fit", "j1269", EXAMPLES / "j1269_points.csv")

    def test_a_default_road_load(self):
        self.check(rollrig.default_road_load(mass_kg=1500, width_m=1.8, height_m=1.5), "fit", "default-road-load",
                   "--mass", 1500, "--width", 1.8, "--height", 1.5)


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

    def test_names(self):
        self.assertEqual(str(rollrig.describe("warm_up")), run_program("describe", "warm_up"))
        listed = run_program("list")
        for name in [*rollrig.scenarios(), *rollrig.effects(), *rollrig.assets("tires"), *rollrig.assets("cycles")]:
            self.assertIn(name, listed)
        self.assertEqual(rollrig.explain("bearing_warmup"), run_program("diagnose", "--explain", "bearing_warmup"))


if __name__ == "__main__":
    unittest.main()
