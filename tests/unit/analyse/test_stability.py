"""Rhythms that come back from a perturbation at a known rate."""

import numpy as np
import pytest

from neuromech.analyse.measures import MeasuredValue, measure
from neuromech.spec.measure import Measure

PERIOD, DUTY = 0.25, 0.6
FOOT = {"feet": ["L.foot"], "level": "1 N"}


def take(recording, **spec):
    return measure(recording, Measure.model_validate(FOOT | spec))


def decaying(factors, cycles=20):
    """States at the starts of cycles that each go back to 2 + k by their own factor, mixed by a fixed matrix."""
    powers = np.array([[factor**n for factor in factors] for n in range(cycles + 2)])
    mixed = powers @ np.array([[1.0, 0.5, 0.2], [0.3, 1.0, -0.4], [0.1, 0.2, 1.0]])[: len(factors), : len(factors)]
    return mixed + 2.0 + np.arange(len(factors))


@pytest.fixture
def walk(record, time):
    """A foot that steps four times a second, and signals that hold a value for each cycle."""

    def make(states):
        cycle = time / PERIOD
        signals = {"L.foot.force_z": (np.where(cycle % 1.0 < DUTY, 20.0, 0.0), "N")}
        number = np.minimum(np.floor(cycle + 0.5).astype(int), len(states) - 1)
        for index, values in enumerate(np.transpose(states)):
            signals[f"trunk.s{index}"] = (values[number], "m")
        return record(signals)

    return make


@pytest.mark.parametrize("factors", [(0.5,), (0.8, 0.3), (-0.7, 0.4), (1.05, 0.6), (0.9, 0.5, -0.2)])
def test_the_largest_multiplier(walk, factors):
    signals = [f"trunk.s{index}" for index in range(len(factors))]
    found = take(walk(decaying(factors)), kind="floquet_multiplier", signals=signals)
    assert found == MeasuredValue(pytest.approx(max(map(abs, factors)), abs=1e-6), "")


def test_a_rotating_perturbation(walk):
    turn = 0.6 * np.exp(2j * np.pi / 7.0)
    states = np.array([[(turn**n).real, (turn**n).imag] for n in range(22)])
    found = take(walk(states), kind="floquet_multiplier", signals=["trunk.s0", "trunk.s1"])
    assert found.value == pytest.approx(0.6, abs=1e-6)


def test_what_tells_nothing_of_stability(walk):
    still = walk(np.full((22, 1), 3.0))
    assert take(still, kind="floquet_multiplier", signals=["trunk.s0"]).value == "the cycles do not differ"
    short = take(walk(decaying((0.9, 0.5, -0.2))), kind="floquet_multiplier", signals=["trunk.*"], until="1.2 s")
    assert short.value == "3 cycles are too few for 3 signals"


@pytest.fixture
def pushed(walk):
    """A speed of 1 that a push in cycle 8 raises by 0.4; each cycle halves what is left."""
    excess = np.array([0.4 * 0.5 ** (n - 8) if n >= 8 else 0.0 for n in range(22)])
    recording = walk(1.0 + excess[:, None])
    return lambda **spec: take(recording, kind="recovery_steps", signal="trunk.s0", perturbed_at="1.9 s", **spec)


@pytest.mark.parametrize(("tolerance", "steps"), [("500 mm", 0.0), ("160 mm", 2.0), ("80 mm", 3.0), ("16 mm", 6.0)])
def test_steps_until_the_speed_is_back(pushed, tolerance, steps):
    # The mean over a step holds half of its own excess and half of the next one: 0.2, 0.3, 0.15, 0.075, 0.0375, …
    assert pushed(tolerance=tolerance) == MeasuredValue(steps, "")


def test_what_never_comes_back(pushed):
    assert pushed(tolerance="1 um").value == "not recovered"
    assert pushed(tolerance="16 mm", until="2.6 s").value == "not recovered"


def test_a_baseline_takes_three_steps(pushed):
    assert pushed(tolerance="80 mm", after="1.3 s").value == "too few steps before the perturbation"
