"""The notebooks of examples/notebooks work, and come to what their text says."""

import os
import tempfile
import unittest

import nbformat
from nbclient import NotebookClient
from support import SOURCE

NOTEBOOKS = SOURCE / "examples" / "notebooks"


def execute(name):
    """What its cells show, as text."""
    notebook = nbformat.read(NOTEBOOKS / f"{name}.ipynb", as_version=4)
    with tempfile.TemporaryDirectory() as folder:
        os.environ.update(TMPDIR=folder, PYDEVD_DISABLE_FILE_VALIDATION="1")  # the notebook's own files; no warning
        NotebookClient(notebook, timeout=120, kernel_name="python3", resources={"metadata": {"path": folder}}).execute()
    outputs = [output for cell in notebook.cells if cell.cell_type == "code" for output in cell.outputs]
    return "\n".join(output.get("text") or output.get("data", {}).get("text/plain", "") for output in outputs), outputs


class Notebooks(unittest.TestCase):
    def test_have_no_outputs_in_the_repository(self):
        for path in NOTEBOOKS.glob("*.ipynb"):
            for cell in nbformat.read(path, as_version=4).cells:
                self.assertFalse(cell.get("outputs"), path)

    def test_a_tire_on_the_drum(self):
        text, outputs = execute("tire_on_the_drum")
        self.assertIn("5.204 N/kN", text)
        self.assertIn("did you mean pressure_kPa?", text)
        self.assertTrue(any("<iframe" in output.get("data", {}).get("text/html", "") for output in outputs))

    def test_own_data_to_a_cause(self):
        text, _ = execute("own_data_to_a_cause")
        self.assertIn("'explained'", text)
        self.assertIn("['bearing_warmup']", text)

    def test_the_range_of_an_ev(self):
        text, _ = execute("range_of_an_ev")
        self.assertIn("150 of 150", text)
        self.assertIn("ambient_degC", text)

    def test_a_rig_in_the_loop(self):
        text, _ = execute("rig_in_the_loop")
        self.assertIn("'named'", text)
        self.assertIn("[windage]", text)


if __name__ == "__main__":
    unittest.main()
