"""What becomes of a run: results file, figures, film, claims, and what is shown of them.

Importing what draws takes a second; `neuromech run` does it after its run.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from rich.text import Text

from neuromech.analyse.claims import Verdict
from neuromech.cli.consoles import notes
from neuromech.cli.films import show_left_out, write_film
from neuromech.cli.run import Request
from neuromech.cli.terminal import CLAIM_NOT_MET, ENDED_EARLY, FINISHED, note, write_json
from neuromech.cli.verdicts import claims_table
from neuromech.graph.model import ModelGraph
from neuromech.report.gait import gait_table
from neuromech.report.overview import Drawn, write_figures
from neuromech.report.replay import Motion
from neuromech.report.summary import metrics, summary_table
from neuromech.report.video import Film
from neuromech.simulate.recording import Recording
from neuromech.simulate.storage import save
from neuromech.verification import all_met, judge_run

RESULTS_FILE = "recording.nc"
FIGURES_FOLDER = "figures"
VIDEO_FILE = "video.mp4"


@dataclass(frozen=True, slots=True)
class Finding:
    """What a run gave: recording, files, verdicts on its claims, and what figures that were left out lack."""

    recording: Recording
    files: Sequence[Path]
    verdicts: Sequence[Verdict]
    left_out: Mapping[str, Sequence[str]] = field(default_factory=dict)


def finish(recording: Recording, graph: ModelGraph, request: Request, folder: Path) -> int:
    """Write, judge and show a run as the user asked; return the exit code.

    Raises:
        RecordingError: the results cannot be written.
    """
    drawn = _write(recording, folder, request, graph)
    verdicts = judge_run(graph.document, recording) if _is_complete(recording, request) else []
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


def _write(recording: Recording, folder: Path, request: Request, graph: ModelGraph) -> Drawn:
    """Write the results file, figures and film that were asked for."""
    file = folder / RESULTS_FILE
    save(recording, file)
    drawn = Drawn((), {})
    if request.figures:
        drawn = write_figures(recording, folder / FIGURES_FOLDER, body=graph.body)
    files = [file, *drawn.files]
    if request.video and graph.body is not None:
        write_film(Motion(graph.body, recording), folder / VIDEO_FILE, Film(), request.talks)
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
