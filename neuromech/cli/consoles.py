"""Rich consoles for tables and progress; a module of its own because commands that need none are quicker without."""

import os
import sys
from typing import TextIO

from rich.console import Console

WIDTH_OF_FILES = 160


def results() -> Console:
    """Return the console of stdout: what the user asked for."""
    return _console(sys.stdout)


def notes() -> Console:
    """Return the console of stderr: progress and tables that accompany a result."""
    return _console(sys.stderr)


def _console(stream: TextIO) -> Console:
    width = None if stream.isatty() or "COLUMNS" in os.environ else WIDTH_OF_FILES
    return Console(file=stream, width=width, highlight=False, soft_wrap=True)
