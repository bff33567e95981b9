"""A loaded document: the typed experiment, and where each of its values was written."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from neuromech.errors import Mark, Problem
from neuromech.spec.model import Experiment


@dataclass(frozen=True)
class Document:
    """A document that is valid in itself (names are resolved later, by the graph).

    Args:
        file: the file it was loaded from.
        experiment: the typed document.
        marks: dotted path of every value after composition -> where it was written.
        text: the resolved document as YAML, for provenance.
        files: every file that took part, in order of inclusion.
    """

    file: Path
    experiment: Experiment
    marks: Mapping[str, Mark] = field(repr=False)
    text: str = field(repr=False)
    files: tuple[Path, ...]

    def mark(self, path: str) -> Mark | None:
        """Return where the value at a path was written, or else its closest ancestor that was written."""
        while path and path not in self.marks:
            path = path.rpartition(".")[0]
        return self.marks.get(path)

    def problem(self, code: str, path: str, message: str, got: str | None = None, hint: str | None = None) -> Problem:
        """Return a problem at a path of this document, with its position."""
        return Problem(code, path, message, got, hint, self.mark(path))
