"""How our own cost changes: with size, with a second thread, with what is recorded."""

import time
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from ruamel.yaml import YAML

from neuromech.bench.body_loop import SEED, body
from neuromech.bench.network_speed import c_program, seconds_per_step, small_network
from neuromech.bench.pairing import Comparison
from neuromech.bench.peers import Peer
from neuromech.bench.workspace import Workspace
from neuromech.compiler.lower import lower
from neuromech.compiler.program import Program
from neuromech.pipeline import build_graph, load_document
from neuromech.simulate.run import simulate

_EVERYTHING = (
    *(f"record.{group}=null" for group in ("joints", "muscles", "feet")),
    "record.neurons.signals=['*']",
    "record.neurons.every=1 ms",
)
# A C program is so quick that its runs are made as long as those of the cat.
_C_STEPS = 4
LEGS = ("LF", "RF", "LH", "RH")


@contextmanager
def cost_per_neuron(workspace: Workspace, copies: int = 100) -> Iterator[Comparison]:
    """Compare the cost of a step per neuron in a network of many uncoupled quadrupeds with that in one."""
    small = small_network(workspace)
    started = time.perf_counter()
    large = herd(workspace, copies)
    lowered = time.perf_counter() - started
    few, many = _neurons(small), _neurons(large)
    steps = max(workspace.steps // copies, 10)
    yield Comparison(
        lambda: seconds_per_step(large, steps) / many,
        lambda: seconds_per_step(small, workspace.steps) / few,
        "s/step/neuron",
        f"{few} neurons",
        {"neurons": many, "seconds_from_document_to_program": lowered},
    )


def herd(workspace: Workspace, copies: int) -> Program:
    """Return a network of `copies` quadrupeds that know nothing of each other, at 0.5 ms, recording one neuron."""
    file = workspace.folder / f"herd{copies}.yaml"
    base = workspace.specs / "cat" / "quadruped_cpg.yaml"
    YAML(typ="safe").dump(_herd(base, copies), file)
    changes = ("claims=null", "record.neurons.signals=[LF.RG-F.potential]", "solver.method=rk4", "solver.step=0.5 ms")
    return lower(build_graph(load_document(file, changes)))


@contextmanager
def two_threads(program: Program, seconds: float) -> Iterator[Comparison]:
    """Compare the throughput of two simulations in two threads with that of one."""
    yield Comparison(
        lambda: _throughput(lambda: _in_threads(program, seconds, 2), 2 * seconds),
        lambda: _throughput(lambda: _in_threads(program, seconds, 1), seconds),
        "simulated s/s",
        "one simulation in one thread",
        {"simulated_seconds": seconds},
    )


@contextmanager
def two_processes_of_c(workspace: Workspace) -> Iterator[Comparison]:
    """Compare two plain C programs at the same time with one: what two cores of this machine give at all.

    Raises:
        PeerError: there is no compiler.
    """
    program = small_network(workspace)
    binary = c_program(workspace, program)
    steps = _C_STEPS * workspace.steps
    simulated = steps * program.tick
    with Peer([binary]) as first, Peer([binary]) as second:
        yield Comparison(
            lambda: _throughput(lambda: _at_once([first, second], steps), 2 * simulated),
            lambda: _throughput(lambda: _at_once([first], steps), simulated),
            "simulated s/s",
            "one C program alone",
            {"simulated_seconds": simulated},
        )


@contextmanager
def recording(workspace: Workspace) -> Iterator[Comparison]:
    """Compare the suspended cat with every signal recorded at 1 kHz with the same run that records nothing."""
    nothing = body(workspace, "suspended", "pybullet", ("record=null",))
    everything = body(workspace, "suspended", "pybullet", _EVERYTHING)
    seconds = workspace.body_seconds
    yield Comparison(
        lambda: _seconds(everything, seconds),
        lambda: _seconds(nothing, seconds),
        "s",
        "the same run that records nothing",
        {"simulated_seconds": seconds},
    )


def _herd(base: Path, copies: int) -> dict[str, Any]:
    leg, whole = (YAML(typ="safe").load(base.with_name(name)) for name in ("leg_cpg.yaml", base.name))
    arguments = {"LF": leg["instances"]["LF"], "LH": whole["instances"]["LH"]}
    instances: dict[str, Any] = {}
    synapses: dict[str, dict[str, str]] = {}
    for k in range(1, copies):
        for name in LEGS:
            instances[f"{name}{k}"] = arguments[f"L{name[1]}"]
        for sender, receivers in whole["network"]["synapses"]["interlimb"].items():
            synapses[_renamed(sender, k)] = {_renamed(name, k): weight for name, weight in receivers.items()}
    document = {"neuromech": 1, "extends": str(base.resolve()), "name": "herd", "instances": instances}
    return {**document, "network": {"synapses": {"interlimb": synapses}}}


def _renamed(name: str, copy: int) -> str:
    leg, _, neuron = name.partition(".")
    return f"{leg}{copy}.{neuron}"


def _neurons(program: Program) -> int:
    return sum(1 for _ in program.graph.elements("neuron"))


def _throughput(work: Callable[[], None], simulated: float) -> float:
    return simulated / _timed(work)


def _seconds(program: Program, seconds: float) -> float:
    return _timed(lambda: simulate(program, seed=SEED, duration=seconds))


def _timed(work: Callable[[], object]) -> float:
    started = time.perf_counter()
    work()
    return time.perf_counter() - started


def _at_once(peers: Sequence[Peer], steps: int) -> None:
    with ThreadPoolExecutor(len(peers)) as pool:
        for run in [pool.submit(peer.run, steps) for peer in peers]:
            run.result()


def _in_threads(program: Program, seconds: float, count: int) -> None:
    with ThreadPoolExecutor(count) as pool:
        for run in [pool.submit(simulate, program, seed=SEED + k, duration=seconds) for k in range(count)]:
            run.result()
