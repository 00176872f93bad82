"""What all results have in common."""

from __future__ import annotations

import json
import os
from functools import cached_property
from typing import Any

from . import _rollrig, notebook
from .settings import PathLike


class Report:
    """A result in the forms that the command line writes: text, JSON, page, test report, files.

    In Jupyter, the page is shown.
    """

    def __init__(self, made: _rollrig.Report) -> None:
        self._made = made

    @property
    def text(self) -> str:
        """As the command line prints it."""
        return self._made.text

    @property
    def json(self) -> str:
        """As --json writes it (docs/formats.md)."""
        return self._made.json

    @cached_property
    def data(self) -> dict[str, Any]:
        """The JSON, read: dicts, lists, numbers and texts under the keys of docs/formats.md."""
        return json.loads(self.json)  # type: ignore[no-any-return]

    def files(self) -> dict[str, str]:
        """What --out writes into a folder: content by name."""
        return self._made.make_files()

    def write(self, folder: PathLike, force: bool = False) -> None:
        """
        :api write_folder
        """
        self._made.write(os.fspath(folder), force)

    def page(self) -> str | None:
        """The page of --html, for any browser; None where there is none."""
        return self._made.make_page()

    def test_report(self) -> str | None:
        """The test report of --report, to print on A4; None where there is none."""
        return self._made.make_test_report()

    def __str__(self) -> str:
        return self.text

    def __repr__(self) -> str:
        return self.text

    def _repr_html_(self) -> str:
        return notebook.frame(self.page(), self.text)
