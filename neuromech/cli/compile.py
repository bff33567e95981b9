"""`neuromech compile`: the generated program of a model."""

from collections.abc import Sequence
from pathlib import Path

from neuromech.cli.documents import checked_graph
from neuromech.cli.terminal import FINISHED, note, write_line
from neuromech.compiler.lower import lower
from neuromech.components.catalogue import Catalogue


def compile_(spec: Path, overrides: Sequence[str]) -> int:
    """Write the generated Python module to stdout and its file to stderr; return the exit code."""
    program = lower(checked_graph(spec, Catalogue.installed(), overrides))
    write_line(program.source.rstrip("\n"))
    note(f"cached in {program.module_file}")
    return FINISHED
