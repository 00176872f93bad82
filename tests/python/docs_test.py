"""The Python code of docs/python.md and README.md works as printed."""

import contextlib
import io
import re
import unittest

from support import SOURCE


class Pages(unittest.TestCase):
    def check(self, page):
        blocks = re.findall(r"```python\n(.*?)```", (SOURCE / page).read_text(encoding="utf-8"), re.DOTALL)
        self.assertTrue(blocks)
        names, told = {}, io.StringIO()
        with contextlib.redirect_stdout(told):
            for block in blocks:
                exec(block, names)
        # What a line prints stands behind it.
        for shown in re.findall(r"^ *print\(.*\)   # (.*)$", "\n".join(blocks), re.MULTILINE):
            self.assertIn(shown, told.getvalue())

    def test_python_md(self):
        self.check("docs/python.md")

    def test_readme(self):
        self.check("README.md")


if __name__ == "__main__":
    unittest.main()
