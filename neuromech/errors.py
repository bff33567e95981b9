"""The words for failure: one exception tree and one grammar for problems in a document.

    NeuromechError
    ├── DocumentError        exit code 2: the document is wrong; carries every Problem found
    ├── RunError             exit code 3: the run ended early (fell, diverged)
    ├── RecordingError       exit code 2: a results file, or a signal asked of it, is not there
    ├── MeasureError         exit code 2: a measure or an expectation does not fit the signals it is about
    ├── StudyError           exit code 2: a study cannot be begun, found or continued
    └── MissingExtraError    exit code 2: an optional dependency is not installed

Anything else that escapes is a bug, and ends with exit code 1.
"""

import difflib
from collections.abc import Iterable
from dataclasses import dataclass
from typing import ClassVar


@dataclass(frozen=True, slots=True)
class Mark:
    """Where a value stands in a file; `line` and `column` count from 1."""

    file: str
    line: int
    column: int

    def __str__(self) -> str:
        return f"{self.file}:{self.line}:{self.column}"


@dataclass(frozen=True, slots=True)
class Problem:
    """One thing that is wrong in a document.

    Args:
        code: stable identifier of the rule, in kebab-case (`unknown-key`, `wrong-unit`).
        path: dotted path of the value in the document, empty for the document itself.
        message: what is wrong, as a clause without a full stop.
        got: what was found there, None where the message says it all.
        hint: what to do, None where there is nothing better to say than the message.
        mark: position, None for a value that no file wrote (for example `--set`).
    """

    code: str
    path: str
    message: str
    got: str | None = None
    hint: str | None = None
    mark: Mark | None = None

    def __str__(self) -> str:
        place = f"{self.mark}  " if self.mark else ""
        path = f"{self.path}  " if self.path else ""
        got = f" (got {self.got})" if self.got is not None else ""
        hint = f" Hint: {self.hint}" if self.hint else ""
        return f"{place}{path}{self.message}{got}.{hint}"


class NeuromechError(Exception):
    """Base of every error that this package raises on purpose."""

    exit_code: ClassVar[int] = 1


class DocumentError(NeuromechError):
    """A document cannot be used; `problems` lists everything that was found wrong, in file order."""

    exit_code: ClassVar[int] = 2

    def __init__(self, problems: Iterable[Problem]) -> None:
        self.problems: tuple[Problem, ...] = tuple(sorted(problems, key=_position))
        super().__init__("\n".join(str(problem) for problem in self.problems))


class RunError(NeuromechError):
    """A run ended before its protocol did."""

    exit_code: ClassVar[int] = 3


class RecordingError(NeuromechError):
    """A results file is not usable, or does not hold the signal that is asked of it."""

    exit_code: ClassVar[int] = 2


class MeasureError(NeuromechError):
    """A measure or an expectation does not fit: unknown kind, missing argument, clash of units."""

    exit_code: ClassVar[int] = 2


class StudyError(NeuromechError):
    """A study cannot be begun, found or continued: its storage, its executor, or a changed document."""

    exit_code: ClassVar[int] = 2


class MissingExtraError(NeuromechError):
    """An optional dependency is needed and not installed."""

    exit_code: ClassVar[int] = 2

    def __init__(self, package: str, extra: str) -> None:
        super().__init__(f"{package} is not installed. Hint: pip install 'neuromech[{extra}]'")


def did_you_mean(word: str, allowed: Iterable[str]) -> str:
    """Return a hint naming the closest allowed word, or all allowed words where none is close."""
    names = sorted(allowed)
    close = difflib.get_close_matches(word, names, n=1, cutoff=0.6)
    if close:
        return f"did you mean '{close[0]}'?"
    shown = ", ".join(names[:12]) + (", …" if len(names) > 12 else "")
    return f"allowed: {shown}" if names else "nothing is allowed here"


def _position(problem: Problem) -> tuple[str, int, int, str]:
    mark = problem.mark
    return (mark.file, mark.line, mark.column, problem.path) if mark else ("", 0, 0, problem.path)
