"""What pydantic found, said in the words of the document."""

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from pydantic import BaseModel
from pydantic_core import ErrorDetails

from neuromech.components.catalogue import Catalogue
from neuromech.errors import Problem, did_you_mean
from neuromech.spec.model import Experiment, Instance
from neuromech.spec.node import ListNode, MapNode, Node, ScalarNode, is_missing, join, scalar_value
from neuromech.spec.positions import Positions
from neuromech.spec.shape import (
    Choice,
    Fields,
    Items,
    Leaf,
    Names,
    Shape,
    Table,
    kind_word,
    model_of,
    narrowed,
    shape_of,
    step,
)
from neuromech.spec.substitute import REFERENCE
from neuromech.units import repr_short

_TYPE_WORDS = {str: "text", int: "a whole number", float: "a number", bool: "true or false"}


@dataclass(frozen=True, slots=True)
class _Place:
    """Where an error belongs: the last place of its path that exists in the tree.

    `rest` is what of the path is left, `parent` the class whose key the place is, `kind_path` where its kind stands.
    """

    path: str
    node: Node
    annotation: Any
    rest: tuple[str | int, ...]
    parent: type[BaseModel] | None
    kind_path: str


def translate(
    errors: Sequence[ErrorDetails],
    tree: MapNode,
    positions: Positions,
    catalogue: Catalogue,
    wrong_parameters: Collection[str],
) -> list[Problem]:
    """Return the problems that validation errors stand for, each with its position, one for each place and rule.

    Where a value is that of one of `wrong_parameters`, which are reported themselves, nothing more is said.
    """
    found: dict[tuple[str, str], Problem] = {}
    missing: dict[str, list[str]] = {}
    for error in errors:
        place = _place(error["loc"], tree, catalogue)
        if _reported(place.node, wrong_parameters):
            continue
        if error["type"] == "missing" and not isinstance(place.node, ListNode):
            missing.setdefault(place.path, []).append(str(place.rest[0]))
            continue
        problem, at_key = _problem(error, place, catalogue)
        found.setdefault((problem.path, problem.code), positions.placed(problem, at_key))
    return [*found.values(), *_missing(missing, positions)]


def _missing(missing: dict[str, list[str]], positions: Positions) -> Iterator[Problem]:
    for path, names in missing.items():
        words = ", ".join(f"'{name}'" for name in names)
        message = f"{words} {'is' if len(names) == 1 else 'are'} missing"
        yield positions.placed(Problem("missing-key", path, message), at_key=True)


def _place(loc: tuple[str | int, ...], tree: MapNode, catalogue: Catalogue) -> _Place:
    node: Node = tree
    annotation: Any = Experiment
    parent: type[BaseModel] | None = None
    path, table = "", ""
    segments = list(loc)
    while segments and annotation is not None:
        shape = shape_of(annotation, catalogue)
        if isinstance(shape, Choice) and not shape.word and len(segments) > 1:
            segments.pop(0)
        child = _child(node, segments[0])
        if child is None or isinstance(shape, Leaf):
            break
        parent = model_of(annotation, node, catalogue)
        annotation = step(annotation, segments[0], node, catalogue)
        path, node = join(path, segments.pop(0)), child
        table = path if isinstance(shape, Table) else table
    annotation = narrowed(annotation, node, catalogue) if annotation is not None else None
    return _Place(path, node, annotation, tuple(segments), parent, table or join(path, "kind"))


def _child(node: Node, key: str | int) -> Node | None:
    if isinstance(node, MapNode):
        return node.get(str(key))
    if isinstance(node, ListNode) and isinstance(key, int) and key < len(node.items):
        return node.items[key]
    return None


def _reported(node: Node, wrong_parameters: Collection[str]) -> bool:
    """Tell whether the value is that of a wrong parameter or asks for something unknown, which is reported already."""
    if not isinstance(node, ScalarNode):
        return False
    if node.parameter is not None:
        return node.parameter in wrong_parameters
    return is_missing(node) or REFERENCE.search(node.text) is not None


def _problem(error: ErrorDetails, place: _Place, catalogue: Catalogue) -> tuple[Problem, bool]:
    """Return the problem, and whether it belongs to the key."""
    context = error.get("ctx", {})
    code = error["type"]
    if "message" in context:
        return _own(code, context, place), False
    if code == "extra_forbidden":
        return _unknown_key(place), True
    if place.rest[-1:] == ("[key]",):
        hint = "begin with a letter; then letters, digits, '_', '+' and '-'"
        name = repr_short(place.path.rpartition(".")[2])
        return Problem("illegal-name", place.path, "is no allowed name", name, hint), True
    shape = shape_of(place.annotation, catalogue)
    got = got_text(place.node)
    if code in ("union_tag_invalid", "union_tag_not_found"):
        return _kind(place, shape), False
    if isinstance(shape, Leaf) and shape.words:
        return _word(place, shape, got), False
    if code == "greater_than_equal":
        return Problem("out-of-range", place.path, f"must be at least {context['ge']}", got), False
    if code == "less_than_equal":
        return Problem("out-of-range", place.path, f"must be at most {context['le']}", got), False
    if code == "too_short" and not isinstance(shape, Items):
        return Problem("too-few", place.path, "must not be empty", None), False
    if isinstance(shape, Items) and isinstance(place.node, ListNode):
        return _length(place, shape, context), False
    message = f"must be {expected(shape)}"
    return Problem("wrong-type", place.path, message, got, _type_hint(shape, place.node)), False


def _own(code: str, context: dict[str, Any], place: _Place) -> Problem:
    path = place.path
    got: str | None = context["got"]
    if code == "unknown-kind":
        path = place.kind_path
    elif isinstance(place.node, ScalarNode) and place.node.parameter is not None:
        got = got_text(place.node)
    elif isinstance(place.node, ScalarNode) and scalar_value(place.node) is None:
        got = "nothing"
    return Problem(code, path, context["message"], got, context["hint"])


def _unknown_key(place: _Place) -> Problem:
    allowed = set(place.parent.model_fields) if place.parent else set()
    if place.parent is Instance:
        allowed |= {"use", "mirror", "with"}
    elif place.parent is Experiment:
        allowed |= {"extends", "modules"}
    key = place.path.rpartition(".")[2]
    return Problem("unknown-key", place.path, "is not known here", None, did_you_mean(key, allowed))


def _kind(place: _Place, shape: Shape) -> Problem:
    words = [kind_word(model) for model in shape.models] if isinstance(shape, Choice) else []
    kind = place.node.get("kind") if isinstance(place.node, MapNode) else None
    if not isinstance(kind, ScalarNode):
        return Problem("missing-kind", place.path, "'kind' is missing", None, f"allowed: {', '.join(sorted(words))}")
    path = join(place.path, "kind")
    return Problem("unknown-kind", path, "is no known kind", repr_short(kind.text), did_you_mean(kind.text, words))


def _word(place: _Place, shape: Leaf, got: str) -> Problem:
    words = [str(word) for word in shape.words]
    if len(words) == 1:
        return Problem("wrong-word", place.path, f"must be {words[0]}", got)
    text = place.node.text if isinstance(place.node, ScalarNode) else ""
    return Problem("wrong-word", place.path, f"must be one of {', '.join(words)}", got, _closest(text, words))


def _closest(text: str, words: Sequence[str]) -> str | None:
    hint = did_you_mean(text, words)
    return hint if hint.startswith("did you mean") else None


def _length(place: _Place, shape: Items, context: dict[str, Any]) -> Problem:
    length = len(place.node.items) if isinstance(place.node, ListNode) else 0
    least = len(shape.values) if shape.fixed else context.get("min_length", 1)
    message = f"must have {'' if shape.fixed else 'at least '}{least} {'entry' if least == 1 else 'entries'}"
    return Problem("wrong-length", place.path, message, str(length))


def got_text(node: Node) -> str:
    """Return what was found, in the words of an error message."""
    if isinstance(node, MapNode):
        return "a map"
    if isinstance(node, ListNode):
        return "a list"
    if node.parameter is not None:
        return f"{node.text!r}, the value of the parameter '{node.parameter}'"
    return repr_short(scalar_value(node))


def expected(shape: Shape) -> str:
    """Return what a place wants, in the words of an error message."""
    if isinstance(shape, Fields | Names | Choice | Table):
        return "a map"
    if isinstance(shape, Items):
        return f"a list of {len(shape.values)}" if shape.fixed else "a list"
    words = dict.fromkeys(_TYPE_WORDS.get(kind, "a map") for kind in shape.types)
    if "a number" in words:
        words.pop("a whole number", None)
    *others, last = words
    return f"{', '.join(others)} or {last}" if others else last


def _type_hint(shape: Shape, node: Node) -> str | None:
    if isinstance(node, ScalarNode) and node.text == "null":
        return "null drops what a document has that is extended, and here it has nothing"
    if isinstance(shape, Leaf) and shape.types == (str,) and isinstance(node, ScalarNode):
        return f'write "{node.text}" in quotes to make it text' if scalar_value(node) is not None else None
    return None
