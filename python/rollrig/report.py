"""What all results have in common."""

from __future__ import annotations

import copy
import json
from functools import cached_property
from typing import TYPE_CHECKING, Any

from . import _rollrig, notebook
from .errors import Error
from .settings import PathLike, to_flag, to_path

if TYPE_CHECKING:
    from typing import Self


class Kept:
    """Replaces the extension's object of a result in a pickle.

    It holds the values of the object's properties, and what the object's methods return or raise.
    """

    def __init__(self, made: Any, properties: tuple[str, ...], methods: tuple[str, ...]) -> None:
        self._content = {name: getattr(made, name) for name in properties}
        self._returned: dict[str, Any] = {}
        self._raised: dict[str, Error] = {}
        for name in methods:
            try:
                self._returned[name] = getattr(made, name)()
            except Error as error:
                self._raised[name] = error

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        if name in self._content:
            return self._content[name]
        return lambda: self._return(name)

    def _return(self, method: str) -> Any:
        if method in self._raised:
            raise self._raised[method]
        return self._returned[method]

    def write(self, folder: bytes, force: bool) -> None:
        _rollrig.write_folder(folder, self._return("make_files"), force)


class Report:
    """A result in the forms that the command line writes: text, JSON, page, test report, files.

    In Jupyter, the page is shown. A pickle holds the result as it is, with page, test report and files.
    """

    _kept_properties: tuple[str, ...] = ("text", "json")
    _kept_methods: tuple[str, ...] = ("make_files", "make_page", "make_test_report")

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

        * folder: for the files; made where it is not there.
        """
        self._made.write(to_path(folder, "folder"), to_flag(force, "force"))

    def page(self) -> str | None:
        """The page of --html, for any browser; None where there is none."""
        return self._made.make_page()

    def test_report(self) -> str | None:
        """The test report of --report, to print on A4; None where there is none."""
        return self._made.make_test_report()

    def __getstate__(self) -> dict[str, Any]:
        made = self._made if isinstance(self._made, Kept) else Kept(self._made, self._kept_properties,
                                                                    self._kept_methods)
        return {**self._get_own_state(), "_made": made}

    def _get_own_state(self) -> dict[str, Any]:
        """What is not made of _made."""
        return {}

    def __copy__(self) -> Self:
        copied = self.__class__.__new__(self.__class__)
        copied.__dict__.update(self.__dict__)
        return copied

    def __deepcopy__(self, memo: Any) -> Self:
        copied = self.__class__.__new__(self.__class__)  # what the extension has made never changes
        copied.__dict__.update(copy.deepcopy(self._get_own_state(), memo), _made=self._made)
        return copied

    def __str__(self) -> str:
        return self.text

    def __repr__(self) -> str:
        return self.text

    def _repr_html_(self) -> str:
        return notebook.frame(self.page(), self.text)
