"""What can be said about a study before anything runs."""

from collections.abc import Iterator, Mapping
from dataclasses import replace

from pydantic_core import PydanticCustomError

from neuromech.components.catalogue import Catalogue
from neuromech.errors import DocumentError, Problem
from neuromech.graph.build import build
from neuromech.graph.check import check
from neuromech.graph.model import ModelGraph
from neuromech.spec.document import Document
from neuromech.spec.follow import Follower, followers
from neuromech.spec.includes import Composed
from neuromech.spec.load import load_composed
from neuromech.spec.study import Study
from neuromech.study.algorithms.catalogue import AlgorithmCatalogue
from neuromech.study.objective_checks import objective_problems
from neuromech.study.scenarios import written_overrides
from neuromech.study.space import Space


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
    problems = [*_algorithm_problems(document, study), *_bound_problems(document), *objective_problems(graph, study)]
    for name, scenario in study.scenarios.items():
        place = f"study.scenarios.{name}.set"
        problems += change_problems(document, place, scenario.set, composed, overrides)
    if problems:
        raise DocumentError(problems)
    return study


def _bound_problems(document: Document) -> Iterator[Problem]:
    """Yield ends of the search that are not allowed where the parameter acts, at the first such place."""
    uses = list(followers(document.experiment))
    for dimension in Space.of(document).dimensions:
        mine = [use for use in uses if use.parameter in dimension.names]
        for word, coordinate in (("lower", 0.0), ("upper", 1.0)):
            texts = dimension.texts(coordinate)
            refusals = ((texts[use.parameter], _refusal(use, texts[use.parameter])) for use in mine)
            text, refused = next((pair for pair in refusals if pair[1] is not None), ("", None))
            if refused is not None:
                message, place = f"its {word} end is not allowed at {refused}", f"study.tune.{dimension.name}"
                yield document.problem("out-of-range", place, message, text, "write a 'range' that is")


def _refusal(use: Follower, text: str) -> str | None:
    """Return where a value is not allowed and why, or None where it is."""
    try:
        if use.unit is not None:
            use.unit.parse(text)
    except PydanticCustomError as error:
        return f"{use.path}, which {error.message()}"
    return None


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
