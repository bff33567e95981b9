"""`neuromech sweep`: parameters varied as a document's sweeps say, with results file and figures."""

import shlex
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr
from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn
from rich.table import Table

from neuromech.cli.consoles import notes
from neuromech.cli.executors import check_executor, open_executor
from neuromech.cli.files import folder_name
from neuromech.cli.interrupt import stop_on_signals
from neuromech.cli.terminal import ENDED_EARLY, FINISHED, note, write_json
from neuromech.errors import DocumentError
from neuromech.pipeline import load_document
from neuromech.report.sweep import measures, write_sweep_figures
from neuromech.study.executors import Executor
from neuromech.study.sweeps.carry_out import SweepStanding, carry_out
from neuromech.study.sweeps.dataset import dataset, save
from neuromech.study.sweeps.journal import Journal, SweepHeader
from neuromech.study.sweeps.task import SweepTask

RESULTS_FILE = "sweep.nc"
JOURNAL_FILE = "unfinished.jsonl"
FIGURES_FOLDER = "figures"


@dataclass(frozen=True, slots=True)
class Request:
    """What the user asked for on the command line; None where the default decides."""

    spec: Path
    names: tuple[str, ...]
    overrides: tuple[str, ...]
    workers: int | None
    dask: str | None
    out: Path | None
    restart: bool
    as_json: bool
    figures: bool
    quiet: bool


def sweep(request: Request) -> int:
    """Carry out sweeps as asked; return the exit code.

    Raises:
        DocumentError: the document or a sweep is wrong, or there is none.
        StudyError: an unfinished sweep was begun with another document, or no scheduler answers.
        RecordingError: the results cannot be written.
    """
    check_executor(request.workers, request.dask)
    tasks = _tasks(request)
    found = []
    with stop_on_signals(_stopping) as stop, open_executor(request.workers, request.dask) as executor:
        for task in tasks:
            tree = _carried_out(task, request, executor, stop)
            if tree is None:
                return ENDED_EARLY
            files = _write(task, tree, request)
            found.append(_as_dict(task, tree, files))
            if not request.quiet:
                _show(task, tree, files)
    if request.as_json:
        write_json(found)
    return FINISHED


def _stopping() -> None:
    note("stopping when the runs under way are complete; Ctrl-C once more drops them")


def _tasks(request: Request) -> list[SweepTask]:
    """Return the sweeps that are asked for; all of the document where none is named."""
    document = load_document(request.spec, request.overrides)
    names = request.names or tuple(document.experiment.sweeps)
    if not names:
        hint = "write a section 'sweeps', see docs/studies.md"
        raise DocumentError([document.problem("no-sweep", "", "the document has no sweep", hint=hint)])
    return [SweepTask(request.spec, name, request.overrides) for name in dict.fromkeys(names)]


def _folder(task: SweepTask, request: Request) -> Path:
    results = Path("results") / folder_name(task.document.experiment.name) / "sweeps"
    return (request.out or results) / task.name


def _carried_out(task: SweepTask, request: Request, executor: Executor, stop: Callable[[], bool]) -> xr.DataTree | None:
    """Return the results of a sweep, None where the user stopped it."""
    file = _folder(task, request) / JOURNAL_FILE
    if request.restart:
        file.unlink(missing_ok=True)
    with Journal(file, SweepHeader.of(task.document, task.name)) as journal:
        if journal.finished:
            note(f"{len(journal.finished)} of {len(task.design.jobs())} runs were finished before")
        with _progress(task, not request.quiet) as report:
            results = carry_out(task, journal, executor, stop, report)
        if len(results) < task.design.size():
            note(f"stopped; {len(results)} of {task.design.size()} points are kept in {file}")
            note(f"go on with: {_command(request)}")
            return None
        return dataset(task.document, task.name, task.design, task.kinds, results)


def _write(task: SweepTask, tree: xr.DataTree, request: Request) -> list[Path]:
    folder = _folder(task, request)
    file = folder / RESULTS_FILE
    save(tree, file)
    (folder / JOURNAL_FILE).unlink(missing_ok=True)
    return [file, *(write_sweep_figures(tree, folder / FIGURES_FOLDER) if request.figures else ())]


@contextmanager
def _progress(task: SweepTask, shown: bool) -> Iterator[Callable[[SweepStanding], None]]:
    """Show a bar on stderr while the block runs; yield what takes how far the sweep is."""
    if not shown:
        yield lambda standing: None
        return
    columns = (TextColumn(task.name), BarColumn(), TextColumn("{task.completed:.0f} of {task.total:.0f} points"))
    with Progress(*columns, TimeRemainingColumn(), TextColumn("{task.description}"), console=notes()) as progress:
        bar = progress.add_task("", total=task.design.size())
        yield lambda standing: progress.update(bar, completed=standing.done, description=_outcomes(standing.outcomes))


def _outcomes(counts: Mapping[str, int]) -> str:
    """Return how runs ended, in words: `88 finished, 3 fell`."""
    return ", ".join(f"{count} {outcome}" for outcome, count in sorted(counts.items(), key=lambda pair: -pair[1]))


def _show(task: SweepTask, tree: xr.DataTree, files: Sequence[Path]) -> None:
    notes().print(_table(task, tree))
    for file in files:
        note(f"wrote {file}")


def _as_dict(task: SweepTask, tree: xr.DataTree, files: Sequence[Path]) -> dict[str, Any]:
    """Return what a sweep gave as plain values for JSON."""
    return {
        "sweep": task.name,
        "points": task.design.size(),
        "outcomes": dict(_counts(tree)),
        "measures": dict(_summary(tree)),
        "files": [str(file) for file in files],
    }


def _counts(tree: xr.DataTree) -> Counter[str]:
    return Counter(str(one) for node in _nodes(tree) for one in node["outcome"].values.ravel())


def _nodes(tree: xr.DataTree) -> list[xr.Dataset]:
    """Return the datasets of all blocks."""
    return [node.to_dataset() for node in tree.subtree if "outcome" in node.data_vars]


def _summary(tree: xr.DataTree) -> Iterator[tuple[str, dict[str, Any]]]:
    """Yield each measure with its unit, its range or its words, and how often it is missing."""
    nodes = _nodes(tree)
    for name in measures(nodes[0]):
        missing = sum(int((node[f"{name}_missing"] != "").sum()) for node in nodes)
        values = np.concatenate([node[name].values.ravel() for node in nodes])
        if values.dtype.kind == "f":
            numbers = values[np.isfinite(values)]
            ends = (float(numbers.min()), float(numbers.max())) if len(numbers) else (None, None)
            unit = str(nodes[0][name].attrs["units"])
            yield name, {"unit": unit, "least": ends[0], "greatest": ends[1], "missing": missing}
        else:
            yield name, {"words": dict(Counter(str(word) for word in values if word)), "missing": missing}


def _table(task: SweepTask, tree: xr.DataTree) -> Table:
    title = f"{task.name}: {task.design.size()} points, {_outcomes(_counts(tree))}"
    table = Table(title=title, title_justify="left")
    for heading in ("measure", "unit", "range", "missing"):
        table.add_column(heading, overflow="fold")
    for name, found in _summary(tree):
        if "words" in found:
            text = ", ".join(f"{word} {count}" for word, count in found["words"].items())
        else:
            text = "" if found["least"] is None else f"{found['least']:.4g} … {found['greatest']:.4g}"
        table.add_row(name, found.get("unit", ""), text, str(found["missing"] or ""))
    return table


def _command(request: Request) -> str:
    """Return the command that goes on with an interrupted sweep."""
    words = ["neuromech", "sweep", str(request.spec), *request.names]
    words += [word for override in request.overrides for word in ("--set", override)]
    words += [] if request.out is None else ["--out", str(request.out)]
    return shlex.join(words)
