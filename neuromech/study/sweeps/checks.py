"""What can be said about a sweep before anything runs."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from neuromech.compiler.lower import lower
from neuromech.compiler.rebind import fixed_uses
from neuromech.errors import DocumentError, Problem, did_you_mean
from neuromech.graph.build import build
from neuromech.graph.check import check
from neuromech.graph.model import ModelGraph
from neuromech.spec.document import Document
from neuromech.spec.includes import Composed
from neuromech.spec.sweep import Sweep
from neuromech.study.checks import change_problems
from neuromech.study.measure_checks import MeasureChecker


@dataclass(frozen=True, slots=True)
class SweptMeasure:
    """What a measure gives.

    Args:
        unit: SI unit of a number, None for a text.
        words: the words that a text can be, empty where they depend on the model.
    """

    unit: str | None
    words: tuple[str, ...]

    def is_missing(self, value: float | str) -> bool:
        """Tell whether a value is the reason for its absence."""
        return isinstance(value, str) and (self.unit is not None or bool(self.words and value not in self.words))


def check_sweep(
    document: Document, name: str, composed: Composed, overrides: tuple[str, ...] = ()
) -> Mapping[str, SweptMeasure]:
    """Check a sweep and return what each of its measures gives.

    Args:
        document: the document.
        name: of the sweep.
        composed: the files of the document.
        overrides: what was changed in it, each as in `--set`.

    Raises:
        DocumentError: there is no such sweep, or something in it is wrong; every problem is named.
    """
    sweeps = document.experiment.sweeps
    if name not in sweeps:
        hint = did_you_mean(name, sweeps) if sweeps else "docs/studies.md shows what stands in one"
        raise DocumentError([document.problem("no-sweep", "sweeps", f"there is no sweep '{name}'", hint=hint)])
    graph = build(document)
    check(graph)
    sweep, path = sweeps[name], f"sweeps.{name}"
    checker = MeasureChecker(graph, _duration(document, sweep))
    for key, measure in sweep.measures.items():
        checker.check_measure(measure, f"{path}.measures.{key}")
    problems = [*checker.problems, *change_problems(document, f"{path}.set", sweep.set, composed, overrides)]
    problems += _immovable(graph, sweep, path)
    if problems:
        raise DocumentError(problems)
    found = {key: checker.kinds[measure] for key, measure in sweep.measures.items()}
    return {key: SweptMeasure(unit, kind.words) for key, (kind, unit) in found.items()}


def _duration(document: Document, sweep: Sweep) -> float:
    if sweep.within_one_run is not None:
        return float(sweep.within_one_run.every)
    return float(sweep.duration or document.experiment.protocol.duration)


def _immovable(graph: ModelGraph, sweep: Sweep, path: str) -> Iterator[Problem]:
    """Yield what is to change within a run and cannot."""
    if sweep.within_one_run is None:
        return
    program = lower(graph)
    for name in sweep.vary:
        for use in fixed_uses(program, frozenset({name})):
            message = f"cannot change during a run, because it sets {use}"
            hint = "remove 'within_one_run', which gives each value a run of its own"
            yield graph.document.problem("immovable-parameter", f"{path}.vary.{name}", message, hint=hint)
            break
