"""`neuromech run`: one run of one document, with its results file, figures, summary and claims."""

import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pydantic_core import PydanticCustomError
from rich.text import Text

from neuromech.analyse.claims import Verdict
from neuromech.cli.consoles import notes
from neuromech.cli.files import folder_name
from neuromech.cli.progress import simulated_time
from neuromech.cli.terminal import CLAIM_NOT_MET, ENDED_EARLY, FINISHED, note, write_json
from neuromech.cli.verdicts import claims_table
from neuromech.compiler.lower import lower
from neuromech.compiler.program import Program
from neuromech.errors import DocumentError, Problem
from neuromech.pipeline import build_graph, load_document
from neuromech.report.gait import gait_table
from neuromech.report.overview import write_figures
from neuromech.report.summary import metrics, summary_table
from neuromech.simulate.recording import Recording
from neuromech.simulate.run import simulate
from neuromech.simulate.storage import save
from neuromech.units import TIME
from neuromech.verification import all_met, check_claims, judge_run

RESULTS_FILE = "recording.nc"
FIGURES_FOLDER = "figures"


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

    @property
    def talks(self) -> bool:
        """Whether progress, tables and notes are shown."""
        return not self.quiet


@dataclass(frozen=True, slots=True)
class Finding:
    """What a run gave: the recording, the files that were written, and the verdicts on its claims."""

    recording: Recording
    files: Sequence[Path]
    verdicts: Sequence[Verdict]


def run(request: Request) -> int:
    """Run a document as asked; return the exit code.

    Raises:
        DocumentError: the document or an argument is wrong.
        RecordingError: the results cannot be written.
    """
    duration = _duration(request.duration)
    document = load_document(request.spec, request.overrides)
    check_claims(document)
    program = lower(build_graph(document))
    folder = _writable(request.out or Path("results") / folder_name(document.experiment.name))
    recording = _simulated(program, request, duration)
    files = _write(recording, folder, request.figures)
    verdicts = judge_run(document, recording) if _is_complete(recording, request) else []
    finding = Finding(recording, files, verdicts)
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


def _duration(text: str | None) -> float | None:
    """Return seconds.

    Raises:
        DocumentError: the text is no time.
    """
    if text is None:
        return None
    try:
        return float(TIME.positive.parse(text))
    except PydanticCustomError as error:
        hint = "write for example --duration '5 s'"
        raise DocumentError([Problem("duration", "--duration", error.message(), repr(text), hint)]) from error


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


def _write(recording: Recording, folder: Path, figures: bool) -> list[Path]:
    file = folder / RESULTS_FILE
    save(recording, file)
    return [file, *(write_figures(recording, folder / FIGURES_FOLDER) if figures else ())]


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
    for file in finding.files:
        note(f"wrote {file}")
