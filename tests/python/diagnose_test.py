"""Diagnoses and loops in Python give what the command line writes, to the bit."""

import json
import unittest

import rollrig
from support import EXAMPLES, InFolder, run_program

FEW = ["bearing_warmup", "torque_zero_drift", "torque_gain", "load_exponent"]


class Diagnoses(InFolder):
    def test_a_set(self):
        told = run_program("diagnose", EXAMPLES / "hidden_effect", "--only", ",".join(FEW), "--json", "-", "--plan",
                           self.folder / "told")
        found = rollrig.diagnose(EXAMPLES / "hidden_effect", only=FEW)
        self.assertEqual(found.json, told)
        self.assertEqual(found.verdict, json.loads(told)["verdict"])
        self.assertEqual(set(found.probability), {*FEW, "none", "unknown"})
        self.assertEqual(found.write_plan(self.folder / "made"), (self.folder / "told").exists())
        self.assert_same_files(self.read_files("made"), self.read_files("told"))
        self.assertIn("<iframe", found._repr_html_())

    def test_a_loop(self):
        words = ["diagnose", EXAMPLES / "hidden_effect", "--loop", self.folder / "told", "--hours", 6, "--only",
                 ",".join(FEW)]
        run_program(*words)
        loop = rollrig.advance_loop(EXAMPLES / "hidden_effect", self.folder / "made", hours=6, only=FEW)
        made, told = self.read_files("made"), self.read_files("told")
        self.assert_same_files(made, told)
        self.assertEqual(loop.state, json.loads(told["loop.json"])["state"])
        again = rollrig.advance_loop(EXAMPLES / "hidden_effect", self.folder / "made", only=FEW)
        self.assertEqual(bool(again.missing), loop.state == "waiting")

    def test_a_tire_that_is_fitted(self):
        told = run_program("fit", "tire", EXAMPLES / "hidden_effect", "--json", "-")
        self.assertEqual(rollrig.fit_tire(EXAMPLES / "hidden_effect").json, told)

    def test_a_wrong_effect_is_named(self):
        with self.assertRaises(rollrig.InputError) as caught:
            rollrig.diagnose(EXAMPLES / "hidden_effect", only=["bearing_warmpu"])
        self.assertEqual(caught.exception.nearest, "bearing_warmup")


if __name__ == "__main__":
    unittest.main()
