"""`neuromech run`: one run of one document, with its results file, figures, summary and claims."""

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from rich.text import Text

from neuromech.analyse.claims import Verdict
from neuromech.cli.arguments import duration_argument
from neuromech.cli.consoles import notes
from neuromech.cli.files import folder_name
from neuromech.cli.films import show_left_out, write_film
from neuromech.cli.progress import simulated_time
from neuromech.cli.terminal import CLAIM_NOT_MET, ENDED_EARLY, FINISHED, note, write_json
from neuromech.cli.verdicts import claims_table
from neuromech.compiler.lower import lower
from neuromech.compiler.program import Program
from neuromech.compiler.records import recorded
from neuromech.errors import DocumentError, Problem
from neuromech.graph.model import BodyModel, ModelGraph
from neuromech.pipeline import build_graph, load_document
from neuromech.report.gait import gait_table
from neuromech.report.overview import Drawn, write_figures
from neuromech.report.replay import Motion, check_recorded
from neuromech.report.summary import metrics, summary_table
from neuromech.report.video import Film, load_av
from neuromech.simulate.recording import Recording
from neuromech.simulate.run import simulate
from neuromech.simulate.storage import save
from neuromech.verification import all_met, check_claims, judge_run

RESULTS_FILE = "recording.nc"
FIGURES_FOLDER = "figures"
VIDEO_FILE = "video.mp4"


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


@dataclass(frozen=True, slots=True)
class Finding:
    """What a run gave: recording, files, verdicts on its claims, and what figures that were left out lack."""

    recording: Recording
    files: Sequence[Path]
    verdicts: Sequence[Verdict]
    left_out: Mapping[str, Sequence[str]] = field(default_factory=dict)


def run(request: Request) -> int:
    """Run a document as asked; return the exit code.

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
        _check_filmable(graph)
    folder = _writable(request.out or Path("results") / folder_name(document.experiment.name))
    recording = _simulated(program, request, duration)
    drawn = _write(recording, folder, request, graph.body)
    verdicts = judge_run(document, recording) if _is_complete(recording, request) else []
    finding = Finding(recording, drawn.files, verdicts, drawn.reasons())
    if request.talks:
        _show(finding)
    if request.as_json:
        write_json(as_dict(finding))
    return exit_code(finding)


def as_dict(finding: Finding) -> dict[str, Any]:
    """Return a finding as plain values for JSON."""
    provenance = finding.recording.provenance
    outcome = finding.recording.outcome
    return {
        "outcome": {"kind": outcome.kind, "time": outcome.time, "message": outcome.message},
        "simulated_seconds": provenance.simulated_seconds,
        "wall_seconds": provenance.wall_seconds,
        "real_time_factor": provenance.simulated_seconds / provenance.wall_seconds,
        "metrics": metrics(finding.recording),
        "files": [str(file) for file in finding.files],
        "claims": [verdict.as_dict() for verdict in finding.verdicts],
    }


def exit_code(finding: Finding) -> int:
    """Return the exit code that a finding means."""
    if finding.recording.outcome.kind != "finished":
        return ENDED_EARLY
    return FINISHED if all_met(finding.verdicts) else CLAIM_NOT_MET


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


def _check_filmable(graph: ModelGraph) -> None:
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


def _write(recording: Recording, folder: Path, request: Request, body: BodyModel | None) -> Drawn:
    """Write the results file, figures and film that were asked for."""
    file = folder / RESULTS_FILE
    save(recording, file)
    drawn = Drawn((), {})
    if request.figures:
        drawn = write_figures(recording, folder / FIGURES_FOLDER, body=body)
    files = [file, *drawn.files]
    if request.video and body is not None:
        write_film(Motion(body, recording), folder / VIDEO_FILE, Film(), request.talks)
        files.append(folder / VIDEO_FILE)
    return Drawn(tuple(files), drawn.left_out)


def _is_complete(recording: Recording, request: Request) -> bool:
    """Tell whether claims can be judged by a run: a shortened one is another than the one that they are about."""
    return recording.outcome.kind == "finished" and request.duration is None


def _show(finding: Finding) -> None:
    out = notes()
    out.print(summary_table(finding.recording))
    gait = gait_table(finding.recording)
    if gait is not None:
        out.print(gait)
    if finding.verdicts:
        out.print(claims_table(finding.verdicts))
    outcome = finding.recording.outcome
    ending = f"{outcome.kind} at {outcome.time:g} s" + (f": {outcome.message}" if outcome.message else "")
    out.print(Text(ending, "green" if outcome.kind == "finished" else "bold red"))
    show_left_out(finding.left_out)
    for file in finding.files:
        note(f"wrote {file}")
