"""All figures that a recording has the signals for."""

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from types import MappingProxyType

from matplotlib.figure import Figure

from neuromech.report.activity import activity_figure
from neuromech.report.feet import foot_path_figure, footfall_figure
from neuromech.report.joints import joint_angle_figure, phase_plane_figure
from neuromech.report.layout import FileFormat, save, style
from neuromech.report.muscles import muscle_force_figure
from neuromech.simulate.recording import Recording

FIGURES: Mapping[str, Callable[[Recording], Figure | None]] = MappingProxyType(
    {
        "activity": activity_figure,
        "joint_angles": joint_angle_figure,
        "phase_plane": phase_plane_figure,
        "muscle_forces": muscle_force_figure,
        "foot_path": foot_path_figure,
        "footfall": footfall_figure,
    }
)
"""File name without suffix -> what draws it; None from a figure means that its signals were not recorded."""


def write_figures(recording: Recording, folder: Path, formats: Sequence[FileFormat] = ("png",)) -> list[Path]:
    """Draw every figure that the recorded signals allow, and return the files.

    Raises:
        OSError: the folder cannot be written.
    """
    folder.mkdir(parents=True, exist_ok=True)
    written: list[Path] = []
    with style():
        for name, draw in FIGURES.items():
            figure = draw(recording)
            if figure is not None:
                written += save(figure, folder / name, formats)
    return written
