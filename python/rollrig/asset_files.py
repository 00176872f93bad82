"""Scenarios, effects, and the files that names stand for."""

from __future__ import annotations

from . import _rollrig
from .settings import PathLike, to_path


def scenarios() -> dict[str, str]:
    """The scenarios, each with a sentence; describe() tells more of one."""
    return _rollrig.list_scenarios()


def effects() -> dict[str, str]:
    """The effects, each with a sentence; explain() tells more of one."""
    return _rollrig.list_effects()


def assets(folder: str) -> list[str]:
    """
    :api list_assets
    * folder: "tires", "rigs", "vehicles", "cycles" or "sensors".
    """
    return _rollrig.list_assets(folder)


def find_asset(folder: str, name_or_path: PathLike) -> str:
    """
    :api find_asset
    """
    return _rollrig.find_asset(folder, to_path(name_or_path, "name_or_path"))


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
    """
    return Description(_rollrig.describe(to_path(name, "name")))
