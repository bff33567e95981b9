"""What a process compiled or loaded before has no part in its numbers."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from relays import relays

from neuromech.compiler.lower import lower
from neuromech.pipeline import build_graph, load_document
from neuromech.simulate.run import simulate

SPECS = Path(__file__).parents[3] / "specs"
# The floating-point operations of LLVM that may be reordered, fused or approximated.
LIBERTY = re.compile(r"= f\w+ (?:\w+ )*?(?:fast|reassoc|contract|arcp|afn)\b")

RUNS = """
import hashlib, sys
from neuromech.pipeline import run
for engine in sys.argv[2:]:
    recording = run(sys.argv[1], ["claims=null", f"body.engine={engine}"], seed=3, duration=1.0)
    signals = b"".join(recording.signal(name)[1].tobytes() for name in recording.names)
    print(engine, hashlib.sha256(signals).hexdigest())
"""


def functions(code):
    """Return {name of each function that stands in the text of an LLVM module: its text}."""
    return {
        re.search(r'@"?([^"(]+)', one)[1]: one for one in re.findall(r"^define .*?^}", code, re.MULTILINE | re.DOTALL)
    }


def test_no_function_with_liberties_stands_beside_the_one_that_python_calls(document, tmp_path, monkeypatch):
    # Such a copy rounds in its own way, and the dynamic linker takes the copy that it saw first in a process.
    monkeypatch.setenv("NEUROMECH_CACHE_DIR", str(tmp_path))
    program = lower(build_graph(load_document(document(relays()))))
    simulate(program, duration=0.01)
    kernel = program.module.run
    (code,) = kernel.inspect_llvm().values()
    found = functions(code)
    assert any(LIBERTY.search(text) for text in found.values())
    others = [name for name in found if f"{len('run')}run" not in name]
    assert not [name for name in others if LIBERTY.search(found[name])]


@pytest.mark.slow
def test_what_was_compiled_before_and_in_which_order_changes_no_bit(tmp_path):
    environment = {**os.environ, "NEUROMECH_CACHE_DIR": str(tmp_path), "NUMBA_CACHE_DIR": str(tmp_path)}
    orders = (("mujoco", "pybullet"), ("pybullet", "mujoco"), ("mujoco",))
    said = [
        subprocess.run(
            [sys.executable, "-c", RUNS, str(SPECS / "human" / "walk.yaml"), *order],
            env=environment, capture_output=True, text=True, check=True,
        ).stdout.splitlines()
        for order in orders
    ]  # fmt: skip
    compiled_here, loaded, alone = map(set, said)
    assert compiled_here == loaded
    assert alone < loaded
