"""`--set a.b.c=value`: changes to a composed tree from the command line."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from neuromech.errors import DocumentError, Problem, did_you_mean
from neuromech.spec.merge import merge
from neuromech.spec.node import Entry, ListNode, MapNode, Node, is_null, join, kind_of
from neuromech.spec.reader import parse_value


@dataclass(frozen=True)
class Overridden:
    """A tree with its overrides; `through` are names that a path went through although the tree did not have them."""

    tree: MapNode
    through: frozenset[str]


def override(tree: MapNode, texts: Sequence[str]) -> Overridden:
    """Return the tree changed by texts like `solver.step=0.25 ms`, in order. A value `null` removes the key.

    Raises:
        DocumentError: a text has no `=`, its value is no YAML, or its path leads nowhere.
    """
    problems: list[Problem] = []
    through: set[str] = set()
    for text in texts:
        path, equals, value = text.partition("=")
        if not equals or not path.strip():
            problems.append(Problem("override", "", "'--set' needs a path and a value", repr(text), "--set a.b=1"))
            continue
        try:
            node = parse_value(value)
        except DocumentError as error:
            problems.extend(replace(problem, path=path) for problem in error.problems)
            continue
        changed = _set(tree, path.strip().split("."), node, "", through, problems)
        tree = changed if isinstance(changed, MapNode) else tree
    if problems:
        raise DocumentError(problems)
    return Overridden(tree, frozenset(through))


def split_path(node: Node, keys: Sequence[str]) -> tuple[str, list[str]]:
    """Return the first key of a dotted path and the rest; a key of the map may contain dots itself."""
    if isinstance(node, MapNode):
        for length in range(len(keys), 1, -1):
            joined = ".".join(keys[:length])
            if joined in node.entries:
                return joined, list(keys[length:])
    return keys[0], list(keys[1:])


def _set(node: Node, keys: Sequence[str], value: Node, path: str, through: set[str], problems: list[Problem]) -> Node:
    key, rest = split_path(node, keys)
    here = join(path, key)
    if isinstance(node, ListNode):
        return _set_item(node, key, rest, value, here, through, problems)
    if not isinstance(node, MapNode):
        message = f"is {kind_of(node)} and has no '{key}'"
        problems.append(Problem("override", path, message, None, "set the value as a whole"))
        return node
    old = node.entries.get(key)
    if old is None:
        return _create(node, key, rest, value, here, through, problems)
    if not rest and is_null(value):
        return node.without(key)
    new = (
        _set(old.node, rest, value, here, through, problems) if rest else merge(old.node, value, "set", problems, here)
    )
    return MapNode({**node.entries, key: Entry(new, old.mark)}, node.mark, node.origins)


def _create(
    node: MapNode, key: str, rest: list[str], value: Node, path: str, through: set[str], problems: list[Problem]
) -> Node:
    if rest:
        if path.rpartition(".")[0] in ("modules", "instances"):
            problems.append(Problem("unknown-name", path, "does not exist", None, did_you_mean(key, node.entries)))
            return node
        through.add(key)
        value = _set(MapNode(), rest, value, path, through, problems)
    return MapNode({**node.entries, key: Entry(value, None)}, node.mark, node.origins)


def _set_item(
    node: ListNode, key: str, rest: list[str], value: Node, path: str, through: set[str], problems: list[Problem]
) -> Node:
    if not (key.isascii() and key.isdigit() and len(key) < 7 and int(key) < len(node.items)):
        got = f"a list of {len(node.items)}"
        problems.append(Problem("override", path, "is no position in the list", got, "positions count from 0"))
        return node
    index = int(key)
    old = node.items[index]
    new = _set(old, rest, value, path, through, problems) if rest else merge(old, value, "set", problems, path)
    return replace(node, items=(*node.items[:index], new, *node.items[index + 1 :]))
