"""`neuromech figures`, `stills` and `video`: pictures of a run that is in a results file."""

from dataclasses import dataclass
from pathlib import Path

from neuromech.cli.arguments import size_argument, time_argument
from neuromech.cli.files import replace
from neuromech.cli.films import show_left_out, write_film
from neuromech.cli.terminal import FINISHED, note
from neuromech.errors import DocumentError, Problem, RecordingError
from neuromech.report.camera import Angle
from neuromech.report.layout import FileFormat, NotDrawableError, save, style
from neuromech.report.overview import write_figures
from neuromech.report.replay import Motion, recorded_body
from neuromech.report.scene import Picture
from neuromech.report.stills import stills_figure
from neuromech.report.video import Film, load_av
from neuromech.simulate.storage import load


@dataclass(frozen=True, slots=True)
class Stretch:
    """A part of a run as the user asked for it; None where the run's start or end is meant."""

    start: str | None
    end: str | None

    def times(self, last: float) -> tuple[float, float]:
        """Return start and end (s) within a run whose motion was recorded until `last` (s).

        Raises:
            DocumentError: a text is no time, or nothing of the run lies between them.
        """
        start = 0.0 if self.start is None else time_argument(self.start, "--from")
        end = last if self.end is None else time_argument(self.end, "--to")
        if not start < min(end, last):
            got = f"{start:g} s to {end:g} s"
            message = f"leaves nothing of a run that was recorded until {last:g} s"
            raise DocumentError([Problem("stretch", "--from, --to", message, got)])
        return start, min(end, last)


def figures(results: Path, out: Path, form: FileFormat, after: str | None) -> int:
    """Draw every figure of a results file into a folder; return the exit code.

    Raises:
        DocumentError: an argument is wrong.
        RecordingError: the results file cannot be used.
    """
    moment = None if after is None else time_argument(after, "--after")
    found = write_figures(load(results), out, (form,), after=moment)
    show_left_out(found.reasons())
    for file in found.files:
        note(f"wrote {file}")
    return FINISHED


def stills(results: Path, out: Path, stretch: Stretch, angle: Angle, number: int) -> int:
    """Write a strip of pictures of the body; return the exit code.

    Raises:
        DocumentError: an argument is wrong.
        RecordingError: the results file cannot be used, or does not hold the motion.
    """
    if out.suffix not in (".png", ".svg"):
        raise _wrong_suffix(out, ".png or .svg")
    recording = load(results)
    motion = Motion(recorded_body(recording), recording)
    window = None if stretch == Stretch(None, None) else stretch.times(motion.end)
    with style():
        try:
            figure = stills_figure(recording, motion.body, window, angle, number)
        except NotDrawableError as reason:
            raise RecordingError(str(reason)) from reason
        form: FileFormat = "svg" if out.suffix == ".svg" else "png"
        replace(out, lambda partial: save(figure, partial.with_suffix(""), (form,)))
    note(f"wrote {out}")
    return FINISHED


@dataclass(frozen=True, slots=True)
class VideoRequest:
    """A film as the user asked for it."""

    results: Path
    out: Path
    stretch: Stretch
    angle: Angle
    size: str
    frames_per_second: int
    slower: float


def video(request: VideoRequest) -> int:
    """Write a film of the body; return the exit code.

    Raises:
        DocumentError: an argument is wrong.
        RecordingError: the results file cannot be used, or does not hold the motion.
        MissingExtraError: the package that writes films is not installed.
    """
    if request.out.suffix != ".mp4":
        raise _wrong_suffix(request.out, ".mp4")
    load_av()
    picture = Picture(*size_argument(request.size, "--size"))
    recording = load(request.results)
    motion = Motion(recorded_body(recording), recording)
    start, end = request.stretch.times(motion.end)
    film = Film(request.angle, picture, request.frames_per_second, request.slower, start, end)
    write_film(motion, request.out, film, talks=True)
    note(f"wrote {request.out}")
    return FINISHED


def _wrong_suffix(out: Path, wanted: str) -> DocumentError:
    return DocumentError([Problem("suffix", "--out", f"must end in {wanted}", repr(str(out)))])
