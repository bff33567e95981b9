"""Reference curves of measures: the numbers of their files, put into the document."""

import csv
import math
from pathlib import Path

from neuromech.errors import Problem, did_you_mean
from neuromech.spec.node import Entry, ListNode, MapNode, Node, ScalarNode, join

_SECTIONS = ("claims", "study", "sweeps")


def fill_curves(tree: MapNode, document: Path, problems: list[Problem]) -> MapNode:
    """Return a document's tree in which each `curve` of a measure that names a `file` holds what it says instead.

    A resolved document can so be read again without its tables. A file stands relative to the file that names it. What
    is wrong with one is added to `problems`.

    Args:
        tree: the tree.
        document: the file of the document, for a curve that was written in no file.
        problems: is added to.
    """
    filler = _Filler(document, problems)
    entries = {
        key: Entry(filler.filled(entry.node, key), entry.mark) if key in _SECTIONS else entry
        for key, entry in tree.entries.items()
    }
    return MapNode(entries, tree.mark, tree.origins)


class _Filler:
    def __init__(self, document: Path, problems: list[Problem]) -> None:
        self._document = document
        self._problems = problems

    def filled(self, node: Node, path: str) -> Node:
        if isinstance(node, ListNode):
            items = tuple(self.filled(item, join(path, str(index))) for index, item in enumerate(node.items))
            return ListNode(items, node.mark, node.origins)
        if isinstance(node, ScalarNode):
            return node
        entries = {
            key: Entry(self._curve_or(key, entry.node, join(path, key)), entry.mark)
            for key, entry in node.entries.items()
        }
        return MapNode(entries, node.mark, node.origins)

    def _curve_or(self, key: str, node: Node, path: str) -> Node:
        file = node.get("file") if key == "curve" and isinstance(node, MapNode) else None
        if isinstance(node, MapNode) and isinstance(file, ScalarNode) and file.text:
            return self._curve(node, file, path)
        return self.filled(node, path)

    def _curve(self, node: MapNode, file: ScalarNode, path: str) -> MapNode:
        place = (Path(file.mark.file) if file.mark else self._document).parent / file.text
        if node.get("values") is not None:
            hint = "remove one of them"
            self._problems.append(
                Problem("curve-file", path, "has 'values' of its own beside 'file'", None, hint, file.mark)
            )
            return node
        columns = node.get("columns")
        names = (
            [item for item in columns.items if isinstance(item, ScalarNode)] if isinstance(columns, ListNode) else []
        )
        try:
            table = _read(place)
            lists = [table.numbers(table.names[0]), *(table.numbers(name.text) for name in names)]
        except ValueError as error:
            message, _, hint = str(error).partition(". Hint: ")
            self._problems.append(Problem("curve-file", join(path, "file"), message, None, hint or None, file.mark))
            return node
        phases, *values = [
            ListNode(tuple(ScalarNode(cell, False, file.mark) for cell in cells), file.mark) for cells in lists
        ]
        rest = node.without("file").replacing("phases", phases)
        return rest.replacing("values", ListNode(tuple(values), file.mark))


class _Table:
    """Columns of text by name, every cell a number."""

    def __init__(self, names: list[str], rows: list[list[str]]) -> None:
        self.names = names
        self._rows = rows

    def numbers(self, name: str) -> list[str]:
        """Return a column; a minus before its name turns it round.

        Raises:
            ValueError: there is no such column.
        """
        turned, plain = name.startswith("-"), name.removeprefix("-")
        if plain not in self.names:
            raise ValueError(f"the table has no column '{plain}'. Hint: {did_you_mean(plain, self.names)}")
        index = self.names.index(plain)
        sign = -1.0 if turned else 1.0
        return [repr(sign * float(row[index])) for row in self._rows]


def _read(file: Path) -> _Table:
    """Read a table: comment lines with `#`, one line of names, lines of numbers.

    Raises:
        ValueError: the file cannot be read, or is no such table.
    """
    try:
        text = file.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        reason = error.strerror if isinstance(error, OSError) else "it is no text"
        raise ValueError(f"cannot be read: {reason}") from error
    numbered = [(number, line) for number, line in enumerate(text.splitlines(), 1) if line.strip()]
    lines = [(number, line) for number, line in numbered if not line.startswith("#")]
    if len(lines) < 4:
        raise ValueError("must be a table of column names and at least three phases")
    names, *rows = csv.reader(line for _, line in lines)
    for (number, _), row in zip(lines[1:], rows, strict=True):
        if len(row) != len(names) or not all(_is_number(cell) for cell in row):
            raise ValueError(f"line {number} must hold {len(names)} numbers")
    return _Table([name.strip() for name in names], rows)


def _is_number(cell: str) -> bool:
    try:
        return math.isfinite(float(cell))
    except ValueError:
        return False
