"""Sensors against Habu 2020 equations 12 to 14."""

from math import exp

import pytest
from hypothesis import given
from hypothesis import strategies as st

from neuromech.components.sensors import (
    ContactSensor,
    JointSensor,
    LegLoadSensor,
    LinkSensor,
    MuscleSpindle,
    StretchSensor,
)

L_TH = 0.060


def stretch(length, velocity, load=5.0, scale=1.0):
    return StretchSensor.output(length, velocity, load, L_TH, 0.5, 20.0, 0.01, scale)


@pytest.mark.parametrize(("velocity", "power"), [(0.06, 1.0), (0.12, 2**0.6), (0.0, 0.0)])
@pytest.mark.parametrize(("length", "excess"), [(0.063, 0.05), (0.060, 0.0), (0.040, 0.0)])
def test_stretch_sensor_follows_equations_12_and_13(velocity, power, length, excess):
    assert stretch(length, velocity) == pytest.approx(0.5 * power + 20.0 * excess)
    assert stretch(length, velocity, scale=0.1) == pytest.approx(0.1 * (0.5 * power + 20.0 * excess))


def test_shortening_subtracts_by_the_same_power_as_stretch_adds():
    still = stretch(0.066, 0.0)
    assert stretch(0.066, 0.03) - still == pytest.approx(still - stretch(0.066, -0.03))
    assert still - stretch(0.066, -0.03) == pytest.approx(0.5 * 0.5**0.6)


@given(st.floats(0.0, 0.2), st.floats(-5.0, 5.0))
def test_feedback_is_never_negative(length, velocity):
    assert stretch(length, velocity) >= 0.0
    assert MuscleSpindle.output(length, velocity, L_TH, 0.5, 20.0) >= 0.0


@pytest.mark.parametrize(("load", "open_gate"), [(0.0, False), (0.01, False), (0.0101, True), (30.0, True)])
def test_only_a_loaded_leg_gives_stretch_feedback(load, open_gate):
    assert (stretch(0.066, 0.06, load) > 0.0) is open_gate


@given(st.floats(0.03, 0.1), st.floats(-1.0, 1.0))
def test_a_spindle_is_a_stretch_sensor_without_the_gate(length, velocity):
    assert MuscleSpindle.output(length, velocity, L_TH, 0.5, 20.0) == stretch(length, velocity)


def test_load_sensor_scales_what_it_filters():
    assert LegLoadSensor.output(29.0, 0.05) == (pytest.approx(1.45), 29.0)


def test_load_filter_answers_a_step_with_its_time_constant():
    drive, rate = LegLoadSensor.flow(30.0, 5e-3)
    load, dt = 0.0, 1e-6
    for _ in range(5000):
        load += dt * (drive - rate * load)
    assert load == pytest.approx(30.0 * (1.0 - exp(-1.0)), rel=1e-4)


def test_joint_link_and_contact_sensors_are_linear():
    assert JointSensor.output(0.4, -2.0, 0.1, 3.0, 0.5) == pytest.approx(3.0 * 0.3 - 1.0)
    assert LinkSensor.output(0.3, 0.5, -2.0) == pytest.approx(0.4)
    assert ContactSensor.output(0.3, 0.5, -2.0) == pytest.approx(0.4)
