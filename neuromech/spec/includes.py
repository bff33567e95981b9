"""`extends`: the files of a document, merged in order."""

import os
from dataclasses import dataclass
from pathlib import Path

from neuromech.errors import DocumentError, Mark, Problem, did_you_mean
from neuromech.spec.merge import merge_maps
from neuromech.spec.node import ListNode, MapNode, Node, ScalarNode, short_text
from neuromech.spec.reader import read

MAXIMAL_CHAIN = 50


@dataclass(frozen=True)
class Composed:
    """A document's tree with everything that it extends, and the files that took part, in order of inclusion."""

    tree: MapNode
    files: tuple[Path, ...]


def compose(path: Path) -> Composed:
    """Return a file merged over everything that it extends.

    Raises:
        DocumentError: a file is missing, unreadable or includes itself, or two values do not merge.
    """
    composer = _Composer()
    tree = composer.tree(path, ())
    if composer.problems:
        raise DocumentError(composer.problems)
    return Composed(tree, tuple(composer.files))


class _Composer:
    def __init__(self) -> None:
        self.problems: list[Problem] = []
        self.files: list[Path] = []
        self._done: dict[Path, MapNode] = {}

    def tree(self, path: Path, chain: tuple[Path, ...]) -> MapNode:
        """Return the merged tree of a file; `chain` is the way that led to it."""
        key = Path(os.path.realpath(path))
        if key not in self._done:
            self.files.append(path)
            self._done[key] = self._merged(path, (*chain, path))
        return self._done[key]

    def _merged(self, path: Path, chain: tuple[Path, ...]) -> MapNode:
        own = self._read(path)
        result = MapNode({}, own.mark)
        for text, mark in self._names(own.get("extends")):
            target = Path(os.path.normpath(path.parent / text))
            if self._usable(target, mark, chain):
                result = merge_maps(result, self.tree(target, chain), "extends", self.problems)
        return merge_maps(result, own.without("extends"), "extends", self.problems)

    def _read(self, path: Path) -> MapNode:
        try:
            return read(path)
        except DocumentError as error:
            self.problems.extend(error.problems)
            return MapNode()

    def _names(self, node: Node | None) -> list[tuple[str, Mark | None]]:
        if node is None:
            return []
        items = node.items if isinstance(node, ListNode) else (node,)
        names = [(item.text, item.mark) for item in items if isinstance(item, ScalarNode) and item.text]
        if len(names) < len(items):
            message = "must be the relative path of a document, or a list of them"
            self.problems.append(Problem("extends", "extends", message, short_text(node) or "nothing", None, node.mark))
        return names

    def _usable(self, target: Path, mark: Mark | None, chain: tuple[Path, ...]) -> bool:
        way = " > ".join(str(file) for file in (*chain, target))
        if os.path.realpath(target) in {os.path.realpath(file) for file in chain}:
            self.problems.append(Problem("include-cycle", "extends", f"includes itself: {way}", None, None, mark))
            return False
        if len(chain) >= MAXIMAL_CHAIN:
            message = f"documents extend each other over more than {MAXIMAL_CHAIN} files"
            self.problems.append(Problem("include-chain", "extends", message, None, None, mark))
            return False
        if not target.is_file():
            self.problems.append(
                Problem("missing-include", "extends", f"there is no such file: {way}", None, _neighbours(target), mark)
            )
            return False
        return True


def _neighbours(target: Path) -> str | None:
    if not target.parent.is_dir():
        return f"there is no folder {target.parent}"
    hint = did_you_mean(target.name, (file.name for file in target.parent.glob("*.yaml")))
    return hint if hint.startswith("did you mean") else None
