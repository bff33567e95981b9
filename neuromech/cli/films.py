"""What commands that draw share: a film with a progress bar, and the words for figures that could not be drawn."""

from collections.abc import Mapping, Sequence
from pathlib import Path

from neuromech.cli.files import replace
from neuromech.cli.progress import drawn
from neuromech.cli.terminal import note
from neuromech.report.replay import Motion
from neuromech.report.video import Film, write_video


def write_film(motion: Motion, out: Path, film: Film, talks: bool) -> None:
    """Write a film under its final name, with a progress bar where `talks`."""
    with drawn(talks) as progress:
        replace(out, lambda partial: write_video(motion, partial, film, progress))


def show_left_out(reasons: Mapping[str, Sequence[str]]) -> None:
    """Say which figures were left out, one line for each reason."""
    for reason, names in reasons.items():
        note(f"not drawn: {', '.join(names)} ({reason})")
