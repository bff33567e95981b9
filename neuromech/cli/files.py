"""Names of folders, and writing files so that a reader, or a user who interrupts, never meets half of one."""

import os
import re
import tempfile
from collections.abc import Callable
from pathlib import Path


def folder_name(name: str) -> str:
    """Return the name of a document without what is special in a path."""
    return re.sub(r"[^\w+-]+", "_", name)


def write_text(file: Path, text: str) -> None:
    """Write text to a file, in place of what was there."""
    replace(file, lambda partial: partial.write_text(text, encoding="utf-8"))


def replace(file: Path, write: Callable[[Path], object]) -> None:
    """Let `write` fill a file beside the final one, then give it the final name in one step.

    Args:
        file: the final name; its suffix is kept while writing.
        write: gets the path to fill. When it raises, nothing is left behind.

    Raises:
        OSError: the folder cannot be made or written.
    """
    file.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix=f".{file.stem}-", dir=file.parent) as folder:
        partial = Path(folder) / file.name
        write(partial)
        os.replace(partial, file)
