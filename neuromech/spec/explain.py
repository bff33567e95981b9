"""Which file and line gave a value, and what it was before."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pydantic import BaseModel
from pydantic_core import PydanticUndefined

from neuromech.components.catalogue import Catalogue
from neuromech.errors import DocumentError, Mark, Problem, did_you_mean
from neuromech.spec.includes import compose
from neuromech.spec.model import Experiment
from neuromech.spec.node import ListNode, MapNode, Node, Origin, ScalarNode, join, short_text
from neuromech.spec.overrides import split_path
from neuromech.spec.positions import Positions
from neuromech.spec.resolve import resolve
from neuromech.spec.shape import Leaf, field_annotation, model_of, narrowed, shape_of, step
from neuromech.units import measure


@dataclass(frozen=True, slots=True)
class Explanation:
    """Where a value comes from.

    Args:
        path: its dotted path.
        written: the value as written; of a map its keys.
        mark: where it was written; None for `--set` and for a default.
        is_default: nobody wrote it, the class gives it.
        quantity: what it is (`conductance`), None where it is no quantity.
        si: its value in SI units, None where it is no quantity.
        parameter: the parameter that it follows.
        history: what stood there before, oldest first.
    """

    path: str
    written: str
    mark: Mark | None
    is_default: bool = False
    quantity: str | None = None
    si: float | None = None
    parameter: str | None = None
    history: tuple[Origin, ...] = ()


def explain(path: str, spec_path: Path, catalogue: Catalogue, overrides: Sequence[str] = ()) -> Explanation:
    """Return where the value at a dotted path of a document comes from.

    Raises:
        DocumentError: the document cannot be composed, or has no such path.
    """
    resolved = resolve(compose(spec_path), overrides, catalogue)
    if resolved.problems:
        raise DocumentError(resolved.problems)
    positions = Positions.of(resolved.tree)
    node: Node = resolved.tree
    annotation: Any = Experiment
    here, keys = "", path.split(".")
    while keys:
        key, rest = split_path(node, keys)
        child = _child(node, key)
        if child is None:
            model = model_of(annotation, node, catalogue) if annotation is not None else None
            found = _default(join(here, key), [key, *rest], model, catalogue)
            if found is None:
                raise DocumentError([positions.placed(_unknown(path, key, node, model))])
            return found
        index = int(key) if isinstance(node, ListNode) else key
        annotation = step(annotation, index, node, catalogue) if annotation is not None else None
        here, node, keys = join(here, key), child, rest
    return _written(here, node, annotation, positions, catalogue)


def _child(node: Node, key: str) -> Node | None:
    if isinstance(node, MapNode):
        return node.get(key)
    if isinstance(node, ListNode) and key.isdecimal() and len(key) < 7 and int(key) < len(node.items):
        return node.items[int(key)]
    return None


def _written(path: str, node: Node, annotation: Any, positions: Positions, catalogue: Catalogue) -> Explanation:
    shape = shape_of(narrowed(annotation, node, catalogue), catalogue) if annotation is not None else None
    mark = positions.values.get(path)
    if not isinstance(node, ScalarNode):
        return Explanation(path, short_text(node, 200), mark, history=node.origins)
    unit = shape.unit if isinstance(shape, Leaf) else None
    si = _si(node.text) if unit else None
    name = unit.name if unit else None
    return Explanation(path, node.text, mark, False, name, si, node.parameter, node.origins)


def _si(text: str) -> float | None:
    try:
        return measure(text)[0]
    except ValueError:
        return None


def _default(path: str, keys: Sequence[str], model: type[BaseModel] | None, catalogue: Catalogue) -> Explanation | None:
    """Return the default of a field that nobody wrote, looking into defaults that are classes themselves."""
    key, *rest = keys
    if model is None or key not in model.model_fields:
        return None
    default = model.model_fields[key].default
    if rest:
        inner = type(default) if isinstance(default, BaseModel) else None
        return _default(join(path, rest[0]), rest, inner, catalogue)
    if default is PydanticUndefined:
        return None
    return _of_default(path, default, field_annotation(model, key), catalogue)


def _unknown(path: str, key: str, node: Node, model: type[BaseModel] | None) -> Problem:
    names = set(node.entries) if isinstance(node, MapNode) else set()
    allowed = names | set(model.model_fields if model else ())
    hint = None if key in allowed else did_you_mean(key, allowed)
    return Problem("unknown-path", path, "is not in the document", None, hint)


def _of_default(path: str, default: Any, annotation: Any, catalogue: Catalogue) -> Explanation:
    shape = shape_of(annotation, catalogue)
    if isinstance(shape, Leaf) and shape.unit and isinstance(default, float):
        return Explanation(path, shape.unit.written(default), None, True, shape.unit.name, float(default))
    return Explanation(path, "nothing" if default is None else str(default), None, True)
