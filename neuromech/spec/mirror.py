"""The mirror image of a part of a body about the sagittal plane y = 0."""

import re
from dataclasses import replace

from neuromech.errors import Problem
from neuromech.spec.node import Entry, ListNode, MapNode, Node, Origin, ScalarNode, join
from neuromech.units import NUMBER

_VECTORS = frozenset(("position", "center_of_mass", "start", "end"))
_NUMBER = re.compile(rf"(?P<number>{NUMBER})(?P<rest>.*)", re.DOTALL)


def mirrored(node: Node, problems: list[Problem], path: str = "") -> Node:
    """Return the mirror image: y of positions changes sign, and x and z of axes of rotation.

    A rotation is a pseudo-vector: its components in the plane of the mirror change sign and the one along the normal
    stays. The axis of a sliding joint is a vector like a position.
    """
    if isinstance(node, ListNode):
        items = tuple(mirrored(item, problems, join(path, index)) for index, item in enumerate(node.items))
        return replace(node, items=items)
    if not isinstance(node, MapNode):
        return node
    entries = {
        key: Entry(_value(key, entry.node, node, problems, join(path, key)), entry.mark)
        for key, entry in node.entries.items()
    }
    return MapNode(entries, node.mark, node.origins)


def _value(key: str, node: Node, parent: MapNode, problems: list[Problem], path: str) -> Node:
    if isinstance(node, ListNode) and len(node.items) == 3:
        if key in _VECTORS or (key == "axis" and _slides(parent)):
            return _negated(node, (1,), problems, path)
        if key == "axis":
            return _negated(node, (0, 2), problems, path)
    return mirrored(node, problems, path)


def _slides(joint: MapNode) -> bool:
    kind = joint.get("kind")
    return isinstance(kind, ScalarNode) and kind.text == "slide"


def _negated(vector: ListNode, indices: tuple[int, ...], problems: list[Problem], path: str) -> ListNode:
    items = list(vector.items)
    for index in indices:
        items[index] = _negative(items[index], problems, join(path, index))
    return replace(vector, items=tuple(items))


def _negative(node: Node, problems: list[Problem], path: str) -> Node:
    if not isinstance(node, ScalarNode):
        return node
    match = _NUMBER.match(node.text.strip())
    if match is None:
        if "${" in node.text:
            message = "a value that follows a parameter has no mirror image"
            hint = "write the value, or give it to the module as an argument"
            problems.append(Problem("mirror", path, message, node.text, hint, node.mark))
        return node
    number = match["number"]
    if float(number) == 0.0:
        return node
    turned = number[1:] if number[0] == "-" else "-" + number.removeprefix("+")
    origin = Origin("mirror", node.text, node.mark)
    return replace(node, text=turned + match["rest"], origins=(*node.origins, origin))
