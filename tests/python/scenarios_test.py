"""Every scenario in Python gives what the command line writes, to the bit: files, pages, set, and uncertainty."""

import unittest

import rollrig
from support import InFolder, run_program

PROGRAMS = {
    "follow_drum": "time_s,speed_km_h,load_N,ambient_degC\n0,0,4800,20\n20,80,4800,20\n600,80,4800,22\n"
                   "620,120,5200,22\n900,120,5200,22\n",
    "follow_roller": "time_s,speed_km_h,load_N,longitudinal_force_N,ambient_degC\n0,30,4800,50,20\n60,90,4800,200,20\n"
                     "300,90,5200,200,24\n",
    "follow_road": "time_s,speed_km_h,elevation_m,ambient_degC\n0,0,10,20\n60,50,12,20\n200,50,8,20\n260,0,8,20\n",
}
LONG = {"drive_cycle", "dyno_setting", "sae_j1634"}  # minutes with bodies
QUASI_STATIC_ALONE = {"follow_roller", "follow_road"}


class Scenarios(InFolder):
    def check(self, scenario, fidelity):
        at = self.folder / f"{scenario}-{fidelity}"
        at.mkdir()
        settings = {}
        if scenario in PROGRAMS:
            (at / "program.csv").write_text(PROGRAMS[scenario])
            settings["program"] = at / "program.csv"
        given = {"tire": "a50", "fidelity": fidelity, **settings}
        run = rollrig.Run(scenario, **given)
        if run.has_sensors:
            given.update(sensors="source", seed=7)
        words = [f"--{key}={value}" for key, value in given.items() if key not in settings]
        words += [f"--set={key}={value}" for key, value in settings.items()]
        words += ["--out", at / "out", "--html", at / "page.html"]
        if run.writes_set:
            words += ["--write-set", at / "set"]
        asked = {}
        if run.has_uncertainty:
            words += ["--uncertainty", "--monte-carlo", 100, "--threads", 0]
            asked = {"uncertainty": True, "monte_carlo": 100}
        result = rollrig.run(scenario, **given, **asked)
        report = result.test_report()
        if report is not None:
            words += ["--report", at / "report.html"]
        told = run_program("run", scenario, *words)
        self.assert_same_files(result.files(), self.read_files(at / "out"))
        self.assertTrue(result.page() == (at / "page.html").read_bytes().decode(), "page")
        self.assertTrue(report is None or report == (at / "report.html").read_bytes().decode(), "report")
        self.assertIn(result.text, told)
        if run.writes_set:
            result.write_set(at / "made")
            self.assert_same_files(self.read_files(at / "made"), self.read_files(at / "set"))

    def test_give_what_the_command_line_writes(self):
        listed = list(rollrig.scenarios())
        self.assertLess(LONG | QUASI_STATIC_ALONE | set(PROGRAMS), set(listed))
        for scenario in listed:
            for fidelity in ("multibody", "quasi_static"):
                if fidelity == "multibody" and scenario in LONG | QUASI_STATIC_ALONE:
                    continue
                with self.subTest(scenario, fidelity=fidelity):
                    self.check(scenario, fidelity)


if __name__ == "__main__":
    unittest.main()
