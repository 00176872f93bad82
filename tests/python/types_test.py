"""The package says its types, and the stub of its extension says what the extension has."""

import os
import subprocess
import sys
import tempfile
import unittest


class Types(unittest.TestCase):
    def check(self, *words):
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, "mypy.ini"), "w", encoding="ascii") as settings:
                settings.write("[mypy]\nstrict = True\nignore_missing_imports = True\n")
            # The metaclass and the constructor that pybind11 gives each class
            with open(os.path.join(folder, "allowed"), "w", encoding="ascii") as allowed:
                allowed.write(r"rollrig\._rollrig\.[A-Z]\w+(\.__init__)?" + "\n")
            done = subprocess.run([sys.executable, "-m", *words], capture_output=True, text=True, check=False, cwd=folder)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_are_consistent(self):
        self.check("mypy", "--config-file", "mypy.ini", "-p", "rollrig")

    def test_of_the_extension_are_complete(self):
        self.check("mypy.stubtest", "--mypy-config-file", "mypy.ini", "--allowlist", "allowed",
                   "--ignore-unused-allowlist", "rollrig._rollrig")


class DocStrings(unittest.TestCase):
    def test_tell_of_everything_public(self):
        import rollrig

        for name in rollrig.__all__:
            doc = getattr(rollrig, name).__doc__
            self.assertTrue(doc and not doc.strip().startswith(":"), name)
            self.assertNotRegex(doc, r"\b(Throws|Interrupted)\b|\b(empty|absent): ", name)
        self.assertIn("of ISO 28580", rollrig.new_tire.__doc__)
        self.assertIn("coastdowns on a road", rollrig.fit_road_load.__doc__)  # as include/rollrig/fit.h has it


if __name__ == "__main__":
    unittest.main()
