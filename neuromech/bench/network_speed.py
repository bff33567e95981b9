"""The cat's network of 76 neurons, ours against peers that run the same network."""

import json
import subprocess
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any

from neuromech.analyse.windows import NotMeasurableError
from neuromech.bench.network import SAMPLING_STEPS, export, header, period
from neuromech.bench.pairing import Comparison
from neuromech.bench.peers import Peer, PeerError
from neuromech.bench.workspace import Workspace
from neuromech.compiler.lower import lower
from neuromech.compiler.program import Program
from neuromech.pipeline import build_graph, load_document
from neuromech.simulate.run import simulate

REFERENCE = "LF.RG-F"
SEED = 0
PERIOD_TOLERANCE = 0.02
"""How far a peer's period may be from ours, as a share of ours."""

_COMPILER = ("gcc", "-O3", "-march=native", "-ffast-math")


def small_network(workspace: Workspace) -> Program:
    """Return the quadruped's network at 0.5 ms, recording the reference neuron only."""
    signal = f"[{REFERENCE}.potential]"
    changes = ("claims=null", f"record.neurons.signals={signal}", "solver.method=rk4", "solver.step=0.5 ms")
    return lower(build_graph(load_document(workspace.specs / "cat" / "quadruped_cpg.yaml", changes)))


def seconds_per_step(program: Program, steps: int) -> float:
    """Run a network and return the loop's wall time for one step (s)."""
    return simulate(program, seed=SEED, duration=steps * program.tick).provenance.wall_seconds / steps


@contextmanager
def against_c(workspace: Workspace) -> Iterator[Comparison]:
    """Compare with the same equations in plain C.

    Raises:
        PeerError: there is no compiler, or the program disagrees.
    """
    program = small_network(workspace)
    with Peer([c_program(workspace, program)]) as peer:
        yield compared(program, peer, workspace.steps, PERIOD_TOLERANCE, " ".join(_COMPILER))


def c_program(workspace: Workspace, program: Program) -> Path:
    """Compile the plain C program of a network and return its file.

    Raises:
        PeerError: there is no compiler.
    """
    folder = workspace.folder
    Path(folder, "network.h").write_text(header(export(program, SEED, REFERENCE)), encoding="utf-8")
    binary = folder / "limit"
    _compile([*_COMPILER, f"-I{folder}", workspace.source("limit.c"), "-o", binary, "-lm"])
    return binary


@contextmanager
def against_script(
    workspace: Workspace, script: str, choices: Sequence[Sequence[str]] = ((),), tolerance: float = PERIOD_TOLERANCE
) -> Iterator[Comparison]:
    """Compare with a script of the peers, with the fastest of several choices of arguments.

    Raises:
        PeerError: no choice can be run, or the fastest disagrees.
    """
    program = small_network(workspace)
    file = workspace.folder / "network.json"
    file.write_text(json.dumps(export(program, SEED, REFERENCE)), encoding="utf-8")
    with ExitStack() as stack:
        peers = [stack.enter_context(Peer([*workspace.script(script), file, *choice])) for choice in choices]
        costs = [min(peer.run(workspace.steps), peer.run(workspace.steps)) for peer in peers]
        fastest = peers[costs.index(min(costs))]
        others = {peer.description: cost / workspace.steps for peer, cost in zip(peers, costs, strict=True)}
        yield compared(program, fastest, workspace.steps, tolerance, others=others)


def compared(
    program: Program,
    peer: Peer,
    steps: int,
    tolerance: float,
    how: str = "",
    others: dict[str, float] | None = None,
) -> Comparison:
    """Return the comparison with a peer whose period agrees with ours.

    Raises:
        PeerError: it does not agree.
    """
    mine, theirs = own_period(program, steps), peers_period(peer, steps, program.tick)
    if abs(theirs / mine - 1.0) > tolerance:
        raise PeerError(
            f"{peer.description}: its period is {theirs:.4f} s where ours is {mine:.4f} s,"
            f" further apart than {100.0 * tolerance:g} %"
        )
    notes: dict[str, Any] = {"period_ours": mine, "period_peer": theirs, "period_tolerance": tolerance, "steps": steps}
    if others and len(others) > 1:
        notes["choices"] = others
    against = f"{peer.description}, {how}" if how else peer.description
    return Comparison(
        lambda: seconds_per_step(program, steps), lambda: peer.run(steps) / steps, "s/step", against, notes
    )


def own_period(program: Program, steps: int) -> float:
    """Return the period of the reference neuron in our run (s).

    Raises:
        PeerError: there is none.
    """
    time, potential = simulate(program, seed=SEED, duration=steps * program.tick).signal(f"{REFERENCE}.potential")
    return _period(potential.tolist(), float(time[1] - time[0]), "our run")


def peers_period(peer: Peer, steps: int, tick: float) -> float:
    """Return the period of the reference neuron in a peer's run (s).

    Raises:
        PeerError: there is none.
    """
    peer.run(steps)
    return _period(peer.trace(), SAMPLING_STEPS * tick, peer.description)


def _period(potential: list[float], interval: float, who: str) -> float:
    try:
        return period(potential, interval)
    except NotMeasurableError as error:
        raise PeerError(f"{who} has no rhythm: {error}") from error


def _compile(command: Sequence[str | Path]) -> None:
    try:
        done = subprocess.run([str(part) for part in command], capture_output=True, text=True, check=False)
    except OSError as error:
        raise PeerError(f"{command[0]} cannot be started: {error.strerror}") from error
    if done.returncode:
        raise PeerError(f"{command[0]} failed: {done.stderr.strip().partition(chr(10))[0]}")
