"""Every shipped document is valid, runs, and is fast to validate."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from neuromech.pipeline import build_graph, load_document, run

ROOT = Path(__file__).parents[1]
SPECS = sorted((ROOT / "specs").rglob("*.yaml"))


def test_there_are_documents():
    assert SPECS


@pytest.mark.parametrize("file", SPECS, ids=lambda file: file.relative_to(ROOT).as_posix())
def test_shipped_document_runs(file: Path):
    graph = build_graph(load_document(file))
    assert graph.graph.number_of_nodes() > 0
    recording = run(file, duration=0.01)
    assert recording.outcome.kind == "finished", recording.outcome.message


@pytest.mark.parametrize("file", SPECS, ids=lambda file: file.relative_to(ROOT).as_posix())
def test_shipped_document_tells_the_editor_its_schema(file: Path):
    first = file.read_text("utf-8").partition("\n")[0]
    assert first.startswith("# yaml-language-server: $schema=")
    assert (file.parent / first.partition("=")[2]).is_file()


def test_validation_of_all_shipped_documents_is_quick():
    """It costs the import of what it cannot do without, half as much again, and 12 % of it for each document.

    That is 40 to 50 ms a document on a quiet machine. Both grow on a busy machine, so their ratio is what is tested.
    """
    libraries = "import networkx, numpy, pint, pydantic, ruamel.yaml, typer"
    needed = min(process_seconds([sys.executable, "-c", libraries]) for _ in range(3))
    taken = min(
        process_seconds([sys.executable, "-m", "neuromech.cli", "validate", str(ROOT / "specs")]) for _ in range(3)
    )
    assert taken < (1.5 + 0.12 * len(SPECS)) * needed


def process_seconds(command: list[str]) -> float:
    before = os.times()
    done = subprocess.run(command, check=False, capture_output=True, text=True)
    after = os.times()
    assert done.returncode == 0, done.stdout + done.stderr
    return after.children_user - before.children_user + after.children_system - before.children_system
