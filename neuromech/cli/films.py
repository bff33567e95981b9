"""What commands that draw share: a film, what it needs, and the words for figures that could not be drawn."""

from collections.abc import Mapping, Sequence
from pathlib import Path

from neuromech.cli.files import replace
from neuromech.cli.progress import drawn
from neuromech.cli.terminal import note
from neuromech.compiler.records import recorded
from neuromech.errors import DocumentError, Problem
from neuromech.graph.model import ModelGraph
from neuromech.report.replay import Motion, check_recorded
from neuromech.report.video import Film, load_av, write_video


def write_film(motion: Motion, out: Path, film: Film, talks: bool) -> None:
    """Write a film under its final name, with a progress bar where `talks`."""
    with drawn(talks) as progress:
        replace(out, lambda partial: write_video(motion, partial, film, progress))


def show_left_out(reasons: Mapping[str, Sequence[str]]) -> None:
    """Say which figures were left out, one line for each reason."""
    for reason, names in reasons.items():
        note(f"not drawn: {', '.join(names)} ({reason})")


def check_filmable(graph: ModelGraph) -> None:
    """Refuse a film before the run where there is nothing to film.

    Raises:
        DocumentError: there is no body.
        RecordingError: its motion will not be recorded.
        MissingExtraError: the package that writes films is not installed.
    """
    load_av()
    if graph.body is None:
        raise DocumentError([Problem("no-body", "--video", "needs a body, and the document has none")])
    groups = graph.document.experiment.record.values()
    check_recorded(graph.body, {name for group in groups for name in recorded(group.signals, graph)})
