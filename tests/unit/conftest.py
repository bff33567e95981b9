"""Documents as text, on their way to a run."""

import json
from collections.abc import Callable
from pathlib import Path
from textwrap import dedent
from typing import Any

import pytest
from hypothesis import settings

# How long an example takes hangs on what else the machine does.
settings.register_profile("unhurried", deadline=None)
settings.load_profile("unhurried")

Write = Callable[[str | dict[str, Any]], Path]


@pytest.fixture
def document(tmp_path: Path) -> Write:
    """A function that writes a document, given as text or as plain values, and returns its file."""

    def write(content: str | dict[str, Any]) -> Path:
        file = tmp_path / f"document{len(list(tmp_path.iterdir()))}.yaml"
        head = {"neuromech": 1, "name": "test"}
        text = (
            "neuromech: 1\nname: test\n" + dedent(content) if isinstance(content, str) else json.dumps(head | content)
        )
        file.write_text(text, encoding="utf-8")
        return file

    return write
