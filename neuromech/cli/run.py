"""`neuromech run`: one run of one document, with its results file, figures, summary and claims."""

import os
from dataclasses import dataclass
from pathlib import Path

from neuromech.cli.arguments import duration_argument
from neuromech.cli.files import folder_name
from neuromech.cli.progress import simulated_time
from neuromech.compiler.lower import lower
from neuromech.compiler.program import Program
from neuromech.pipeline import build_graph, load_document
from neuromech.simulate.recording import Recording
from neuromech.simulate.run import simulate
from neuromech.verification import check_claims


@dataclass(frozen=True, slots=True)
class Request:
    """What the user asked for on the command line; None where the document decides."""

    spec: Path
    overrides: tuple[str, ...]
    seed: int | None
    duration: str | None
    out: Path | None
    as_json: bool
    figures: bool
    quiet: bool
    video: bool = False

    @property
    def talks(self) -> bool:
        """Whether progress, tables and notes are shown."""
        return not self.quiet


def run(request: Request) -> int:
    """Run a document as asked; return the exit code.

    What draws and writes takes a second to import, for which nobody should wait before the first step.

    Raises:
        DocumentError: the document or an argument is wrong.
        RecordingError: the results cannot be written.
    """
    duration = None if request.duration is None else duration_argument(request.duration, "--duration")
    document = load_document(request.spec, request.overrides)
    check_claims(document)
    graph = build_graph(document)
    program = lower(graph)
    if request.video:
        from neuromech.cli.films import check_filmable

        check_filmable(graph)
    folder = _writable(request.out or Path("results") / folder_name(document.experiment.name))
    recording = _simulated(program, request, duration)
    from neuromech.cli.findings import finish

    return finish(recording, graph, request, folder)


def _writable(folder: Path) -> Path:
    """Make the output folder before the run, so that a long run is not lost to it.

    Raises:
        OSError: the folder cannot be made or written.
    """
    folder.mkdir(parents=True, exist_ok=True)
    if not os.access(folder, os.W_OK | os.X_OK):
        raise PermissionError(13, "the folder is not writable", str(folder))
    return folder


def _simulated(program: Program, request: Request, duration: float | None) -> Recording:
    protocol = program.graph.document.experiment.protocol
    with simulated_time(duration or float(protocol.duration), request.talks) as progress:
        return simulate(program, seed=request.seed, duration=duration, progress=progress)
