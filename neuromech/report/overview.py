"""All figures that a recording has the signals for."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType

from matplotlib.figure import Figure

from neuromech.graph.model import BodyModel
from neuromech.report.activity import activity_figure
from neuromech.report.correlations import correlation_figure
from neuromech.report.cycle import activation_figure, cycle_figure, torque_figure
from neuromech.report.feet import foot_path_figure
from neuromech.report.footfall import flexor_contact_figure, footfall_figure, load_figure
from neuromech.report.joints import joint_angle_figure, phase_plane_figure
from neuromech.report.layout import FileFormat, NotDrawableError, save, style
from neuromech.report.lever_arms import lever_arm_figure
from neuromech.report.muscles import muscle_force_figure
from neuromech.report.pushes import push_series_figure
from neuromech.report.recovery import recovery_figure
from neuromech.report.replay import NO_BODY, has_body
from neuromech.report.speed import speed_figure
from neuromech.report.stills import stills_figure
from neuromech.report.terrain import terrain_figure
from neuromech.report.trunk import inclination_figure
from neuromech.report.vertical_force import vertical_force_figure
from neuromech.simulate.recording import Recording

FIGURES: Mapping[str, Callable[[Recording], Figure]] = MappingProxyType(
    {
        "activity": activity_figure,
        "joint_angles": joint_angle_figure,
        "cycle": cycle_figure,
        "cycle_torques": torque_figure,
        "cycle_activations": activation_figure,
        "phase_plane": phase_plane_figure,
        "muscle_forces": muscle_force_figure,
        "foot_path": foot_path_figure,
        "footfall": footfall_figure,
        "leg_loads": load_figure,
        "vertical_force": vertical_force_figure,
        "correlations": correlation_figure,
        "flexor_contact": flexor_contact_figure,
        "inclination": inclination_figure,
        "speed": speed_figure,
        "push_series": push_series_figure,
        "terrain": terrain_figure,
        "lever_arms": lever_arm_figure,
    }
)
"""File name without suffix -> what draws it."""


@dataclass(frozen=True, slots=True)
class Drawn:
    """What came of drawing figures.

    Args:
        files: that were written.
        left_out: figure that could not be drawn -> what it lacks.
    """

    files: tuple[Path, ...]
    left_out: Mapping[str, str]

    def reasons(self) -> dict[str, list[str]]:
        """Return what is lacking -> the figures that lack it."""
        found: dict[str, list[str]] = {}
        for figure, reason in self.left_out.items():
            found.setdefault(reason, []).append(figure)
        return found


def write_figures(
    recording: Recording,
    folder: Path,
    formats: Sequence[FileFormat] = ("png",),
    body: BodyModel | None = None,
    after: float | None = None,
) -> Drawn:
    """Draw every figure that the recorded signals allow.

    Args:
        recording: of a run.
        folder: for the files.
        formats: of the files.
        body: the body that was recorded; that of the recorded document where None is given.
        after: time (s) of a disturbance, for the figure `recovery`; that of the protocol where None is given.

    Raises:
        OSError: the folder cannot be written.
    """
    folder.mkdir(parents=True, exist_ok=True)
    without_body = body is None and not has_body(recording)
    drawers: dict[str, Callable[[Recording], Figure]] = {
        **FIGURES,
        "recovery": lambda one: recovery_figure(one, after),
        "stills": lambda one: stills_figure(one, body),
    }
    written: list[Path] = []
    left_out: dict[str, str] = {}
    with style():
        for name, draw in drawers.items():
            try:
                figure = draw(recording)
            except NotDrawableError as reason:
                left_out[name] = NO_BODY if without_body else str(reason)
                continue
            written += save(figure, folder / name, formats)
    return Drawn(tuple(written), left_out)
