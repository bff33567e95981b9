"""What is finished of a sweep, on disk: a line of JSON for each run, so that a killed sweep goes on where it was."""

import json
import os
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from types import TracebackType
from typing import IO, Any, Self

from neuromech.errors import StudyError
from neuromech.graph.diff import Change
from neuromech.spec.document import Document
from neuromech.study.header import body_digest, changes_of, is_free_parameter_text
from neuromech.study.sweeps.results import PointResult

FORMAT = "neuromech sweep 1"
_FREE = ("name", "description", "references", "claims", "study")


@dataclass(frozen=True, slots=True)
class SweepHeader:
    """What a sweep is: written when it begins, compared when it is continued.

    Args:
        sweep: its name.
        specification: the resolved document as YAML.
        body: SHA-256 of the file that the body comes from, None without one.
    """

    sweep: str
    specification: str
    body: str | None

    @classmethod
    def of(cls, document: Document, sweep: str) -> Self:
        """Return the header of a sweep of a document.

        Raises:
            OSError: the file of the body cannot be read.
        """
        return cls(sweep, document.text, body_digest(document))

    def changes(self, now: Self) -> list[Change]:
        """Return what a sweep that goes on would do differently from this one, by path."""
        found = changes_of(self.specification, now.specification, self._is_free)
        if self.body != now.body:
            found.append(Change("content of body.file", str(self.body)[:12], str(now.body)[:12]))
        return found

    def _is_free(self, path: str) -> bool:
        if path.startswith("sweeps."):
            return not path.startswith(f"sweeps.{self.sweep}.")
        return is_free_parameter_text(path) or path.split(".")[0] in _FREE


class Journal:
    """The file of an unfinished sweep; to be used in a `with` block.

    Each run is on the disk when `write` returns. A line that a killed process left incomplete is cut off.

    Args:
        file: the journal; it is made where there is none.
        header: of the sweep that is to be carried out.

    Raises:
        StudyError: the journal is of another sweep or of a changed document, or no journal.
        OSError: it cannot be read or written.
    """

    def __init__(self, file: Path, header: SweepHeader) -> None:
        lines = _complete_lines(file)
        self.finished = dict(_finished(lines[1:], file)) if lines else {}
        if lines:
            _refuse_other(lines[0], header, file)
        file.parent.mkdir(parents=True, exist_ok=True)
        self._stream: IO[bytes] = file.open("r+b" if file.exists() else "w+b")
        self._stream.truncate(sum(len(line) for line in lines))
        self._stream.seek(0, os.SEEK_END)
        if not lines:
            self._append({"format": FORMAT, **asdict(header)})

    def write(self, number: int, results: Sequence[PointResult]) -> None:
        """Keep what became of the points of a run.

        Args:
            number: of the job.
            results: of its points.

        Raises:
            OSError: the disk takes no more.
        """
        self._append({"job": number, "results": [result.to_dict() for result in results]})
        self.finished[number] = tuple(results)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self._stream.close()

    def _append(self, value: dict[str, Any]) -> None:
        self._stream.write(json.dumps(value, ensure_ascii=False).encode() + b"\n")
        self._stream.flush()
        os.fsync(self._stream.fileno())


def _complete_lines(file: Path) -> list[bytes]:
    if not file.exists():
        return []
    return [line for line in file.read_bytes().splitlines(keepends=True) if line.endswith(b"\n")]


def _finished(lines: Sequence[bytes], file: Path) -> Iterator[tuple[int, tuple[PointResult, ...]]]:
    try:
        for line in lines:
            entry = json.loads(line)
            yield int(entry["job"]), tuple(PointResult.from_dict(result) for result in entry["results"])
    except (ValueError, KeyError, TypeError) as error:
        raise _foreign(file) from error


def _refuse_other(line: bytes, header: SweepHeader, file: Path) -> None:
    """Refuse to go on with another sweep than the one that was begun.

    Raises:
        StudyError: it is another one.
    """
    try:
        entry = json.loads(line)
        if entry.pop("format") != FORMAT:
            raise _foreign(file)
        begun = SweepHeader(**entry)
        changes = begun.changes(header)
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        raise _foreign(file) from error
    if begun.sweep != header.sweep or changes:
        shown = "\n".join(f"  {change}" for change in changes)
        hint = "undo the changes to go on, choose another folder with '--out', or begin anew with '--restart'"
        raise StudyError(f"the sweep in {file} was begun with another document:\n{shown}\nHint: {hint}")


def _foreign(file: Path) -> StudyError:
    return StudyError(f"{file} is no journal of a sweep. Hint: remove it, or choose another folder with '--out'")
