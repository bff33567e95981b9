"""The tree of a document before it has types: immutable, and every node knows where it was written."""

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Literal

from neuromech.errors import Mark

_NULL = frozenset(("", "~", "null", "Null", "NULL"))
_BOOLEANS = {"true": True, "True": True, "TRUE": True, "false": False, "False": False, "FALSE": False}
_INTEGER = re.compile(r"[-+]?[0-9]{1,300}$|0o[0-7]{1,300}$|0x[0-9a-fA-F]{1,250}$")
_FLOAT = re.compile(r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?$")
_NOT_FINITE = re.compile(r"([-+]?)\.(?:(inf|Inf|INF)|(nan|NaN|NAN))$")


@dataclass(frozen=True, slots=True)
class Origin:
    """A step in the life of a value: what was there before.

    Args:
        how: what happened to the earlier value: it was replaced through `extends`, by an instance of a module or by
            `--set`; it is the `${…}` that an argument or a parameter filled; or its mirror image was taken.
        text: the earlier value as written.
        mark: where it was written.
    """

    how: Literal["extends", "instance", "set", "argument", "parameter", "mirror"]
    text: str
    mark: Mark | None


@dataclass(frozen=True, slots=True)
class ScalarNode:
    """Text, a number, true or false, or nothing. `parameter` names the parameter that gave the text."""

    text: str
    quoted: bool
    mark: Mark | None
    parameter: str | None = None
    origins: tuple[Origin, ...] = ()


@dataclass(frozen=True, slots=True)
class ListNode:
    """A list."""

    items: tuple["Node", ...]
    mark: Mark | None
    origins: tuple[Origin, ...] = ()


@dataclass(frozen=True, slots=True)
class Entry:
    """What stands under a key of a map; `mark` is that of the key."""

    node: "Node"
    mark: Mark | None


@dataclass(frozen=True, slots=True)
class MapNode:
    """A map from words to nodes, in authored order."""

    entries: Mapping[str, Entry] = field(default_factory=dict)
    mark: Mark | None = None
    origins: tuple[Origin, ...] = ()

    def get(self, key: str) -> "Node | None":
        """Return the node under a key, or None where there is no such key."""
        entry = self.entries.get(key)
        return entry.node if entry else None

    def without(self, *keys: str) -> "MapNode":
        """Return the map without some of its keys."""
        return MapNode({key: entry for key, entry in self.entries.items() if key not in keys}, self.mark, self.origins)

    def replacing(self, key: str, node: "Node") -> "MapNode":
        """Return the map with another node under a key; a new key gets the mark of the node."""
        old = self.entries.get(key)
        return MapNode({**self.entries, key: Entry(node, old.mark if old else node.mark)}, self.mark, self.origins)


Node = ScalarNode | ListNode | MapNode

MISSING = ScalarNode("${}", True, None)
"""Stands for an argument that was not given, once that has been reported."""


def is_missing(node: Node) -> bool:
    """Tell whether a node stands for an argument that was not given."""
    return isinstance(node, ScalarNode) and node.mark is None and node.text == MISSING.text


def is_null(node: Node) -> bool:
    """Tell whether `null` is written in so many words; a value that is merely left out is not."""
    return isinstance(node, ScalarNode) and not node.quoted and node.text != "" and node.text in _NULL


def is_empty(node: Node) -> bool:
    """Tell whether a key is there and its value is left out."""
    return isinstance(node, ScalarNode) and not node.quoted and node.text == ""


def scalar_value(node: ScalarNode) -> str | int | float | bool | None:
    """Return the value of a scalar by the core schema of YAML 1.2."""
    return node.text if node.quoted else _plain_value(node.text)


@lru_cache(maxsize=4096)
def _plain_value(text: str) -> str | int | float | bool | None:
    if text in _NULL:
        return None
    if text in _BOOLEANS:
        return _BOOLEANS[text]
    if _INTEGER.match(text):
        return int(text, 0) if text[:2] in ("0o", "0x") else int(text)
    if _FLOAT.match(text):
        return float(text)
    match = _NOT_FINITE.match(text)
    if match:
        return float(match[1] + (match[2] or match[3]))
    return text


def kind_of(node: Node) -> str:
    """Return what a node is, in the words of an error message."""
    if isinstance(node, MapNode):
        return "a map"
    return "a list" if isinstance(node, ListNode) else "a single value"


def short_text(node: Node, length: int = 60) -> str:
    """Return a node as it would be written on one line, cut to a length."""
    if isinstance(node, ScalarNode):
        text = node.text
    elif isinstance(node, ListNode):
        text = "[" + ", ".join(short_text(item, length) for item in node.items[:12]) + "]"
    else:
        text = "{" + ", ".join(node.entries) + "}"
    return text if len(text) <= length else text[: length - 1] + "…"


def join(path: str, key: str | int) -> str:
    """Return a dotted path one step longer."""
    return f"{path}.{key}" if path else str(key)


def walk(node: Node, path: str = "") -> Iterator[tuple[str, Node]]:
    """Yield every node below and including this one with its dotted path, in authored order."""
    waiting = [(path, node)]
    while waiting:
        path, node = waiting.pop()
        yield path, node
        if not isinstance(node, ScalarNode):
            waiting += [(join(path, key), child) for key, child in reversed(children(node))]


def children(node: Node) -> list[tuple[str | int, Node]]:
    """Return what stands in a map or a list, with its key or position, in authored order; nothing for a scalar."""
    if isinstance(node, MapNode):
        return [(key, entry.node) for key, entry in node.entries.items()]
    return list(enumerate(node.items)) if isinstance(node, ListNode) else []


def size_within(node: Node, most: int, deepest: int) -> int | None:
    """Return how many nodes a tree has, or None where it has more than `most` or is deeper than `deepest`."""
    waiting = [(node, 0)]
    size = 0
    while waiting:
        found, depth = waiting.pop()
        size += 1
        if size > most or depth > deepest:
            return None
        if isinstance(found, MapNode):
            waiting.extend((entry.node, depth + 1) for entry in found.entries.values())
        elif isinstance(found, ListNode):
            waiting.extend((item, depth + 1) for item in found.items)
    return size
