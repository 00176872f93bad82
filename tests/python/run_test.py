"""A run in Python gives what the command line writes, to the bit."""

import copy
import csv
import io
import json
import math
import multiprocessing
import os
import pathlib
import pickle
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import numpy as np
import rollrig
from support import EXAMPLES, InFolder, run_program

QUICK = {"fidelity": "quasi_static", "soak_h": 1, "warm_up_min": 2}


class Results(InFolder):
    def test_equal_the_files_of_the_command_line(self):
        told = run_program("run", "iso_28580", "--tire", "a50", "--set", "pressure_kPa=210.7", "--out",
                           self.folder / "out")
        result = rollrig.run("iso_28580", tire="a50", pressure_kPa=210.7)
        self.assert_same_files(result.files(), self.read_files("out"))
        self.assertEqual(result.json, result.files()["result.json"])
        self.assertTrue(told.startswith(result.text))
        result.write(self.folder / "again")
        self.assert_same_files(result.files(), self.read_files("again"))

    def test_are_the_numbers_of_the_json_with_units(self):
        result = rollrig.run("iso_28580", tire="a50", **QUICK)
        written = json.loads(run_program("run", "iso_28580", "--tire", "a50", "--fidelity", "quasi_static", "--set",
                                         "soak_h=1", "--set", "warm_up_min=2", "--json", "-"))["result"]
        self.assertEqual({name.split(".")[0] for name in result} | set(result.records), set(written))
        for name, value in result.items():
            outer, *inner = name.split(".")  # of an object in the JSON
            self.assertEqual(value, written[outer][inner[0]] if inner else written[outer], name)
        self.assertIn("tire_file.rrc_N_per_kN", result)
        for name, records in result.records.items():
            self.assertEqual(records, written[name], name)
        rrc = result["rrc_25degC_2m_N_per_kN"]
        self.assertEqual(rrc.unit, "N/kN")
        self.assertIn("2 m drum", rrc.doc)
        self.assertEqual(f"{rrc:.2f} {rrc.unit}", f"{float(rrc):.2f} N/kN")
        self.assertEqual(pickle.loads(pickle.dumps(rrc)).unit, "N/kN")

    def test_have_the_recording_as_arrays_and_as_a_table(self):
        result = rollrig.run("iso_28580", tire="a50", **QUICK)
        rows = list(csv.DictReader(io.StringIO(result.files()["recording.csv"])))
        self.assertEqual(list(rows[0]), ["time_s", "phase", *result.channels])
        for name, channel in result.channels.items():
            # The file has nine significant digits.
            np.testing.assert_allclose(channel, [float(row[name] or math.nan) for row in rows], rtol=5e-9, atol=1e-300)
        self.assertEqual(list(result.phase), [row["phase"] for row in rows])
        torque = result.channels["drum_torque_Nm"]
        self.assertEqual(torque.unit, "N m")
        self.assertEqual(torque[10:20].unit, "N m")
        self.assertFalse(hasattr(torque * 2, "unit"))  # what is computed may have another unit
        frame = result.to_pandas()
        self.assertEqual(frame.attrs["units"]["drum_torque_Nm"], "N m")
        np.testing.assert_array_equal(frame["drum_torque_Nm"], torque)
        np.testing.assert_array_equal(frame.index, result.time_s)

    def test_outlive_the_run_and_its_result(self):
        torque = rollrig.run("iso_28580", tire="a50", **QUICK).channels["drum_torque_Nm"]
        for _ in range(3):
            again = rollrig.run("iso_28580", tire="a50", **QUICK).channels["drum_torque_Nm"]
        np.testing.assert_array_equal(torque, again)

    def test_are_shown_in_jupyter_as_the_page(self):
        result = rollrig.run("iso_28580", tire="a50", **QUICK)
        self.assertIn("<html", result.page())
        self.assertIn("<iframe", result._repr_html_())
        self.assertIn("&lt;html", result._repr_html_())


class Copies(unittest.TestCase):
    def check(self, copied, result):
        self.assertEqual((copied.json, copied.text, copied.files()), (result.json, result.text, result.files()))
        self.assertEqual((copied.page(), copied.test_report()), (result.page(), result.test_report()))

    def test_of_results_are_pickles_too(self):
        result = rollrig.run("iso_28580", tire="a50", **QUICK)
        for copied in (pickle.loads(pickle.dumps(result)), copy.copy(result), copy.deepcopy(result),
                       pickle.loads(pickle.dumps(pickle.loads(pickle.dumps(result))))):
            self.check(copied, result)
            self.assertEqual(dict(copied), dict(result))
            self.assertEqual(copied["rrc_N_per_kN"].unit, "N/kN")
            self.assertEqual((copied.records, copied.warnings, copied.phases),
                             (result.records, result.warnings, result.phases))
            self.assertEqual(copied.mechanical_closure, result.mechanical_closure)
            np.testing.assert_array_equal(copied.channels["drum_torque_Nm"], result.channels["drum_torque_Nm"])
            self.assertEqual(copied.channels["drum_torque_Nm"].unit, "N m")
        with tempfile.TemporaryDirectory() as folder:
            copied.write(os.path.join(folder, "out"))
            self.assertEqual(sorted(os.listdir(os.path.join(folder, "out"))), sorted(result.files()))
            with self.assertRaises(rollrig.InputError):
                copied.write(os.path.join(folder, "out"))  # it is there
        changed = copy.deepcopy(result)
        changed.data["scenario"] = "another"
        self.assertEqual(result.data["scenario"], "iso_28580")

    def test_of_a_sweep_come_back_from_another_process(self):
        sweep = rollrig.sweep("iso_28580", vary={"pressure_kPa": [210, 250]}, tire="a50", **QUICK)
        copied = pickle.loads(pickle.dumps(sweep))
        self.check(copied, sweep)
        self.assertEqual((copied.axes, copied.failures), (sweep.axes, sweep.failures))
        self.assertEqual(list(copied["rrc_N_per_kN"]), list(sweep["rrc_N_per_kN"]))
        with multiprocessing.get_context("spawn").Pool(1) as pool:
            run = pool.apply(rollrig.run, ("iso_28580",), {"tire": "a50", **QUICK})
        self.assertGreater(run["rrc_N_per_kN"], 0)

    def test_of_channels_have_name_and_unit_and_only_a_copy_can_be_changed(self):
        result = rollrig.run("iso_28580", tire="a50", **QUICK)
        torque = result.channels["drum_torque_Nm"]
        for array in (torque, torque[1:3], result.time_s, result.phase, pickle.loads(pickle.dumps(torque)),
                      pickle.loads(pickle.dumps(result)).channels["drum_torque_Nm"]):
            with self.assertRaisesRegex(ValueError, "read-only"):
                array[0] = 0
        own = torque.copy()
        own[0] = 7.0
        self.assertEqual((copy.deepcopy(torque).unit, copy.deepcopy(torque).name), ("N m", "drum_torque_Nm"))
        frame = result.to_pandas()
        frame.loc[frame.index[0], "drum_torque_Nm"] = 7.0
        self.assertNotEqual(torque[0], 7.0)


class Arguments(InFolder):
    def test_of_a_wrong_type_are_named(self):
        road = EXAMPLES / "coastdowns.csv"
        for name, call in {
                "scenario": lambda: rollrig.run(5),
                "mass_kg": lambda: rollrig.fit_road_load(road, mass_kg="1500"),
                "file": lambda: rollrig.fit_road_load(None, mass_kg=1500),
                "yaw_degree": lambda: rollrig.evaluate_road_load(road, "j1263", mass_kg=1500, yaw_degree=1.5),
                "bounds": lambda: rollrig.fit_road_load(road, mass_kg=1500, bounds=(1, 2)),
                "target": lambda: rollrig.fit_road_load(road, mass_kg=1500, target=[1, 2]),
                "leave_out": lambda: rollrig.fit_road_load(road, mass_kg=1500, leave_out=[1]),
                "skip_bad_rows": lambda: rollrig.fit_road_load(road, mass_kg=1500, skip_bad_rows="no"),
                "monte_carlo": lambda: rollrig.run("iso_28580", tire="a50", monte_carlo="many"),
                "uncertainty": lambda: rollrig.run("iso_28580", tire="a50", uncertainty="no"),
                "threads": lambda: rollrig.sweep("iso_28580", tire="a50", vary={"pressure_kPa": [1]}, threads=1.5),
                "vary": lambda: rollrig.sweep("iso_28580", tire="a50", vary=[210]),
                "vary: pressure_kPa": lambda: rollrig.sweep("iso_28580", tire="a50", vary={"pressure_kPa": 210}),
                "progress": lambda: rollrig.run("iso_28580", tire="a50", progress="yes"),
                "compared": lambda: rollrig.compare("one"),
                "folders": lambda: rollrig.diagnose_fleet("one"),
                "folder": lambda: rollrig.MeasurementSet(3),
                "rrc_N_per_kN": lambda: rollrig.label(rrc_N_per_kN=[8.4]),
                "tire": lambda: rollrig.label(tire=3),
                "columns": lambda: rollrig.new_set("logs", columns=["a"]),
                "values: ambient_degC": lambda: rollrig.new_set("logs", values={"ambient_degC": "warm"}),
                "set": lambda: rollrig.fit_tire(3),
                "a": lambda: rollrig.diagnose_pair(3, EXAMPLES / "hidden_effect"),
                "warm_up": lambda: rollrig.new_tire("205/55R16", warm_up=3),
        }.items():
            with self.subTest(name), self.assertRaisesRegex(TypeError, f"argument '{name}'"):
                call()

    def test_are_paths_that_are_no_utf_8(self):
        path = os.path.join(os.fsencode(self.folder), b"coast\xe9.csv")
        with open(path, "wb") as file:
            file.write((EXAMPLES / "coastdowns.csv").read_bytes())
        for given in (path, os.fsdecode(path), pathlib.Path(os.fsdecode(path))):
            with self.assertRaisesRegex(rollrig.InputError, "not UTF-8") as caught:
                rollrig.fit_road_load(given, mass_kg=1500)
            self.assertEqual(caught.exception.file, os.fsdecode(path))
            with self.assertRaisesRegex(rollrig.InputError, "not UTF-8"):
                rollrig.run("iso_28580", tire=given)
        report = rollrig.fit_road_load(os.fsencode(EXAMPLES / "coastdowns.csv"), mass_kg=1500)
        folder = os.path.join(os.fsencode(self.folder), b"out\xe9")
        report.write(folder)
        self.assertTrue(os.path.exists(os.path.join(folder, b"road_load.json")))

    def test_have_no_lone_surrogates_and_no_nul_characters(self):
        for bad in ("a\ud800", "a\0b", b"a\0b", pathlib.Path("a\0b")):
            for call in (lambda: rollrig.MeasurementSet(bad), lambda: rollrig.run("iso_28580", tire=bad),
                         lambda: rollrig.run(bad), lambda: rollrig.run("iso_28580", tire="a50", method=bad)):
                with self.assertRaises(rollrig.InputError):
                    call()


class Settings(InFolder):
    def test_take_lists_mappings_numbers_of_numpy_and_paths(self):
        asset = rollrig.Run("speed_sweep", tire="a50", fidelity="quasi_static", speeds_km_h=np.array([80, 120]),
                            effects={"bearing_warmup": {"fall_per_K": np.float64(0.02)}}, warm_up_min=5)
        settings = json.loads(asset.carry_out().files()["manifest.json"])
        self.assertEqual(settings["settings"]["speeds_km_h"], [80.0, 120.0])
        self.assertEqual(settings["effects"]["bearing_warmup"]["fall_per_K"], 0.02)

    def test_a_wrong_effect_is_refused_without_numbers_too(self):
        with self.assertRaises(rollrig.InputError) as caught:
            rollrig.run("transient_skim", tire="a50", effects={"slip_los": {}})
        self.assertEqual(caught.exception.nearest, "slip_loss")

    def test_an_effect_that_needs_a_table_that_the_tire_lacks_is_refused_before_the_run(self):
        tables = {"geometry": {"outer_diameter_m": 0.67, "section_width_m": 0.235, "rim_diameter_m": 0.48,
                               "mass_kg": 10.5, "wheel_mass_kg": 14.0, "spin_inertia_kg_m2": 1.35},
                  "stiffness": {"vertical_N_per_m": 220000.0, "vertical_damping_N_s_per_m": 300.0,
                                "slip_stiffness_N": 75000.0, "relaxation_length_m": 0.3},
                  "thermal": {"heat_capacity_J_per_K": 17000.0, "gas_heat_capacity_J_per_K": 73.0, "H_gas_W_per_K": 4.0,
                              "conductance_at_rest_W_per_K": 12.0, "conductance_per_speed_W_s_per_m_K": 1.0},
                  "constant": {"rrc_N_per_kN": 8.0}}
        lines = ['format = "rollrig-tire/2"', 'name = "trial"', 'model = "constant_rrc"']
        for table, numbers in tables.items():
            lines += [f"[{table}]", *(f"{key} = {value}" for key, value in numbers.items())]
        (self.folder / "trial.toml").write_text("\n".join(lines) + "\n")
        program = self.folder / "program.csv"
        program.write_text("time_s,speed_km_h,load_N,longitudinal_force_N,ambient_degC\n"
                           "0,30,4800,50,20\n60,90,4800,200,20\n")
        drum = {"pressure_kPa": 210, "load_N": 4000, "warm_up_min": 5}
        for scenario, given in (("warm_up", drum), ("drive_cycle", {"pressure_kPa": 210}),
                                ("follow_roller", {"pressure_kPa": 210, "program": program})):
            known = {"tire": self.folder / "trial.toml", "fidelity": "quasi_static", **given}
            rollrig.Run(scenario, **known)
            rollrig.Run(scenario, effects={"bearing_warmup": {}}, **known)
            with self.assertRaisesRegex(rollrig.InputError, r"\[rolling_resistance\]") as caught:
                rollrig.Run(scenario, effects={"load_exponent": {}}, **known)
            self.assertEqual((caught.exception.value, os.path.basename(caught.exception.file)),
                             ("load_exponent", "trial.toml"))

    def test_no_values_and_no_sets_are_refused(self):
        with self.assertRaises(rollrig.InputError):
            rollrig.sweep("iso_28580", tire="a50", vary={"pressure_kPa": []})
        with self.assertRaises(rollrig.InputError):
            rollrig.diagnose_fleet([])

    def test_a_wrong_one_says_what_is_allowed_and_what_is_near(self):
        with self.assertRaises(rollrig.Error) as caught:
            rollrig.run("iso_28580", tire="a50", presure_kPa=210)
        error = caught.exception
        self.assertIsInstance(error, ValueError)
        self.assertEqual((error.nearest, error.value, error.file), ("pressure_kPa", "210", "--set"))
        self.assertIn("presure_kPa", error.key)
        self.assertIn("speed_km_h", error.allowed)
        self.assertIsNone(error.line)
        self.assertEqual(pickle.loads(pickle.dumps(error)).nearest, "pressure_kPa")

    def test_an_error_in_a_file_has_its_line(self):
        (self.folder / "run.toml").write_text('format = "rollrig-run/1"\nscenario = "iso_28580"\ntire = "a55"\n')
        with self.assertRaises(rollrig.InputError) as caught:
            rollrig.run(self.folder / "run.toml")
        self.assertEqual((caught.exception.line, caught.exception.nearest), (3, "a50"))
        self.assertTrue(caught.exception.file.endswith("run.toml"))


class Calls(unittest.TestCase):
    def test_tell_their_progress_to_the_calling_thread(self):
        told = []
        rollrig.run("iso_28580", tire="a50", measurement_cycles=20,
                    progress=lambda done, stage: told.append((threading.current_thread(), done)))
        self.assertTrue(told)
        self.assertEqual({thread for thread, done in told}, {threading.current_thread()})
        self.assertEqual([done for thread, done in told], sorted(done for thread, done in told))

    def test_stop_when_the_progress_raises_and_leave_the_next_call_alone(self):
        def refuse(done, stage):
            raise LookupError("enough")

        with self.assertRaisesRegex(LookupError, "enough"):
            rollrig.run("iso_28580", tire="a50", measurement_cycles=100, progress=refuse)
        self.assertGreater(rollrig.run("iso_28580", tire="a50", **QUICK)["rrc_N_per_kN"], 0)

    def test_go_on_when_the_progress_of_another_thread_raises(self):
        self.check_others_go_on(LookupError)

    def test_go_on_when_the_progress_of_the_main_thread_raises_keyboard_interrupt(self):
        self.check_others_go_on(KeyboardInterrupt)

    def check_others_go_on(self, raised):
        begun, raised_s, results = threading.Event(), [], []

        def simulate():
            results.append(rollrig.run("iso_28580", tire="a50", measurement_cycles=100, measurement_min=600,
                                       progress=lambda done, stage: begun.set()))

        def refuse(done, stage):
            raised_s.append(time.monotonic())
            raise raised("enough")

        thread = threading.Thread(target=simulate)
        thread.start()
        begun.wait()  # it takes several times as long as the sweep until that raises
        with self.assertRaisesRegex(raised, "enough"):
            rollrig.sweep("iso_28580", tire="a50", vary={"pressure_kPa": np.linspace(200, 300, 2000)}, threads=2,
                          progress=refuse)
        self.assertLess(time.monotonic() - raised_s[0], 20)  # threads of the call have stopped too: it takes minutes
        thread.join()
        self.assertEqual(len(results), 1)

    def test_of_a_daemon_thread_end_with_the_interpreter(self):
        program = ("import threading, time, rollrig\n"
                   "begun = threading.Event()\n"
                   "def simulate():\n"
                   "  rollrig.run('iso_28580', tire='a50', measurement_cycles=100, measurement_min=600,\n"
                   "              progress=lambda done, stage: begun.set())\n"
                   "threading.Thread(target=simulate, daemon=True).start()\n"
                   "begun.wait()\n")
        done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=60, check=False)
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def check_interrupted(self, program, output):
        """Sends Ctrl-C to a program once it has printed a line; its runs would take longer than the time allowed."""
        started = subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, text=True)
        started.stdout.readline()
        time.sleep(0.5)
        asked_s = time.monotonic()
        started.send_signal(signal.SIGINT)
        out, _ = started.communicate(timeout=60)
        self.assertEqual(out, output)
        self.assertLess(time.monotonic() - asked_s, 20)

    def test_of_other_threads_stop_at_ctrl_c_too(self):
        program = ("import threading, rollrig\n"
                   "def simulate(progress):\n"
                   "  try:\n"
                   "    rollrig.run('iso_28580', tire='a50', measurement_cycles=100, measurement_min=600,\n"
                   "                progress=progress)\n"
                   "  except KeyboardInterrupt:\n"
                   "    print('stopped', flush=True)\n"
                   "begun = threading.Event()\n"
                   "thread = threading.Thread(target=simulate, args=[lambda done, stage: begun.set()])\n"
                   "thread.start()\n"
                   "begun.wait()\n"
                   "print('begun', flush=True)\n"
                   "simulate(False)\n"
                   "thread.join()\n")
        self.check_interrupted(program, "stopped\nstopped\n")

    def test_stop_at_ctrl_c(self):
        program = ("import rollrig\ntry:\n  print('begun', flush=True)\n"
                   "  rollrig.run('iso_28580', tire='a50', measurement_cycles=100, measurement_min=600)\n"
                   "except KeyboardInterrupt:\n"
                   f"  print(rollrig.run('iso_28580', tire='a50', **{QUICK!r})['method'])\n")
        self.check_interrupted(program, "torque\n")  # stopped, and ready for the next call

    def test_let_other_threads_work(self):
        counted = 0
        ended = threading.Event()

        def simulate():
            rollrig.run("iso_28580", tire="a50", measurement_cycles=20)
            ended.set()

        thread = threading.Thread(target=simulate)
        thread.start()
        while not ended.is_set():
            counted += 1
            time.sleep(0.001)
        thread.join()
        self.assertGreater(counted, 50)


class Import(unittest.TestCase):
    def run_python(self, program):
        done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=60, check=False)
        self.assertEqual(done.stderr, "")
        return done.stdout

    def test_in_a_subinterpreter_is_refused_and_leaves_the_main_one_alone(self):
        inside = ("try:\n  import rollrig\n"
                  "except ImportError as error:\n  print(error, flush=True)\n")
        begin = ("import _xxsubinterpreters as interpreters\n"
                 f"def try_inside():\n  interpreters.run_string(interpreters.create(), {inside!r})\n")
        run = f"import rollrig\nprint(rollrig.run('iso_28580', tire='a50', **{QUICK!r})['method'], flush=True)\n"
        refused = "rollrig works in the main interpreter alone, not in a subinterpreter\n"
        self.assertEqual(self.run_python(begin + "try_inside()\ntry_inside()\n" + run + "try_inside()\n" + run),
                         2 * refused + "torque\n" + refused + "torque\n")

    def test_again_gives_the_same_extension(self):
        again = ("import sys, rollrig\nfirst = rollrig._rollrig\n"
                 "for name in [name for name in sys.modules if name.startswith('rollrig')]:\n  del sys.modules[name]\n"
                 "import rollrig\nprint(rollrig._rollrig is first, rollrig._rollrig.__name__)\n"
                 f"print(rollrig.run('iso_28580', tire='a50', **{QUICK!r})['method'])\n")
        self.assertEqual(self.run_python(again), "True rollrig._rollrig\ntorque\n")


if __name__ == "__main__":
    unittest.main()
