"""Truth tables of the units of reflex controllers, and what their sensors tell."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from neuromech.components.body_sensors import (
    MuscleForceSensor,
    MuscleLengthSensor,
    OverextensionSensor,
    PostureSensor,
    RectifiedJointSensor,
    RectifiedPostureSensor,
)
from neuromech.components.reflexes import GatedRelay, LatchUnit, LowPass, SampleAndHold, SaturatingNeuron, ThresholdUnit

numbers = st.floats(-10.0, 10.0)


@pytest.mark.parametrize(
    ("excitation", "inhibition", "expected"),
    [(0.0, 0.0, 0.0), (0.5, 0.0, 0.0), (0.50001, 0.0, 1.0), (1.0, 0.5, 0.0), (1.0, 0.4, 1.0), (0.0, 1.0, 0.0)],
)
def test_threshold_unit(excitation, inhibition, expected):
    assert ThresholdUnit.output(excitation, inhibition, 0.5) == expected


@pytest.mark.parametrize("before", [0.0, 1.0])
@pytest.mark.parametrize(
    ("own", "other", "expected"), [(1.0, 0.0, 1.0), (0.0, 1.0, 0.0), (1.0, 1.0, None), (0.0, 0.0, None)]
)
def test_latch_of_the_leg_that_stood_alone_last(before, own, other, expected):
    """Double support and flight change nothing."""
    wanted = before if expected is None else expected
    assert LatchUnit.output(before, own, other, 0.5, -0.5) == wanted
    assert LatchUnit.advance(before, own, other, 0.5, -0.5) == wanted


@pytest.mark.parametrize(("gate", "expected"), [(0.0, 0.0), (1.0, 0.3), (0.5, 0.15), (2.0, 0.6)])
def test_gated_relay_multiplies(gate, expected):
    assert GatedRelay.output(0.7, 0.5, gate, 0.1) == pytest.approx(expected)


@given(numbers, numbers)
def test_a_closed_gate_lets_nothing_through(excitation, inhibition):
    assert GatedRelay.output(excitation, inhibition, 0.0, 0.3) == 0.0


@pytest.mark.parametrize(("gate", "expected"), [(1.0, 0.25), (0.0, 0.9), (0.5, 0.9)])
def test_sample_and_hold(gate, expected):
    assert SampleAndHold.output(0.9, 0.5, 0.25, gate) == expected
    assert SampleAndHold.advance(0.9, 0.5, 0.25, gate) == expected


@given(numbers, numbers, numbers)
def test_rate_of_a_saturating_neuron_settles_within_zero_and_one(excitation, inhibition, bias):
    drive, rate = SaturatingNeuron.flow(excitation, inhibition, 0.01, bias)
    assert drive / rate == pytest.approx(min(1.0, max(0.0, excitation - inhibition + bias)), abs=1e-12)


@given(numbers, numbers)
def test_a_low_pass_settles_at_its_input(excitation, inhibition):
    drive, rate = LowPass.flow(excitation, inhibition, 0.02)
    assert drive / rate == pytest.approx(excitation - inhibition, abs=1e-12)
    assert rate == pytest.approx(50.0)


def test_muscle_sensors_subtract_their_offset():
    assert MuscleForceSensor.output(0.4, 0.1) == pytest.approx(0.3)
    assert MuscleLengthSensor.output(0.6, 0.71) == pytest.approx(-0.11)


@given(st.floats(-1.0, 1.0), st.floats(-5.0, 5.0))
def test_the_two_rectified_parts_of_posture_make_up_the_whole(angle, velocity):
    gains = (0.1, 1.9, 0.25)
    whole = PostureSensor.output(angle, velocity, *gains)
    forward, backward = (RectifiedPostureSensor.output(angle, velocity, *gains, sign) for sign in (1.0, -1.0))
    assert forward - backward == whole
    assert min(forward, backward) == 0.0
    assert whole == pytest.approx(1.9 * (angle - 0.1) + 0.25 * velocity)
    assert RectifiedJointSensor.output(angle, velocity, *gains, -1.0) == backward


@pytest.mark.parametrize(
    ("angle", "velocity", "expected"),
    [(0.2, 1.0, 0.1), (0.2, -1.0, 0.0), (0.2, 0.0, 0.0), (0.05, 1.0, 0.0)],
)
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_overextension_counts_beyond_the_limit_and_on_the_way_out_only(angle, velocity, expected, sign):
    assert OverextensionSensor.output(sign * angle, sign * velocity, sign * 3.1, sign * 3.0, sign) == pytest.approx(
        expected
    )
