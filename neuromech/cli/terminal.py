"""The two streams of a command: results to stdout, everything that accompanies them to stderr."""

import json
import os
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import wraps
from types import TracebackType
from typing import Any, ParamSpec

import typer

from neuromech.errors import DocumentError, MissingExtraError, NeuromechError

FINISHED = 0
BUG = 1
BAD_DOCUMENT = 2
ENDED_EARLY = 3
CLAIM_NOT_MET = 4
TRACEBACK_VARIABLE = "NEUROMECH_TRACEBACK"

Arguments = ParamSpec("Arguments")


def write_line(text: str) -> None:
    """Write plain text and a line end to stdout, without markup or wrapping."""
    sys.stdout.write(f"{text}\n")


def write_json(value: object) -> None:
    """Write one JSON value to stdout.

    Raises:
        ValueError: the value holds NaN or infinity, which JSON has no word for.
    """
    write_line(json.dumps(value, indent=2, ensure_ascii=False, allow_nan=False))


def note(text: str) -> None:
    """Write a line to stderr that is no error."""
    sys.stderr.write(f"{text}\n")


def keep_stdout_for_results() -> None:
    """Let only Python write to stdout: engines print their build date and their chatter there from C."""
    if sys.stdout is None:
        return
    encoding = sys.stdout.encoding
    sys.stdout.flush()
    sys.stdout = os.fdopen(os.dup(1), "w", encoding=encoding, errors="backslashreplace")
    null = os.open(os.devnull, os.O_WRONLY)
    os.dup2(null, 1)
    os.close(null)


@contextmanager
def without_banners() -> Iterator[None]:
    """Keep quiet what engines print to stderr from C while they are imported."""
    sys.stderr.flush()
    own, null = os.dup(2), os.open(os.devnull, os.O_WRONLY)
    os.dup2(null, 2)
    try:
        yield
    finally:
        os.dup2(own, 2)
        os.close(own)
        os.close(null)


@contextmanager
def of_extra(extra: str) -> Iterator[None]:
    """Say which extra to install where an import in the block finds a package missing.

    Raises:
        MissingExtraError: a package that is not ours is not installed.
    """
    try:
        yield
    except ModuleNotFoundError as error:
        package = (error.name or "").partition(".")[0]
        if package == "neuromech":
            raise
        raise MissingExtraError(package, extra) from error


def complain(text: str) -> None:
    """Write an error to stderr as it is."""
    sys.stderr.write(f"{text}\n")


def exits(command: Callable[Arguments, int]) -> Callable[Arguments, None]:
    """Turn a function that returns an exit code or raises our errors into a command.

    Our own errors and those of the file system end in a message and an exit code. Others are bugs and pass.
    """

    @wraps(command)
    def ending(*arguments: Arguments.args, **options: Arguments.kwargs) -> None:
        raise typer.Exit(_exit_code(lambda: command(*arguments, **options)))

    return ending


def _exit_code(command: Callable[[], int]) -> int:
    try:
        code = command()
        sys.stdout.flush()
    except DocumentError as error:
        complain("\n".join(str(problem) for problem in error.problems))
        return BAD_DOCUMENT
    except NeuromechError as error:
        complain(str(error))
        return error.exit_code
    except KeyboardInterrupt:
        complain("stopped by the user")
        return ENDED_EARLY
    except BrokenPipeError:
        _forget_stdout()
        return FINISHED
    except OSError as error:
        complain(_file_system_message(error))
        return BAD_DOCUMENT
    return code


def _file_system_message(error: OSError) -> str:
    place = f"{error.filename}: " if error.filename else ""
    return f"{place}{error.strerror or error}. Hint: check that the path exists and that you may read or write it"


def _forget_stdout() -> None:
    # Python flushes stdout once more when it ends; without this the closed pipe would be reported a second time.
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def report_bug(kind: type[BaseException], error: BaseException, traceback: TracebackType | None) -> Any:
    """Say in one line that a bug was met, or print the traceback where the environment asks for it."""
    if os.environ.get(TRACEBACK_VARIABLE):
        sys.__excepthook__(kind, error, traceback)
    else:
        first = str(error).partition("\n")[0]
        complain(f"this is a bug in neuromech: {kind.__name__}: {first}. Hint: {TRACEBACK_VARIABLE}=1 shows where")
