"""What can be said about a study before anything runs."""

from collections.abc import Iterator, Mapping
from dataclasses import replace

from neuromech.components.catalogue import Catalogue
from neuromech.errors import DocumentError, Problem
from neuromech.graph.build import build
from neuromech.graph.check import check
from neuromech.graph.model import ModelGraph
from neuromech.spec.document import Document
from neuromech.spec.includes import Composed
from neuromech.spec.load import load_composed
from neuromech.spec.study import Study
from neuromech.study.algorithms.catalogue import AlgorithmCatalogue
from neuromech.study.objective_checks import objective_problems
from neuromech.study.scenarios import written_overrides


def check_study(graph: ModelGraph, composed: Composed, overrides: tuple[str, ...] = ()) -> Study:
    """Check the study of a model that is right otherwise, and return it.

    Args:
        graph: the model, built and checked.
        composed: the files of its document.
        overrides: what was changed in the document, each as in `--set`.

    Raises:
        DocumentError: the document has no study, or something in it is wrong; every problem is named.
    """
    document = graph.document
    study = document.experiment.study
    if study is None:
        hint = "docs/studies.md shows what stands in one"
        raise DocumentError([document.problem("no-study", "", "has no section 'study'", hint=hint)])
    problems = [*_algorithm_problems(document, study), *objective_problems(graph, study)]
    for name, scenario in study.scenarios.items():
        place = f"study.scenarios.{name}.set"
        problems += change_problems(document, place, scenario.set, composed, overrides)
    if problems:
        raise DocumentError(problems)
    return study


def _algorithm_problems(document: Document, study: Study) -> tuple[Problem, ...]:
    try:
        AlgorithmCatalogue.installed().settings(study.algorithm, mark=document.mark)
    except DocumentError as error:
        return error.problems
    return ()


def change_problems(
    document: Document,
    place: str,
    changes: Mapping[str, str | int | float | bool],
    composed: Composed,
    overrides: tuple[str, ...],
) -> Iterator[Problem]:
    """Yield what is wrong with a document when it is changed as a map at a path of it says.

    Args:
        document: the document without the changes.
        place: the path where they are written.
        changes: path → value.
        composed: the files of the document.
        overrides: what else was changed in it, each as in `--set`.
    """
    if not changes:
        return
    texts = (*overrides, *written_overrides(changes))
    try:
        check(build(load_composed(composed, catalogue=Catalogue.installed(), overrides=texts)))
    except DocumentError as error:
        for problem in error.problems:
            if problem.path in changes:
                path = f"{place}.{problem.path}"
                yield replace(problem, path=path, mark=document.mark(path))
            else:
                message = f"breaks the document: {problem.path} {problem.message}"
                yield replace(problem, path=place, message=message, mark=document.mark(place))
