"""What is made of results and files: comparison, label, conversion, alignment, exports, regression."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from . import _rollrig
from .notebook import Progress, progress_display
from .report import Report
from .runs import Name
from .settings import (PathLike, make_uncertainty_options, take_given, to_flag, to_load_index, to_names,
                       to_optional_path, to_path, to_paths, to_plain, to_skip)


def compare(compared: Sequence[PathLike], *, scenario: str | None = None, threads: int = 0,
            skip_bad_rows: bool = False, progress: Progress = None) -> Report:
    """
    :api compare

    :members CompareInput
    """
    with progress_display(progress) as show:
        return Report(_rollrig.compare(show, to_paths(compared, "compared"), scenario, threads,
                                       to_skip(skip_bad_rows)))


def label(*, rrc_N_per_kN: float | None = None, rrc_sd_N_per_kN: float | None = None, tire_class: str | None = None,
          load_index: str | int | None = None, speed_symbol: str | None = None, is_severe_snow: bool = False,
          tire: Name = None) -> Report:
    """
    :api make_label

    :members LabelInput not known
    """
    given = {"rrc_N_per_kN": rrc_N_per_kN, "rrc_sd_N_per_kN": rrc_sd_N_per_kN, "tire_class": tire_class,
             "load_index": to_load_index(load_index, "load_index"), "speed_symbol": speed_symbol,
             "is_severe_snow": to_flag(is_severe_snow, "is_severe_snow"), "tire": tire}
    return Report(_rollrig.make_label(take_given(given)))


def convert(*, force_N: float | None = None, rrc_N_per_kN: float | None = None,
            measured: Mapping[str, float], wanted: Mapping[str, float], tire: Name = None,
            pressure_exponent: float | None = None, load_exponent: float | None = None,
            diameter_exponent: float | None = None, ambient_coefficient_per_K: float | None = None) -> Report:
    """
    :api convert_loss

    * force_N, rrc_N_per_kN: the loss, as one of the two; None: the other one.
    * measured, wanted: the conditions on both sides: drum_curvature_per_m (0 for the flat road), tire_diameter_m,
      pressure_Pa (gauge), ambient_K, load_N. What is absent is the same on both sides.
    :members ConversionInput no tire
    """
    given = {"force_N": force_N, "rrc_N_per_kN": rrc_N_per_kN, "tire": tire, "pressure_exponent": pressure_exponent,
             "load_exponent": load_exponent, "diameter_exponent": diameter_exponent,
             "ambient_coefficient_per_K": ambient_coefficient_per_K}
    return Report(_rollrig.convert_loss(take_given(given), to_plain(measured), to_plain(wanted)))


def align(file: PathLike, *, reference_values: Name = None, machine: str | None = None,
          reference_machine: str | None = None, reference: tuple[float, float] | None = None,
          preliminary: bool = False, first_excluded: bool = False, on: str | None = None,
          machine_changed: str | None = None, uncertainty: bool = False, monte_carlo: int = 0,
          seed: int = 1, threads: int = 0, progress: Progress = None) -> Report:
    """
    :api align

    * machine: the candidate machine; None: the only one of the file.
    :members AlignmentInput none
    :members UncertaintyOptions
    """
    given = {"file": file, "reference_values": reference_values, "machine": machine,
             "reference_machine": reference_machine, "reference": reference,
             "preliminary": to_flag(preliminary, "preliminary"),
             "first_excluded": to_flag(first_excluded, "first_excluded"), "on": on, "machine_changed": machine_changed}
    with progress_display(progress) as show:
        return Report(_rollrig.align(show, make_uncertainty_options(uncertainty, monte_carlo, seed, threads),
                                     take_given(given, "file")))


def apply_alignment(alignment: PathLike, rrc_N_per_kN: float, *, measurements: int = 1,
                    on: str | None = None, tire_class: str | None = None, uncertainty: bool = False, monte_carlo: int = 0, seed: int = 1,
                    threads: int = 0, progress: Progress = None) -> Report:
    """
    :api apply_alignment

    :members AlignedValueInput
    :members UncertaintyOptions
    """
    given = {"alignment": alignment, "rrc_N_per_kN": rrc_N_per_kN, "measurements": measurements, "on": on,
             "tire_class": tire_class}
    with progress_display(progress) as show:
        return Report(_rollrig.apply_alignment(show, make_uncertainty_options(uncertainty, monte_carlo, seed, threads),
                                               take_given(given, "alignment", "rrc_N_per_kN")))


def export_mat(source: PathLike, *, skip_bad_rows: bool = False) -> bytes:
    """The bytes of a .mat file.

    :api read_export

    * source: folder of a result or of a measurement set.
    """
    return _rollrig.export_bytes(to_path(source, "source"), True, to_skip(skip_bad_rows))


def export_hdf5(source: PathLike, *, skip_bad_rows: bool = False) -> bytes:
    """The bytes of an HDF5 file.

    :api read_export

    * source: folder of a result or of a measurement set.
    """
    return _rollrig.export_bytes(to_path(source, "source"), False, to_skip(skip_bad_rows))


def make_fmu(tire: PathLike, *, rig: PathLike = "road", effects: Sequence[str] = (), fmi_version: int = 2) -> bytes:
    """
    :api make_fmu

    :members FmuInput
    """
    given = {"tire": tire, "rig": rig, "effects": to_names(effects, "effects"), "fmi_version": fmi_version}
    return _rollrig.make_fmu(take_given(given, "tire"))


def vecto_tire(tire: PathLike, *, rrc_N_per_kN: float | None = None, manufacturer: str | None = None,
               model: str | None = None, certification_number: str | None = None, date: str | None = None,
               dimension: str | None = None) -> str:
    """
    :api make_vecto_tire

    :members VectoTireInput
    """
    return _rollrig.make_vecto_tire(take_given(locals(), "tire"))


def regress(folder: PathLike | None = None, *, threads: int = 0, progress: Progress = None) -> Report:
    """
    :api regress

    * folder: with run files and their goldens; None: that of the assets.
    """
    with progress_display(progress) as show:
        return Report(_rollrig.regress(show, to_optional_path(folder, "folder"), threads))
