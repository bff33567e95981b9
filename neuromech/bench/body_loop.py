"""The whole loop of a cat or a human against bare steps of its engine in the same scene.

The bare side replays the joint torques that our loop applied, so that body and contacts move in the same way.
"""

import time
from collections.abc import Iterator
from contextlib import contextmanager
from functools import lru_cache
from importlib import import_module
from typing import Any, Literal

import numba
import numpy as np

from neuromech.bench.pairing import Comparison
from neuromech.bench.peers import PeerError
from neuromech.bench.workspace import Workspace
from neuromech.bodies.factory import open_body
from neuromech.bodies.pybullet import PyBulletBody
from neuromech.bodies.pybullet_import import pybullet
from neuromech.compiler.lower import lower
from neuromech.compiler.numerics import Floats
from neuromech.compiler.program import Program
from neuromech.graph.model import BodyModel
from neuromech.pipeline import build_graph, load_document
from neuromech.simulate.run import simulate
from neuromech.simulate.start import drawn_body

Scene = Literal["suspended", "standing", "human"]
Engine = Literal["pybullet", "mujoco"]

SEED = 0

# The network is silent; springs hold the joints, so that the cat stands on its four feet.
_STANDING = """\
neuromech: 1
extends: {extended}
name: standing cat
parameters: {{drive: {{value: 0}}, joint_damping: {{value: 0.5 N m s/rad}}}}
protocol: {{duration: 20 s}}
body:
  root: {{kind: free, position: [0 m, 0 m, {height} m]}}
instances:
  LF:
    body:
      joints:
        scapula: {{stiffness: 40 N m/rad, rest_angle: -15 deg}}
        shoulder: {{stiffness: 40 N m/rad, rest_angle: 67 deg}}
        elbow: {{stiffness: 40 N m/rad, rest_angle: -73 deg}}
  LH:
    body:
      joints:
        hip: {{stiffness: 40 N m/rad, rest_angle: -28 deg}}
        knee: {{stiffness: 40 N m/rad, rest_angle: 78 deg}}
        ankle: {{stiffness: 40 N m/rad, rest_angle: -57 deg}}
"""
_STANDING_HEIGHT = 0.21
# What a document must record for its torques to be replayed.
TORQUES: dict[Scene, tuple[str, ...]] = {
    "suspended": (),
    "standing": (),
    "human": ("record.mechanics.every=1 ms",),
}


def body(workspace: Workspace, scene: Scene, engine: Engine, changes: tuple[str, ...] = ()) -> Program:
    """Return the cat in a scene, or the human who walks.

    Raises:
        DocumentError: the engine is not known or cannot move the body.
        MissingExtraError: the engine is not installed.
    """
    folder, name = ("human", "walk") if scene == "human" else ("cat", "suspended")
    file = workspace.specs / folder / f"{name}.yaml"
    if scene == "standing":
        text = _STANDING.format(extended=file.resolve(), height=_STANDING_HEIGHT)
        file = workspace.folder / "standing.yaml"
        file.write_text(text, encoding="utf-8")
    return lower(build_graph(load_document(file, ("claims=null", f"body.engine={engine}", *changes))))


@contextmanager
def loop_over_bare(workspace: Workspace, scene: Scene, engine: Engine) -> Iterator[Comparison]:
    """Compare the loop, as the document records, with bare steps.

    Raises:
        NeuromechError: the engine is not there, or has no compiled functions.
    """
    program = body(workspace, scene, engine)
    seconds = workspace.body_seconds
    torques = applied_torques(body(workspace, scene, engine, TORQUES[scene]), seconds)
    bare = _bare_pybullet if engine == "pybullet" else _bare_native
    yield Comparison(
        lambda: loop_seconds_per_step(program, seconds),
        lambda: bare(program, torques),
        "s/step",
        "stepSimulation alone" if engine == "pybullet" else "mj_step in a compiled loop",
        {"scene": scene, "simulated_seconds": seconds},
    )


@contextmanager
def real_time_factor(workspace: Workspace, scene: Scene, engine: Engine) -> Iterator[Comparison]:
    """Measure how many simulated seconds the loop, as the document records, makes in a second."""
    program = body(workspace, scene, engine)
    seconds = workspace.body_seconds
    yield Comparison(
        lambda: program.tick / loop_seconds_per_step(program, seconds),
        None,
        "simulated s/s",
        "",
        {"scene": scene, "simulated_seconds": seconds},
    )


def loop_seconds_per_step(program: Program, seconds: float) -> float:
    """Return the loop's wall time for one step (s), without opening the body."""
    opening = simulate(program, seed=SEED, duration=program.tick).provenance.wall_seconds
    whole = simulate(program, seed=SEED, duration=seconds).provenance
    return (whole.wall_seconds - opening) / (round(seconds / program.tick) - 1)


def applied_torques(program: Program, seconds: float) -> Floats:
    """Return the torques that the loop applies, shape (steps, joints).

    Raises:
        PeerError: the run ends early.
    """
    recording = simulate(program, seed=SEED, duration=seconds)
    if recording.outcome.kind != "finished":
        raise PeerError(f"the run ended early: {recording.outcome.message}")
    columns = [recording.signal(f"{joint}.torque")[1] for joint in _model(program).joints]
    return np.ascontiguousarray(np.stack(columns, axis=1))


def _bare_pybullet(program: Program, torques: Floats) -> float:
    """Return the mean time of `stepSimulation` (s): a stopwatch around it alone while torques are replayed."""
    spent, step = 0.0, pybullet.stepSimulation

    def timed(*arguments: Any, **options: Any) -> None:
        nonlocal spent
        started = time.perf_counter()
        step(*arguments, **options)
        spent += time.perf_counter() - started

    pybullet.stepSimulation = timed
    try:
        with PyBulletBody(_model(program), program.tick, "python") as engine:
            for torque in torques:
                engine.step(torque)
    finally:
        pybullet.stepSimulation = step
    return spent / len(torques)


def _bare_native(program: Program, torques: Floats) -> float:
    """Return the mean time of the engine's compiled step with replayed torques, nothing read (s)."""
    with open_body(_model(program), program.tick) as opened:
        engine = opened.native()
        if engine is None or opened.native_module is None:
            raise PeerError(f"{opened.engine.name} has no compiled functions here")
        replay = _replay(opened.native_module)
        replay(engine, torques[:0])
        started = time.perf_counter()
        failure = replay(engine, torques)
        spent = time.perf_counter() - started
        if failure:
            opened.check()
        return spent / len(torques)


def _model(program: Program) -> BodyModel:
    model = drawn_body(program.graph, SEED)
    if model is None:
        raise ValueError("cats and humans have bodies")
    return model


@lru_cache
def _replay(module: str) -> Any:
    step = import_module(module).step

    @numba.njit
    def replay(engine: Any, torques: Floats) -> int:
        for k in range(torques.shape[0]):
            failure = step(engine, torques[k])
            if failure:
                return int(failure)
        return 0

    return replay
