"""Where the time of a body step goes: each part of the generated step, alone, in a compiled loop.

    python tests/benchmarks/step_parts.py [specs/cat/suspended.yaml] [path=value …]

The best of many short runs is shown, because another program's time can only be added to a part's own.
"""

import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numba
import numpy as np

from neuromech.bodies.factory import open_body
from neuromech.compiler.lower import lower
from neuromech.compiler.program import Memory, Program
from neuromech.pipeline import build_graph, load_document

PARTS = {
    "kinematics": "kinematics(s, F, I, T, D)",
    "muscle paths": "muscle_paths(s, p, F, I, T, D)",
    "muscles and sensors": "evaluate_mechanics(x, s, u, p, F, I)",
    "states that components advance": "advance_states(1e-3, x, s, u, p, F, I)",
    "mass matrix": "inertia_of_all(T[0], T[1], I[ROOT], D[0], D[1], D[7], D[8])",
    "torques and coupling, mass matrix included": "torques(1e-3, x, s, u, p, F, I, T, D)",
    "network: outputs": "network_outputs(x, s, u, p, F, I)",
    "network: inputs": "network_inputs(s, u, p, F, I)",
    "network: flows": "flows(x, u, p, I, drive, rate)",
    "network: one stage": "stage(x, s, u, p, F, I, drive, rate, 0, 0.0, False)",
    "tick: everything at one instant, recording included": "tick(k, 1e-3, x, s, u, p, F, I, R, T, D)",
    "advance: the network over the body step": "advance(k, 1e-3, x, s, u, p, F, I)",
}
REPETITIONS, STEPS = 150, 300


def main(file: str, *changes: str) -> None:
    """Print one line for each part."""
    program = lower(build_graph(load_document(Path(file), ("claims=null", *changes))))
    memory = _started(program)
    size = len(memory.x)
    samples = np.empty(1_000_000)
    arguments = (*memory.buffers, samples, memory.T, memory.D, np.zeros(size), np.zeros(size))
    for name, call in PARTS.items():
        loop = _loop(program, call)
        loop(1, *arguments)
        print(f"{_best(loop, arguments) * 1e6:7.3f} µs  {name}")  # noqa: T201


def _started(program: Program) -> Memory:
    memory = program.memory()
    if program.graph.body is None:
        raise SystemExit("the document has no body")
    with open_body(program.graph.body, program.tick) as body:
        body.read(memory.s[program.header["body"] :][: body.layout.size])
    program.module.begin(*memory.buffers)
    return memory


def _loop(program: Program, call: str) -> Callable[..., None]:
    names: dict[str, Any] = dict(vars(program.module))
    text = f"def loop(n, x, s, u, p, F, I, R, T, D, drive, rate):\n    for k in range(n):\n        {call}\n"
    exec(text, names)
    return numba.njit(nogil=True)(names["loop"])


def _best(loop: Callable[..., None], arguments: tuple[Any, ...]) -> float:
    best = np.inf
    for _ in range(REPETITIONS):
        started = time.perf_counter()
        loop(STEPS, *arguments)
        best = min(best, (time.perf_counter() - started) / STEPS)
    return best


if __name__ == "__main__":
    main(*(sys.argv[1:] or ["specs/cat/suspended.yaml"]))
