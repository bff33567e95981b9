"""Step and stride lengths of feet that are set down at known places."""

import numpy as np
import pytest

from neuromech.analyse.measures import MeasuredValue, measure
from neuromech.spec.measure import Measure

PERIOD, DUTY = 0.5, 0.6
FEET = {"feet": ["L.*", "R.*"], "level": "1 N"}


def take(recording, **spec):
    return measure(recording, Measure.model_validate(spec))


@pytest.fixture
def walk(record, time):
    """Two feet that stand still in stance at places given for each stride, 10 ms apart between heel and toe."""

    def make(left, right):
        signals = {}
        for name, phase, places in (("L", 0.0, left), ("R", 0.5, right)):
            cycle = time / PERIOD - phase
            stride = np.floor(cycle + 0.2).astype(int)  # the foot moves in mid-swing
            load = np.where(cycle % 1.0 < DUTY, 20.0, 0.0)
            place = np.array([places(number) for number in stride])
            for contact, offset in (("heel", 0.0), ("toe", 0.1)):
                signals[f"{name}.{contact}.force_z"] = (load, "N")
                signals[f"{name}.{contact}.x"] = (place + offset, "m")
        return record(signals)

    return make


@pytest.fixture
def regular(walk):
    return walk(lambda n: 0.8 * n, lambda n: 0.8 * n + 0.3)


def test_lengths_of_steps_and_strides(regular):
    # The window starts in the first stride of both feet, so touchdowns are L 1 … 10 and R 0 … 9.
    assert take(regular, kind="stride_length", **FEET) == MeasuredValue(pytest.approx(0.8), "m")
    steps_left, steps_right = 9 * [0.5] + [0.5], 9 * [0.3]
    assert take(regular, kind="step_length", **FEET).value == pytest.approx(np.mean(steps_left + steps_right), abs=1e-9)


def test_regularity_of_steps(regular):
    lengths = np.array(10 * [0.5] + 9 * [0.3])
    expected = np.log(lengths.mean() / lengths.var())
    assert take(regular, kind="step_length_snr", **FEET) == MeasuredValue(pytest.approx(expected, abs=1e-6), "")


def test_similarity_of_left_and_right_steps(walk):
    wobble = walk(lambda n: 0.8 * n + 0.01 * (-1.0) ** n, lambda n: 0.8 * n + 0.4)
    left = np.array([0.4 + 0.01 * (-1.0) ** n for n in range(1, 11)])
    right = np.array([0.4 - 0.01 * (-1.0) ** n for n in range(1, 10)])
    expected = np.log(abs(left.mean() / left.var() - right.mean() / right.var()))
    assert take(wobble, kind="step_length_similarity", **FEET).value == pytest.approx(expected, abs=1e-5)


def test_steps_without_a_ratio(walk):
    backward = walk(lambda n: -0.8 * n, lambda n: -0.8 * n - 0.4)
    assert take(backward, kind="step_length_snr", **FEET).value == "the steps do not go forward"
    assert take(backward, kind="step_length", **FEET).value == pytest.approx(-0.4)
    # Quarters of a metre are exact in binary.
    equal = walk(lambda n: 0.5 * n, lambda n: 0.5 * n + 0.25)
    one_contact = {"feet": ["L.heel", "R.heel"], "level": "1 N"}
    assert take(equal, kind="step_length_snr", **one_contact).value == "all steps are equal"


def test_too_few_steps(regular):
    found = take(regular, kind="step_length", until="1.2 s", **FEET)
    assert found.value == "L.* makes fewer than 3 strides"
