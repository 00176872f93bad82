"""The wheel, built without a network, works in a new environment, with its own libraries and assets."""

import os
import subprocess
import sys
import unittest

from support import SOURCE, InFolder

FIRST_LINES = """
import rollrig
result = rollrig.run("iso_28580", tire="a50")
print(result["rrc_25degC_2m_N_per_kN"])
"""


class Wheel(InFolder):
    def run_outside(self, *words):
        done = subprocess.run([*map(str, words)], capture_output=True, text=True, cwd="/", check=False,
                              env={"PATH": "/usr/bin:/bin", "HOME": str(self.folder)})
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def test_is_installed_and_gives_a_first_result(self):
        subprocess.run([SOURCE / "python" / "make_wheel.sh", os.environ["ROLLRIG_BUILD"], self.folder / "wheel"],
                       check=True, capture_output=True, env={**os.environ, "PYTHON": sys.executable})
        (wheel,) = (self.folder / "wheel").glob("rollrig-*.whl")
        self.run_outside(sys.executable, "-m", "venv", self.folder / "venv")
        python = self.folder / "venv" / "bin" / "python"
        self.run_outside(python, "-m", "pip", "install", "--no-index", "--no-deps", wheel)
        self.assertRegex(self.run_outside(python, "-c", FIRST_LINES), r"^5\.2\d+ N/kN\n$")
        assets = self.run_outside(python, "-c", "import rollrig; print(rollrig.find_asset('tires', 'a50'))")
        self.assertTrue(assets.startswith(str(self.folder)), assets)
        loaded = self.run_outside(python, "-c", "import rollrig; print(open('/proc/self/maps').read())")
        for line in loaded.splitlines():
            if "librollrig" in line:
                self.assertIn(str(self.folder), line)


if __name__ == "__main__":
    unittest.main()
