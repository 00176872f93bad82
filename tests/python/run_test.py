"""A run in Python gives what the command line writes, to the bit."""

import csv
import io
import json
import math
import pickle
import signal
import subprocess
import sys
import threading
import time
import unittest

import numpy as np
import rollrig
from support import InFolder, run_program

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

    def test_stop_in_all_threads_when_the_progress_of_one_raises(self):
        started, raised = threading.Event(), []

        def simulate():
            try:
                rollrig.run("iso_28580", tire="a50", measurement_cycles=100, measurement_min=600,
                            progress=lambda done, stage: started.set())
            except KeyboardInterrupt as error:
                raised.append(error)

        def refuse(done, stage):
            if started.is_set():
                raise LookupError("enough")

        thread = threading.Thread(target=simulate)
        thread.start()
        with self.assertRaisesRegex(LookupError, "enough"):
            rollrig.run("iso_28580", tire="a50", measurement_cycles=100, measurement_min=600, progress=refuse)
        thread.join()
        self.assertEqual(len(raised), 1)

    def test_stop_at_ctrl_c(self):
        program = ("import rollrig\ntry:\n  print('begun', flush=True)\n"
                   "  rollrig.run('iso_28580', tire='a50', measurement_cycles=100, measurement_min=600)\n"
                   "except KeyboardInterrupt:\n"
                   f"  print(rollrig.run('iso_28580', tire='a50', **{QUICK!r})['method'])\n")
        started = subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, text=True)
        started.stdout.readline()
        time.sleep(0.5)
        asked_s = time.monotonic()
        started.send_signal(signal.SIGINT)
        out, _ = started.communicate(timeout=60)
        self.assertEqual(out, "torque\n")  # stopped, and ready for the next call
        self.assertLess(time.monotonic() - asked_s, 20)  # the whole run takes longer

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


if __name__ == "__main__":
    unittest.main()
