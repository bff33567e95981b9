"""`neuromech validate`: every problem of every document."""

from collections.abc import Sequence
from pathlib import Path

from neuromech.cli.documents import checked_graph, document_files
from neuromech.cli.problems import Format, write
from neuromech.cli.terminal import BAD_DOCUMENT, FINISHED, note, write_line
from neuromech.errors import DocumentError, Problem


def validate(paths: Sequence[Path], form: Format) -> int:
    """Write the problems of all documents to stdout and a count to stderr; return the exit code.

    Raises:
        DocumentError: a path does not exist.
    """
    files = document_files(paths)
    problems = list(dict.fromkeys(problem for file in files for problem in problems_of(file)))
    text = write(problems, form)
    if text:
        write_line(text)
    note(_verdict(len(files), len(problems)))
    return BAD_DOCUMENT if problems else FINISHED


def problems_of(file: Path) -> tuple[Problem, ...]:
    """Return everything that is wrong in one document; nothing where it is valid."""
    try:
        checked_graph(file)
    except DocumentError as error:
        return error.problems
    return ()


def _verdict(files: int, problems: int) -> str:
    documents = f"{files} document{'s' * (files != 1)}"
    return f"{documents}: {problems} problem{'s' * (problems != 1)}" if problems else f"{documents}: valid"
