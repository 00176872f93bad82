"""The wheel, built without a network, works in a new environment, with its own libraries and assets."""

import os
import re
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

    def install(self, *options):
        """The interpreter of a new environment, in which nothing but the wheel is installed."""
        subprocess.run([SOURCE / "python" / "make_wheel.sh", os.environ["ROLLRIG_BUILD"], self.folder / "wheel", *options],
                       check=True, capture_output=True, env={**os.environ, "PYTHON": sys.executable})
        (wheel,) = (self.folder / "wheel").glob("rollrig-*.whl")
        self.run_outside(sys.executable, "-m", "venv", self.folder / "venv")
        python = self.folder / "venv" / "bin" / "python"
        self.run_outside(python, "-m", "pip", "install", "--no-index", "--no-deps", wheel)
        return python

    def list_libraries(self, python):
        """What a process has loaded after its first result."""
        told = self.run_outside(python, "-c", FIRST_LINES + "print(open('/proc/self/maps').read())")
        return {line.split()[-1] for line in told.splitlines() if ".so" in line}

    def test_is_installed_and_gives_a_first_result(self):
        python = self.install()
        self.assertRegex(self.run_outside(python, "-c", FIRST_LINES), r"^5\.2\d+ N/kN\n$")
        assets = self.run_outside(python, "-c", "import rollrig; print(rollrig.find_asset('tires', 'a50'))")
        self.assertTrue(assets.startswith(str(self.folder)), assets)
        own = [path for path in self.list_libraries(python) if "librollrig" in path]
        self.assertEqual(len(own), 3)
        for path in own:
            self.assertTrue(path.startswith(str(self.folder)), path)

    @unittest.skipUnless(os.environ.get("ROLLRIG_WHEEL_BUNDLE"), "takes long: the variable ROLLRIG_WHEEL_BUNDLE asks")
    def test_with_a_bundle_needs_no_library_of_debian(self):
        python = self.install("--bundle")
        others = [os.path.basename(path) for path in self.list_libraries(python)
                  if not path.startswith(str(self.folder)) and "/python3" not in path]
        known = re.compile(r"(ld-linux|lib(c|m|dl|pthread|rt|resolv|gcc_s|stdc\+\+|expat|z))[.-].*")  # or of Python
        self.assertEqual([name for name in others if not known.match(name)], [])


if __name__ == "__main__":
    unittest.main()
