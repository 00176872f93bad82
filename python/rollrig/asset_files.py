"""Scenarios, effects, and the files that names stand for."""

from __future__ import annotations

import difflib

from . import _rollrig
from .settings import PathLike, input_error, to_path, to_word


def scenarios() -> dict[str, str]:
    """The scenarios, each with a sentence; describe() tells more of one."""
    return _rollrig.list_scenarios()


def effects() -> dict[str, str]:
    """The effects, each with a sentence; explain() tells more of one."""
    return _rollrig.list_effects()


FOLDERS = ("tires", "rigs", "vehicles", "cycles", "sensors")


def to_folder(folder: str) -> str | bytes:
    """A folder of assets. What is no text in Unicode is left to the library."""
    word = to_word(folder, "folder")
    if isinstance(word, bytes) or not word.isprintable() or word in FOLDERS:
        return word
    nearest = (difflib.get_close_matches(word, FOLDERS, 1) or [""])[0]
    raise input_error(f"unknown folder of assets '{word}'", "folder", word, ", ".join(FOLDERS), nearest)


def assets(folder: str) -> list[str]:
    """
    :api list_assets

    * folder: "tires", "rigs", "vehicles", "cycles" or "sensors".
    """
    return _rollrig.list_assets(to_folder(folder))


def find_asset(folder: str, name_or_path: PathLike) -> str:
    """
    :api find_asset

    * folder: "tires", "rigs", "vehicles", "cycles" or "sensors".
    * name_or_path: of the file; a path stays as it is.
    """
    return _rollrig.find_asset(to_folder(folder), to_path(name_or_path, "name_or_path"))


def assets_folder() -> str:
    """
    :api find_assets_folder
    """
    return _rollrig.find_assets_folder()


class Description(str):
    """Text that Python shows as it is, over several lines."""

    def __repr__(self) -> str:
        return str(self)


def describe(name: PathLike) -> Description:
    """
    :api describe

    * name: of a scenario, an effect or an asset, or the path of a file.
    """
    return Description(_rollrig.describe(to_path(name, "name")))
