"""The hinge is exact to rounding, which is what makes it a reference for everything else."""

from math import cos, pi, sin, sqrt

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.special import ellipk

from neuromech.bodies.hinge import HingeBody
from neuromech.testing.bodies import run
from neuromech.testing.body_models import GRAVITY, PENDULUM_ARM, PENDULUM_INERTIA, PENDULUM_MASS, pendulum

WEIGHT = PENDULUM_MASS * GRAVITY * PENDULUM_ARM


@pytest.mark.parametrize("angle", [0.05, 1.0, 3.0])
@pytest.mark.parametrize("steps", [10, 1000])
def test_it_is_back_after_the_exact_period(angle, steps):
    period = 4.0 * sqrt(PENDULUM_INERTIA / WEIGHT) * float(ellipk(sin(angle / 2) ** 2))
    with HingeBody(pendulum(angle), period / steps) as body:
        states = run(body, steps)
    assert states[-1, :2] == pytest.approx([angle, 0.0], abs=1e-11)
    assert states[steps // 2, :2] == pytest.approx([-angle, 0.0], abs=1e-11)


def test_torque_and_gravity_together_follow_the_equation_of_motion():
    torque = 1.2 * WEIGHT
    reference = solve_ivp(
        lambda _, y: [y[1], (torque - WEIGHT * sin(y[0])) / PENDULUM_INERTIA],
        (0.0, 2.0),
        [1.0, 0.0],
        method="DOP853",
        rtol=1e-13,
        atol=1e-13,
    )
    with HingeBody(pendulum(1.0), 2e-3) as body:
        states = run(body, 1000, np.array([torque]))
    assert np.ptp(states[:, 0]) > pi  # It turns over, far from small swings.
    assert states[-1, :2] == pytest.approx(reference.y[:, -1], rel=1e-10)


def test_work_of_the_torque_becomes_energy():
    torque = 2.0 * WEIGHT
    with HingeBody(pendulum(0.0), 1e-3) as body:
        angle, velocity = run(body, 500, np.array([torque]))[-1, :2]
    energy = 0.5 * PENDULUM_INERTIA * velocity**2 + WEIGHT * (1.0 - cos(angle))
    assert energy == pytest.approx(torque * angle, rel=1e-12)


def test_torque_of_a_step_is_held_over_it():
    with HingeBody(pendulum(gravity=0.0), 0.1) as body:
        state = np.zeros(body.layout.size)
        for push in (0.02, -0.02):
            body.step(np.array([push]))
        body.read(state)
    assert state[0] == pytest.approx(0.02 * 0.1**2 / PENDULUM_INERTIA, rel=1e-14)
    assert state[1] == pytest.approx(0.0, abs=1e-15)


def test_divergence_is_seen():
    with HingeBody(pendulum(), 1e-3) as body:
        state = np.zeros(body.layout.size)
        body.step(np.array([np.nan]))
        body.step(np.array([0.0]))
        body.read(state)
    assert np.isnan(state[:2]).all()
