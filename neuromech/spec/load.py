"""A file to a `Document`: the one way in."""

import re
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from pydantic import TypeAdapter, ValidationError
from pydantic_core import ErrorDetails

from neuromech.components.catalogue import Catalogue
from neuromech.errors import DocumentError, Problem
from neuromech.spec.document import Document
from neuromech.spec.includes import Composed, compose
from neuromech.spec.model import Experiment
from neuromech.spec.plain import plain, to_yaml
from neuromech.spec.positions import Positions
from neuromech.spec.resolve import resolve
from neuromech.spec.rules import Sections, check
from neuromech.spec.shape import field_annotation
from neuromech.spec.translate import translate
from neuromech.spec.tree_rules import check_tree

_VALUE_OF_PARAMETER = re.compile(r"parameters\.(.+)\.value")


def load(path: Path, *, catalogue: Catalogue, overrides: Sequence[str] = ()) -> Document:
    """Return the document of a file.

    Args:
        path: the file.
        catalogue: the vocabulary.
        overrides: texts like `solver.step=0.25 ms`, applied after composition and before anything is checked.

    Raises:
        DocumentError: carries everything that is wrong with the document, in file order.
    """
    return load_composed(compose(path), catalogue=catalogue, overrides=overrides)


def load_composed(composed: Composed, *, catalogue: Catalogue, overrides: Sequence[str] = ()) -> Document:
    """Return the document of files that were read before; arguments and errors as for `load`."""
    resolved = resolve(composed, overrides, catalogue)
    positions = Positions.of(resolved.tree)
    values: dict[str, Any] = plain(resolved.tree)
    problems = [*resolved.problems, *check_tree(resolved, catalogue)]
    experiment: Experiment | None = None
    details: list[ErrorDetails] = []
    try:
        experiment = Experiment.model_validate(values, context={"catalogue": catalogue})
        sections = Sections.of(experiment)
    except ValidationError as error:
        details = error.errors(include_url=False, include_input=False)
        sections = _sound_sections(values, {str(detail["loc"][0]) for detail in details if detail["loc"]}, catalogue)
    found = list(check(sections, resolved.asked | resolved.through))
    problems += [*translate(details, resolved.tree, positions, catalogue, _parameters_of(found)), *found]
    if problems or experiment is None:
        raise DocumentError(_once(positions.placed(problem) for problem in problems))
    return Document(composed.files[0], experiment, positions.values, to_yaml(resolved.tree), resolved.files)


def _sound_sections(values: Mapping[str, Any], broken: set[str], catalogue: Catalogue) -> Sections:
    """Return what can be checked of a document that is broken elsewhere."""
    context = {"catalogue": catalogue}
    sound = {
        name: TypeAdapter(field_annotation(Experiment, name)).validate_python(values[name], context=context)
        for name in Sections.names()
        if name in values and name not in broken
    }
    return Sections(**sound, has_body="body" in values)


def _parameters_of(problems: Iterable[Problem]) -> set[str]:
    """Return the names of the parameters whose values are wrong."""
    found = (_VALUE_OF_PARAMETER.fullmatch(problem.path) for problem in problems)
    return {match[1] for match in found if match}


def _once(problems: Any) -> list[Problem]:
    """Drop what is the same problem at the same position, found in several instances of one module."""
    found: dict[tuple[Any, ...], Problem] = {}
    for problem in problems:
        key = (problem.mark, problem.code, problem.message, problem.got)
        found.setdefault(key if problem.mark else (*key, problem.path), problem)
    return list(found.values())
