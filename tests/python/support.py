"""What the tests of the Python package share."""

import os
import pathlib
import subprocess
import tempfile
import unittest

PROGRAM = os.environ["ROLLRIG_PROGRAM"]
SOURCE = pathlib.Path(os.environ["ROLLRIG_SOURCE"])
EXAMPLES = SOURCE / "assets" / "examples"


def run_program(*words, folder=None, status=0):
    """What the command line prints; the test fails where it ends with another status."""
    done = subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, cwd=folder, check=False)
    if done.returncode != status:
        raise AssertionError(f"rollrig {' '.join(map(str, words))}: {done.stderr}")
    return done.stdout


def run_failing_program(*words):
    """What the command line says of a wrong input."""
    done = subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, check=False)
    if done.returncode != 2:
        raise AssertionError(f"rollrig {' '.join(map(str, words))}: status {done.returncode}")
    return done.stderr


class InFolder(unittest.TestCase):
    """Each test has a folder of its own."""

    def setUp(self):
        made = tempfile.TemporaryDirectory()
        self.addCleanup(made.cleanup)
        self.folder = pathlib.Path(made.name)

    def assert_same_files(self, made, told):
        self.assertEqual(set(made), set(told))
        for name, content in made.items():
            self.assertTrue(content == told[name], name)  # a difference of long texts would take minutes to find

    def read_files(self, name):
        return {str(path.relative_to(self.folder / name)): path.read_text()
                for path in (self.folder / name).rglob("*") if path.is_file()}
