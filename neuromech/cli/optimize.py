"""`neuromech optimize`: begin, continue and write back a study."""

import shlex
from dataclasses import dataclass
from pathlib import Path

from neuromech.cli.executors import check_executor, open_executor
from neuromech.cli.files import folder_name
from neuromech.cli.interrupt import stop_on_signals
from neuromech.cli.scores import evaluation_text
from neuromech.cli.search_progress import search_progress
from neuromech.cli.terminal import ENDED_EARLY, FINISHED, note
from neuromech.errors import StudyError
from neuromech.pipeline import load_document
from neuromech.report.convergence import convergence_figure
from neuromech.report.layout import save, style
from neuromech.spec.document import Document
from neuromech.study.database import Database
from neuromech.study.driver import Search
from neuromech.study.evaluate import Evaluator
from neuromech.study.history import best_of, confirmed
from neuromech.study.plan import Plan
from neuromech.study.storage import StoredStudy
from neuromech.study.write_back import write_back

STORAGE_FILE = "study.db"
FIGURE = "convergence"


@dataclass(frozen=True, slots=True)
class Request:
    """What the user asked for on the command line; None where the document decides."""

    spec: Path
    evaluations: int | None
    seed: int | None
    storage: str | None
    name: str | None
    resume: bool
    workers: int | None
    dask: str | None
    write: Path | None
    quiet: bool

    def command(self) -> str:
        """Return the command that goes on with this study."""
        options = {
            "--evaluations": self.evaluations,
            "--seed": self.seed,
            "--storage": self.storage,
            "--name": self.name,
            "--workers": self.workers,
            "--dask": self.dask,
            "--write": self.write,
        }
        given = [text for option, value in options.items() if value is not None for text in (option, str(value))]
        return shlex.join(["neuromech", "optimize", str(self.spec), "--resume", *given])


@dataclass(frozen=True, slots=True)
class _Opened:
    """A study in its database, and what evaluates its candidates."""

    name: str
    plan: Plan
    stored: StoredStudy
    evaluator: Evaluator


def optimize(request: Request) -> int:
    """Search as asked; return the exit code.

    Raises:
        DocumentError: the document or an argument is wrong.
        StudyError: the study cannot be begun, continued or stored.
        RunError: no candidate at all could be simulated.
        OSError: a file cannot be written.
    """
    check_executor(request.workers, request.dask)
    written = load_document(request.spec)
    name = request.name or written.experiment.name
    with Database(request.storage or _own_file(name)) as database:
        opened = _open(request, written, name, database)
        with search_progress(opened.plan.header.stages, shown=not request.quiet) as report:
            search = Search(opened.plan, opened.stored, report)
            ending = "complete" if search.is_complete else _searched(request, opened, search)
    _conclude(request, opened, search)
    if ending == "complete":
        return FINISHED
    note(f"stopped after {_done(opened, search)}, all of them stored; to go on: {request.command()}")
    return ENDED_EARLY


def _done(opened: _Opened, search: Search) -> str:
    """Return in words how far a search is."""
    confirming = sum(one.confirms is not None for one in search.evaluations)
    searched = f"{len(search.evaluations) - confirming} of {opened.plan.evaluations} evaluations"
    return f"{searched} and {confirming} that confirm them" if confirming else searched


def _open(request: Request, written: Document, name: str, database: Database) -> _Opened:
    stored = database.open(name) if request.resume and name in database.names() else None
    seed = request.seed if stored is None or request.seed is not None else stored.header.seed
    changes = {"study.seed": seed, "study.evaluations": request.evaluations}
    evaluator = Evaluator(request.spec, [f"{path}={value}" for path, value in changes.items() if value is not None])
    plan = Plan.of(evaluator.document, written)
    if stored is None:
        stored = database.create(name, plan.header)
        note(f"study '{name}' begins in {database.shown}")
    else:
        _compare(name, stored, plan)
    return _Opened(name, plan, stored, evaluator)


def _own_file(name: str) -> str:
    folder = Path("results") / folder_name(name)
    folder.mkdir(parents=True, exist_ok=True)
    return str(folder / STORAGE_FILE)


def _compare(name: str, stored: StoredStudy, plan: Plan) -> None:
    """Refuse to go on with another document; say where packages are of another version.

    Raises:
        StudyError: the document has changed.
    """
    changes = "\n".join(f"~ {change}" for change in stored.header.changes(plan.header))
    if changes:
        hint = "undo the changes, or begin another study with --name or --storage"
        told = f"{plan.document.file} is not the document any more that study '{name}' was begun with"
        raise StudyError(f"{told}:\n{changes}\nHint: {hint}")
    for version in stored.header.other_versions(plan.header):
        note(f"the version of a package has changed, and numbers may differ in their last bits: {version}")


def _searched(request: Request, opened: _Opened, search: Search) -> str:
    try:
        with stop_on_signals(_stopping) as stop, open_executor(request.workers, request.dask) as executor:
            executor.prepare(opened.evaluator.prepare)
            return search.run(executor, opened.evaluator, stop)
    except KeyboardInterrupt:
        return "dropped"


def _stopping() -> None:
    note("stopping when the evaluations under way are complete; Ctrl-C once more drops them")


def _conclude(request: Request, opened: _Opened, search: Search) -> None:
    """Say what was found, draw it, and write it back."""
    stages = opened.plan.header.stages
    figure = convergence_figure(opened.name, search.evaluations, stages)
    if figure is not None:
        folder = Path("results") / folder_name(opened.name)
        folder.mkdir(parents=True, exist_ok=True)
        with style():
            note(f"wrote {save(figure, folder / FIGURE)[0]}")
    found = best_of(search.evaluations)
    if found is None:
        if confirmed(search.evaluations):
            note("every candidate crashed or diverged with fresh seeds, so none is confirmed")
        return
    words = evaluation_text(found, stages)
    note(f"best: {words}")
    if request.write is not None:
        origin = f"study {opened.name}, {words}"
        write_back(opened.plan.document, found.parameters, origin, request.write)
        note(f"wrote {request.write}")
