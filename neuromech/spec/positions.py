"""Where each key and each value of a resolved tree was written."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Self

from neuromech.errors import Mark, Problem
from neuromech.spec.node import ListNode, MapNode, Node, ScalarNode, join


@dataclass(frozen=True)
class Positions:
    """Marks and nodes by dotted path. The value of a map counts as written where its key is."""

    keys: Mapping[str, Mark]
    values: Mapping[str, Mark]
    nodes: Mapping[str, Node]

    @classmethod
    def of(cls, tree: MapNode) -> Self:
        """Collect the positions of a tree."""
        keys: dict[str, Mark] = {}
        values: dict[str, Mark] = {}
        nodes: dict[str, Node] = {}
        _collect(tree, "", tree.mark, keys, values, nodes)
        return cls(keys, values, nodes)

    def placed(self, problem: Problem, at_key: bool = False) -> Problem:
        """Return a problem with the position of its path, or else of the closest ancestor that was written."""
        if problem.mark is not None:
            return problem
        path = problem.path
        mark = self.keys.get(path) if at_key else self.values.get(path)
        while mark is None and path and path not in self.nodes:
            path = path.rpartition(".")[0]
            mark = self.values.get(path)
        return replace(problem, mark=mark)


def _collect(
    node: Node, path: str, key: Mark | None, keys: dict[str, Mark], values: dict[str, Mark], nodes: dict[str, Node]
) -> None:
    mark = key if isinstance(node, MapNode) else node.mark
    nodes[path] = node
    if key is not None:
        keys[path] = key
    if mark is not None:
        values[path] = mark
    if isinstance(node, MapNode):
        for name, entry in node.entries.items():
            _collect(entry.node, join(path, name), entry.mark, keys, values, nodes)
    elif not isinstance(node, ScalarNode):
        _collect_items(node, path, keys, values, nodes)


def _collect_items(
    node: ListNode, path: str, keys: dict[str, Mark], values: dict[str, Mark], nodes: dict[str, Node]
) -> None:
    for index, item in enumerate(node.items):
        _collect(item, join(path, index), item.mark, keys, values, nodes)
