"""All benchmarks by name, in the order of the table, and how they are run."""

from collections.abc import Callable, Iterable, Iterator
from contextlib import AbstractContextManager
from dataclasses import replace
from functools import partial

from neuromech.bench.body_loop import Engine, Scene, body, loop_over_bare, real_time_factor
from neuromech.bench.muscle_speed import against_muscle
from neuromech.bench.network_speed import PERIOD_TOLERANCE, against_c, against_script, small_network
from neuromech.bench.pairing import Comparison, Result, failed, measure
from neuromech.bench.scaling import cost_per_neuron, recording, two_processes_of_c, two_threads
from neuromech.bench.starting import cold, warm
from neuromech.bench.workspace import Workspace
from neuromech.errors import NeuromechError

Opener = Callable[[Workspace], AbstractContextManager[Comparison]]


def _loop(scene: Scene, engine: Engine) -> Opener:
    return partial(loop_over_bare, scene=scene, engine=engine)


def _peer(script: str, *choices: tuple[str, ...], tolerance: float = PERIOD_TOLERANCE) -> Opener:
    return partial(against_script, script=script, choices=choices or ((),), tolerance=tolerance)


def _brian2(target: str) -> Opener:
    def opener(workspace: Workspace) -> AbstractContextManager[Comparison]:
        choices = ((target, str(workspace.steps)),)
        return against_script(workspace, script="brian2_peer.py", choices=choices)

    return opener


def _threads_of_cats(engine: Engine) -> Opener:
    def opener(workspace: Workspace) -> AbstractContextManager[Comparison]:
        return two_threads(body(workspace, "suspended", engine), _LONGER * workspace.body_seconds)

    return opener


def _threads_of_networks(workspace: Workspace) -> AbstractContextManager[Comparison]:
    program = small_network(workspace)
    return two_threads(program, _LONGER * workspace.steps * program.tick)


_SNS_TOLERANCE = 0.1
# Runs in threads are as long as the cat's document says: opening a body, which is done one at a time, is a small part.
_LONGER = 4

BENCHMARKS: dict[str, dict[str, Opener]] = {
    "pybullet_loop_over_bare_step": {
        "suspended": _loop("suspended", "pybullet"),
        "standing": _loop("standing", "pybullet"),
    },
    "mujoco_loop_over_bare_step": {
        "suspended": _loop("suspended", "mujoco"),
        "standing": _loop("standing", "mujoco"),
    },
    "human_loop_over_bare_step_pybullet": {"": _loop("human", "pybullet")},
    "human_loop_over_bare_step_mujoco": {"": _loop("human", "mujoco")},
    "human_real_time_factor_pybullet": {"": partial(real_time_factor, scene="human", engine="pybullet")},
    "human_real_time_factor_mujoco": {"": partial(real_time_factor, scene="human", engine="mujoco")},
    "network_over_c": {"": against_c},
    "network_over_brian2_cpp": {"": _brian2("cpp")},
    "network_over_brian2_cython": {"": _brian2("cython")},
    "network_over_brian2_numpy": {"": _brian2("numpy")},
    "network_over_sns_numpy": {"": _peer("sns_toolbox_peer.py", tolerance=_SNS_TOLERANCE)},
    "network_over_pyrates": {"": _peer("pyrates_peer.py", ("jax",), ("numba",))},
    "muscle_over_mujoco": {"": partial(against_muscle, engine="mujoco")},
    "muscle_over_opensim": {"": partial(against_muscle, engine="opensim")},
    "cost_per_neuron_7600_over_76": {"": cost_per_neuron},
    "two_threads_throughput": {"": _threads_of_cats("pybullet")},
    "two_threads_throughput_mujoco": {"": _threads_of_cats("mujoco")},
    "two_threads_throughput_network": {"": _threads_of_networks},
    "two_processes_of_c_throughput": {"": two_processes_of_c},
    "record_all_over_none": {"": recording},
    "run_to_first_step_seconds": {"": warm},
    "cold_compile_seconds": {"": cold},
}
"""Name -> parts by suffix. Where there are several parts, the name stands for the one with the largest ratio."""


def run(
    names: Iterable[str],
    workspace: Workspace,
    repetitions: int,
    benchmarks: dict[str, dict[str, Opener]] = BENCHMARKS,
) -> Iterator[Result]:
    """Yield the results of benchmarks one after another; of one with parts, those of the parts after its own.

    Args:
        names: which, of `benchmarks`.
        workspace: where things are.
        repetitions: of each pair.
        benchmarks: name -> parts by suffix.
    """
    for name in names:
        parts = benchmarks[name]
        if list(parts) == [""]:
            yield _result(name, parts[""], workspace, repetitions)
        else:
            found = [_result(f"{name}_{suffix}", part, workspace, repetitions) for suffix, part in parts.items()]
            yield worst(name, found)
            yield from found


def worst(name: str, parts: list[Result]) -> Result:
    """Return the part with the largest median ratio under another name; one that failed counts as the largest."""
    broken = [part for part in parts if part.problem]
    chosen = broken[0] if broken else max(parts, key=lambda part: part.as_dict()["ratio"])
    return replace(chosen, name=name)


def _result(name: str, opener: Opener, workspace: Workspace, repetitions: int) -> Result:
    try:
        with opener(workspace) as comparison:
            return measure(name, comparison, repetitions)
    except NeuromechError as error:
        return failed(name, str(error))
