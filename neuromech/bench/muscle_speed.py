"""One evaluation of a muscle along a length history, against the muscles of MuJoCo and OpenSim."""

import json
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np

from neuromech.bench.pairing import Comparison
from neuromech.bench.peers import Peer
from neuromech.bench.workspace import Workspace
from neuromech.compiler.numerics import Floats, compiled, equation
from neuromech.components.muscles import BrownMuscle

_SAMPLES = 1000
_EVALUATIONS = {"mujoco": 1_000_000, "opensim": 20_000}
_output = equation(BrownMuscle.output)


@contextmanager
def against_muscle(workspace: Workspace, engine: str) -> Iterator[Comparison]:
    """Compare the cost of one evaluation: force from activation, length and velocity.

    Raises:
        PeerError: the peer is not there.
    """
    history = _history()
    file = workspace.folder / "history.json"
    file.write_text(json.dumps({name: values.tolist() for name, values in history.items()}), encoding="utf-8")
    count = _EVALUATIONS[engine]
    with Peer([*workspace.script("muscle_peer.py"), file, engine]) as peer:
        notes = {"evaluations": count, "ours": "Brown muscle with its slopes in length and velocity"}
        yield Comparison(
            lambda: _own(history, 1_000_000), lambda: peer.run(count) / count, "s/evaluation", peer.description, notes
        )


def _history() -> dict[str, Floats]:
    """Return a walk of 0.457 s sampled at 1000 places: a swing of ±15 % about the optimal length."""
    phase = np.linspace(0.0, 2.0 * np.pi, _SAMPLES, endpoint=False)
    return {
        "length": 0.95 + 0.15 * np.sin(phase),
        "velocity": 0.15 * np.cos(phase) * 2.0 * np.pi / 0.457,
        "activation": 0.5 + 0.4 * np.sin(phase + 1.0),
    }


def _own(history: dict[str, Floats], count: int) -> float:
    values = (history["activation"], history["length"], history["velocity"], np.zeros((3, _SAMPLES)))
    _evaluate(1, *values)
    started = time.perf_counter()
    _evaluate(count, *values)
    return (time.perf_counter() - started) / count


@compiled
def _evaluate(count: int, activation: Floats, length: Floats, velocity: Floats, results: Floats) -> None:
    for k in range(count):
        n = k % length.shape[0]
        found: Any = _output(
            activation[n], 1.0, 0.0, length[n], velocity[n], 100.0, 1.0, 1.0, 0.03, 0.02, 1.0, 1.0, 1.0
        )
        results[0, n], results[1, n], results[2, n] = found[0], found[1], found[2]
