"""`neuromech study show|best|export`: what a study found."""

from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

from rich.table import Table
from rich.text import Text

from neuromech.cli.consoles import results
from neuromech.cli.scores import evaluation_text, score_text
from neuromech.cli.terminal import FINISHED, note, write_json, write_line
from neuromech.errors import StudyError
from neuromech.report.convergence import convergence_figure
from neuromech.report.layout import FileFormat, save, style
from neuromech.study.database import Database
from neuromech.study.evaluation import Evaluation
from neuromech.study.export import export as write_table
from neuromech.study.header import Header
from neuromech.study.history import Confirmed, Generation, best_of, confirmed, failures, generations

SHOWN_GENERATIONS = 20
SHOWN_NUMBERS = 8


def show(place: str, name: str | None, as_json: bool, figure: Path | None) -> int:
    """Show how far a study is; return the exit code.

    Raises:
        StudyError: there is no such study, or no format for the figure.
    """
    name, header, evaluations = _study(place, name)
    if as_json:
        write_json(as_dict(name, header, evaluations))
    else:
        _show(name, header, evaluations)
    if figure is not None:
        _draw(name, header, evaluations, figure)
    return FINISHED


def best(place: str, name: str | None, as_json: bool) -> int:
    """Show the best candidate of a study; return the exit code.

    Raises:
        StudyError: there is no such study, or it has no candidate with a score.
    """
    name, header, evaluations = _study(place, name)
    found = best_of(evaluations)
    if found is None:
        raise StudyError(f"study '{name}' has no candidate with a score yet")
    if as_json:
        write_json(found.to_dict())
        return FINISHED
    write_line(evaluation_text(found, header.stages))
    results().print(_parameters(found))
    results().print(_measures(found))
    return FINISHED


def export(place: str, file: Path, name: str | None) -> int:
    """Write a study to a file; return the exit code.

    Raises:
        StudyError: there is no such study, or no format for this file.
        MissingExtraError: the library for this format is not installed.
        OSError: the file cannot be written.
    """
    _, header, evaluations = _study(place, name)
    write_table(header, evaluations, file)
    note(f"wrote {file}")
    return FINISHED


def as_dict(name: str, header: Header, evaluations: Sequence[Evaluation]) -> dict[str, Any]:
    """Return what a study found as plain values for JSON."""
    found = best_of(evaluations)
    return {
        "study": name,
        "document": header.document,
        "seed": header.seed,
        "versions": dict(header.versions),
        "evaluations": len(evaluations),
        "best": None if found is None else found.to_dict(),
        "confirmed": [
            {"evaluation": one.evaluation.to_dict(), "searched": one.searched and asdict(one.searched)}
            for one in confirmed(evaluations)
        ],
        "generations": [asdict(generation) for generation in generations(evaluations)],
        "failures": [{"message": message, "evaluations": numbers} for message, numbers in failures(evaluations)],
    }


def _study(place: str, name: str | None) -> tuple[str, Header, list[Evaluation]]:
    """Return name, header and complete evaluations of a study.

    Raises:
        StudyError: there is no such study, or several and no name.
    """
    with Database(place, create=False) as database:
        names = database.names()
        if name is None and len(names) != 1:
            held = ", ".join(f"'{one}'" for one in names)
            said = f"several studies: {held}. Hint: choose one with --name" if names else "no study"
            raise StudyError(f"{database.shown} holds {said}")
        chosen = name or names[0]
        stored = database.open(chosen)
        return chosen, stored.header, stored.evaluations()


def _show(name: str, header: Header, evaluations: Sequence[Evaluation]) -> None:
    found = best_of(evaluations)
    history = generations(evaluations)
    table = Table(title=Text(name, "bold"), title_justify="left", show_header=False, box=None, pad_edge=False)
    table.add_column(style="dim")
    table.add_column(overflow="fold")
    table.add_row("document", Text(f"{header.document} ({header.file})"))
    table.add_row("seed", str(header.seed))
    table.add_row("evaluations", str(sum(one.confirms is None for one in evaluations)))
    table.add_row("crashed or diverged", str(sum(one.score is None for one in evaluations)))
    table.add_row("fell", str(sum(one.fell for one in evaluations)))
    if found is not None:
        table.add_row("best", Text(evaluation_text(found, header.stages)))
        table.add_row("median of the last generation", Text(score_text(history[-1].median, header.stages)))
    results().print(table)
    if history:
        results().print(_history(history, header.stages))
    if confirmed(evaluations):
        results().print(_confirmed(confirmed(evaluations), header.stages))
    for message, numbers in failures(evaluations):
        shown = ", ".join(map(str, numbers[:SHOWN_NUMBERS])) + (", …" if len(numbers) > SHOWN_NUMBERS else "")
        write_line(f"failed {len(numbers)} × ({shown}): {message}")


def _history(history: Sequence[Generation], stages: Sequence[str]) -> Table:
    left_out = len(history) - SHOWN_GENERATIONS
    title = f"the last {SHOWN_GENERATIONS} of {len(history)} generations" if left_out > 0 else None
    table = Table(
        "generation", "evaluations", "best", "median", "failed", "fell", box=None, title=title, pad_edge=False
    )
    for one in history[-SHOWN_GENERATIONS:]:
        scores = (score_text(one.best, stages), score_text(one.median, stages))
        table.add_row(str(one.number), str(one.evaluations), *map(Text, scores), str(one.failed), str(one.fell))
    return table


def _confirmed(found: Sequence[Confirmed], stages: Sequence[str]) -> Table:
    """Return what was evaluated again, with the score in the search beside the one with fresh seeds."""
    table = Table("evaluation", "confirms", "score in the search", "score", "fell", box=None, pad_edge=False)
    for one in found:
        again = one.evaluation
        scores = ("" if one.searched is None else score_text(one.searched, stages), score_text(again.score, stages))
        fell = sum(run.kind == "fell" for run in again.runs)
        table.add_row(str(again.number), str(again.confirms), *map(Text, scores), f"{fell} of {len(again.runs)} runs")
    return table


def _parameters(found: Evaluation) -> Table:
    table = Table("parameter", "value", box=None, pad_edge=False)
    for name, value in found.parameters.items():
        table.add_row(Text(name), Text(value))
    return table


def _measures(found: Evaluation) -> Table:
    """Return what was measured in each run, in SI units."""
    table = Table("scenario", "seed", "outcome", "measure", "value (SI)", "points", box=None, pad_edge=False)
    for run in found.runs:
        for name, value in run.measures.items():
            text = value if isinstance(value, str) else f"{value:.6g}"
            points = f"{run.points[name]:.5g}" if name in run.points else ""
            table.add_row(Text(run.scenario), str(run.seed), run.kind, Text(name), Text(text), points)
    return table


def _draw(name: str, header: Header, evaluations: Sequence[Evaluation], file: Path) -> None:
    formats: dict[str, FileFormat] = {".png": "png", ".svg": "svg"}
    if file.suffix not in formats:
        raise StudyError(f"{file}: no format for '{file.suffix}'. Hint: choose .png or .svg")
    figure = convergence_figure(name, evaluations, header.stages)
    if figure is None:
        raise StudyError(f"study '{name}' has no complete evaluation yet")
    with style():
        save(figure, file.with_suffix(""), [formats[file.suffix]])
    note(f"wrote {file}")
