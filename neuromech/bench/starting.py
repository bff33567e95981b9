"""How long a user waits before the first step: everything compiled already, and nothing compiled yet."""

import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from neuromech.bench.pairing import Comparison
from neuromech.bench.peers import PeerError
from neuromech.bench.workspace import Workspace

# The command `neuromech run` as it is, told to stop when it first reports progress, which is after its first step.
_DRIVER = """
import contextlib, os, sys
from neuromech.cli import main
from neuromech.cli import run as command
def first(_time):
    os.write(1, b"stepped")
    os._exit(0)
@contextlib.contextmanager
def reporting(*_):
    yield first
command.simulated_time = reporting
main.run_arguments(["run", sys.argv[1], "--duration", "1 ms", "--out", sys.argv[2], "--no-figures"])
"""


@contextmanager
def warm(workspace: Workspace) -> Iterator[Comparison]:
    """Measure the time from the start of `neuromech run` to its first step, with the user's caches."""
    notes = {"document": "cat/suspended.yaml"}
    yield Comparison(lambda: seconds_to_first_step(workspace, {}), None, "s", "", notes)


@contextmanager
def cold(workspace: Workspace) -> Iterator[Comparison]:
    """Compare the time to the first step with empty caches, ours and numba's, with that with full ones."""

    def emptied() -> float:
        with tempfile.TemporaryDirectory(dir=workspace.folder) as folder:
            return seconds_to_first_step(workspace, {"NEUROMECH_CACHE_DIR": folder, "NUMBA_CACHE_DIR": folder})

    yield Comparison(
        emptied,
        lambda: seconds_to_first_step(workspace, {}),
        "s",
        "the same with what was compiled before",
        {"document": "cat/suspended.yaml"},
        largest_repetitions=3,
    )


def seconds_to_first_step(workspace: Workspace, environment: dict[str, str]) -> float:
    """Return the time from starting a process to its first step (s).

    Raises:
        PeerError: the process ended without a step.
    """
    document = workspace.specs / "cat" / "suspended.yaml"
    started = time.perf_counter()
    done = subprocess.run(
        [sys.executable, "-c", _DRIVER, str(document), str(Path(workspace.folder, "first"))],
        env={**os.environ, **environment},
        capture_output=True,
        text=True,
        check=False,
    )
    if not done.stdout.endswith("stepped"):
        raise PeerError(f"neuromech run made no step: {done.stderr.strip()}")
    return time.perf_counter() - started
