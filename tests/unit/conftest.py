"""Documents as text, on their way to a run."""

from collections.abc import Callable
from pathlib import Path
from textwrap import dedent

import pytest

Write = Callable[[str], Path]


@pytest.fixture
def document(tmp_path: Path) -> Write:
    """A function that writes the text of a document and returns its file."""

    def write(text: str) -> Path:
        file = tmp_path / f"document{len(list(tmp_path.iterdir()))}.yaml"
        file.write_text("neuromech: 1\nname: test\n" + dedent(text), encoding="utf-8")
        return file

    return write
