"""The package says its types, and the stub of its extension says what the extension has."""

import inspect
import os
import re
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
    def list_functions(self):
        """By name function and doc string of all that a user calls; a constructor's may be that of its class."""
        import rollrig

        made_by_the_package = {"CampaignState", "Diagnosis", "Error", "Estimate", "FileCheck", "Fit", "InputError",
                               "Loop", "MeasuredRun", "Report", "Result", "RunFailure", "SweepResult", "Value"}
        for name in rollrig.__all__:
            of = getattr(rollrig, name)
            if inspect.isfunction(of):
                yield name, of, of.__doc__
            for method, function in vars(of).items() if inspect.isclass(of) else ():
                if not inspect.isfunction(function):
                    continue
                if method == "__init__" and name not in made_by_the_package:
                    both = (of.__doc__, function.__doc__)
                    yield name, function, "\n".join(inspect.cleandoc(doc or "") for doc in both)
                elif not method.startswith("_"):
                    yield f"{name}.{method}", function, function.__doc__

    def test_tell_of_each_argument_and_what_none_means(self):
        checked = 0
        for name, function, doc in self.list_functions():
            parameters = [parameter for parameter in inspect.signature(function).parameters.values()
                          if parameter.name != "self"]
            if not parameters:
                continue
            said = {}
            for names, text in re.findall(r"^\* ([\w, ]+): (.*(?:\n  .*)*)", inspect.cleandoc(doc), re.MULTILINE):
                said.update({each.strip(): text for each in names.split(",")})
            for parameter in parameters:
                with self.subTest(f"{name}: {parameter.name}"):
                    self.assertIn(parameter.name, said)
                    if parameter.default is None:
                        self.assertRegex(said[parameter.name], r"\bNone\b")
                    checked += 1
            self.assertLessEqual(set(said), {parameter.name for parameter in parameters}, name)
        self.assertGreater(checked, 300)

    def test_have_the_words_of_the_headers_and_their_defaults(self):
        import rollrig

        self.assertIn("of ISO 28580", rollrig.new_tire.__doc__)
        self.assertIn("coastdowns on a road", rollrig.fit_road_load.__doc__)  # as include/rollrig/fit.h has it
        self.assertIn("* reference_temperature_K: 40 CFR 1066.305; None: 293.15\n", rollrig.fit_road_load.__doc__)


if __name__ == "__main__":
    unittest.main()
