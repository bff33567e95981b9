"""`neuromech validate`: every problem of every document."""

import gc
from collections.abc import Iterable, Sequence
from pathlib import Path

from neuromech.cli.documents import checked_graph, document_files
from neuromech.cli.problems import Format, write
from neuromech.cli.terminal import BAD_DOCUMENT, FINISHED, note, write_line
from neuromech.components.catalogue import Catalogue
from neuromech.errors import DocumentError, Problem


def validate(paths: Sequence[Path], form: Format) -> int:
    """Write the problems of all documents to stdout and a count to stderr; return the exit code.

    Raises:
        DocumentError: a path does not exist.
    """
    files = document_files(paths)
    # What was imported lives to the end; the collector need not look at it after each document.
    gc.freeze()
    problems = problems_of(files)
    text = write(problems, form)
    if text:
        write_line(text)
    note(_verdict(len(files), len(problems)))
    return BAD_DOCUMENT if problems else FINISHED


def problems_of(files: Iterable[Path]) -> list[Problem]:
    """Return everything that is wrong in documents, each problem once; what they share is not told twice."""
    catalogue = Catalogue.installed()
    found: dict[Problem, None] = {}
    for file in files:
        try:
            checked_graph(file, catalogue)
        except DocumentError as error:
            found.update(dict.fromkeys(error.problems))
    return list(found)


def _verdict(files: int, problems: int) -> str:
    documents = f"{files} document{'s' * (files != 1)}"
    return f"{documents}: {problems} problem{'s' * (problems != 1)}" if problems else f"{documents}: valid"
