"""Whether FBL+ is more robust than FBL (Dzeladini 2013, section 3.2): growing pushes and waves, many seeds, statistics.

The numbers of experiments 6a to 7b are put on both grounds: pushes that grow by 4 N from one to the next, 0.25 s each
in the mean, and waves whose flanks get steeper by two thirds of a percent from one to the next, both without end, so
that every run ends in a fall and its length is a measure. Each pair of numbers, FBL and FBL+ that were tuned on the
same, is compared: medians, the difference of the medians with the 95 % interval of a bootstrap, and the p of the
one-sided Mann-Whitney test, which is small where FBL+ goes on for longer.

    python tests/benchmarks/robustness.py 20 mujoco
"""

import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray
from scipy.stats import bootstrap, mannwhitneyu

from neuromech.analyse.measures import measure
from neuromech.compiler.lower import lower
from neuromech.errors import RunError
from neuromech.pipeline import build_graph, load_document
from neuromech.simulate.run import simulate
from neuromech.spec.measure import Measure

EXPERIMENTS = Path(__file__).parents[2] / "specs" / "human" / "experiments"
MODELS = MappingProxyType({"a": "FBL", "b": "FBL+"})
GROUNDS: Mapping[str, tuple[str, Measure, tuple[str, ...]]] = MappingProxyType(
    {
        "pushes, s": (
            "6",
            Measure(kind="time_alive"),
            (
                "parameters.largest_push.value=480 N",
                "parameters.push_deviation.value=96 N",
                "protocol.push_series.pushes.growing_over=120",
                "protocol.duration=150 s",
            ),
        ),
        "waves, m": (
            "7",
            Measure(kind="distance", segment="trunk"),
            (
                "parameters.steepest_wave.value=18 deg",
                "world.ground.waves.growing_over=49",
                "world.ground.waves.number=60",
                "protocol.duration=100 s",
            ),
        ),
    }
)
"""What is tried: the experiment whose world it is, what is measured of a run, and what is changed in that world."""

Values = NDArray[np.float64]


def numbers(experiment: str) -> list[str]:
    """Return what an experiment tunes, with the values that it has there, as changes of a document."""
    found = load_document(EXPERIMENTS / f"{experiment}.yaml").experiment
    tuned = found.study.tune if found.study else {}
    return [f"parameters.{name}.value={found.parameters[name].value}" for name in tuned]


def tried(experiment: str, ground: str, seeds: Sequence[int], engine: str) -> Values:
    """Return how far the numbers of an experiment come, for each seed, shape (n,).

    Raises:
        RunError: a run diverged.
    """
    world, measured, changes = GROUNDS[ground]
    file = EXPERIMENTS / f"{world}{experiment[-1]}.yaml"
    document = load_document(file, [*numbers(experiment), *changes, f"body.engine={engine}"])
    program, found = lower(build_graph(document)), []
    for seed in seeds:
        recording = simulate(program, seed=seed)
        if recording.outcome.kind == "diverged":
            raise RunError(recording.outcome.message)
        found.append(measure(recording, measured).value)
    return np.array(found, dtype=np.float64)


def compared(fbl: Values, plus: Values) -> str:
    """Return how much further FBL+ comes than FBL, in words."""
    spread = bootstrap((plus, fbl), lambda a, b, axis: np.median(a, axis=axis) - np.median(b, axis=axis), rng=0)
    low, high = spread.confidence_interval
    test = mannwhitneyu(plus, fbl, alternative="greater")
    words = f"FBL {np.median(fbl):.1f}, FBL+ {np.median(plus):.1f}, difference {np.median(plus) - np.median(fbl):+.1f}"
    return f"{words} ({low:+.1f} to {high:+.1f}), p = {test.pvalue:.3f}"


def main() -> None:
    """Try all four experiments on both grounds."""
    seeds, engine = range(int(sys.argv[1])), sys.argv[2]
    for ground in GROUNDS:
        for tuned in ("6", "7"):
            found = {model: tried(f"{tuned}{letter}", ground, seeds, engine) for letter, model in MODELS.items()}
            sys.stdout.write(f"{ground}, numbers of experiments {tuned}: {compared(found['FBL'], found['FBL+'])}\n")
            sys.stdout.flush()


if __name__ == "__main__":
    main()
