"""Where the time of a whole body step goes, step by step, inside the loop: for a machine on which other programs run.

    python tests/benchmarks/loop_parts.py [suspended|standing] [pybullet|mujoco]

Every part of every step is timed by the processor's counter. Shown is the median of the steps, in the best of some
runs: a step that another program interrupts is one of thousands. The bare step is timed in the same way.
"""

import sys
import tempfile
import time
from importlib import import_module
from pathlib import Path
from typing import Any

import numba
import numpy as np
from llvmlite import ir
from numba.core import types
from numba.extending import intrinsic

from neuromech.bench.body_loop import SEED, applied_torques, body
from neuromech.bench.workspace import Workspace
from neuromech.bodies.factory import open_body
from neuromech.bodies.pybullet import PyBulletBody
from neuromech.bodies.pybullet_import import pybullet
from neuromech.compiler.numerics import within
from neuromech.compiler.program import Program
from neuromech.graph.model import BodyModel
from neuromech.simulate.initial import initial_states
from neuromech.simulate.recorder import Recorder

PARTS = ("read", "tick", "network", "step")
STEPS, RUNS = 4000, 7


@intrinsic
def counter(_context: Any) -> Any:
    """Return the processor's time-stamp counter."""

    def generate(_context: Any, builder: Any, _signature: Any, _arguments: Any) -> Any:
        kind = ir.FunctionType(ir.IntType(64), [])
        return builder.call(builder.module.declare_intrinsic("llvm.readcyclecounter", (), kind), [])

    return types.int64(), generate


def timed_loop(program: Program, native: str) -> Any:
    """Return the loop over body steps with a look at the counter between its parts."""
    engine, module = import_module(native), program.module
    read, step, tick, advance = engine.read, engine.step, within(module.tick), within(module.advance)
    joints, start, place = module.JOINTS, module.BODY, module.TORQUE

    @numba.njit(nogil=True)
    def loop(count, dt, x, s, u, p, F, integers, R, T, D, world, found):
        first, last = integers[start], integers[place]
        state, torque = s[first:last], s[last : last + integers[joints]]
        for number in range(count):
            a = counter()
            read(world, state)
            b = counter()
            tick(number, dt, x, s, u, p, F, integers, R, T, D)
            c = counter()
            advance(number, dt, x, s, u, p, F, integers)
            d = counter()
            step(world, torque)
            e = counter()
            found[number, 0], found[number, 1], found[number, 2], found[number, 3] = b - a, c - b, d - c, e - d

    return loop


def loop_parts(program: Program, model: BodyModel) -> list[float]:
    """Return the median time of each part (µs), of the best of some runs."""
    loop: Any = None
    runs = []
    for _ in range(RUNS):
        with open_body(model, program.tick) as opened:
            memory = program.memory()
            memory.x[:] = initial_states(program, SEED)
            samples = Recorder(program, memory.I, STEPS).samples
            opened.read(memory.s[program.header["body"] :][: opened.layout.size])
            program.module.begin(*memory.buffers)
            loop = loop or timed_loop(program, str(opened.native_module))
            found = np.zeros((STEPS, len(PARTS)))
            rest = (*memory.buffers, samples, memory.T, memory.D, opened.native(), found)
            loop(0, program.tick, *rest)
            started, counted = time.perf_counter(), found.sum()
            loop(STEPS, program.tick, *rest)
            spent, counted = time.perf_counter() - started, found.sum() - counted
            runs.append(np.median(found, axis=0) * spent / counted * 1e6)
    return np.min(runs, axis=0).tolist()


def bare_pybullet(program: Program, model: BodyModel) -> float:
    """Return the median time of `stepSimulation` (µs) with the torques of our loop, of the best of some runs."""
    torques, step = applied_torques(program, STEPS * program.tick), pybullet.stepSimulation
    times: list[float] = []

    def timed(*arguments: Any, **options: Any) -> None:
        started = time.perf_counter()
        step(*arguments, **options)
        times.append(time.perf_counter() - started)

    pybullet.stepSimulation = timed
    try:
        for _ in range(RUNS):
            with PyBulletBody(model, program.tick, "python") as opened:
                for torque in torques:
                    opened.step(torque)
    finally:
        pybullet.stepSimulation = step
    return float(np.median(np.reshape(times, (RUNS, -1)), axis=1).min() * 1e6)


def main(scene: Any = "suspended", engine: Any = "pybullet") -> None:
    """Print one line."""
    with tempfile.TemporaryDirectory() as folder:
        root = Path(__file__).parents[2]
        workspace = Workspace(root / "specs", Path(__file__).parent / "peers", Path(sys.executable), Path(folder))
        program = body(workspace, scene, engine)
    model = program.graph.body
    if model is None:
        raise SystemExit("the document has no body")
    parts = loop_parts(program, model)
    bare = bare_pybullet(program, model) if engine == "pybullet" else parts[-1]
    words = ", ".join(f"{name} {value:.2f}" for name, value in zip(PARTS, parts, strict=True))
    print(f"{words}, whole {sum(parts):.2f}, bare {bare:.2f} µs, ratio {sum(parts) / bare:.2f}")  # noqa: T201


if __name__ == "__main__":
    main(*sys.argv[1:])
