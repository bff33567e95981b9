"""The linear algebra of the coupling against NumPy, and what the scheme promises of one step."""

import numpy as np
import pytest

from neuromech.compiler.coupling import muscle_damping, muscle_torque, observer_implicit, soft_limit
from neuromech.compiler.numerics import interpolate, relaxed
from neuromech.compiler.solving import solve_symmetric, solve_under_free_root

ARMS = np.array([0.01, -0.02, 0.03, 0.015])
FIRST, JOINT = np.array([0, 2, 3, 4]), np.array([0, 2, 1, 2])
ROWS = np.array([[0.01, 0.0, -0.02], [0.0, 0.03, 0.0], [0.0, 0.0, 0.015]])  # Muscles by joints.


def spd(seed, n=5):
    root = np.random.default_rng(seed).normal(size=(n, n))
    return root @ root.T + 0.1 * np.eye(n)


@pytest.mark.parametrize("seed", range(5))
def test_symmetric_systems_are_solved(seed):
    matrix, vector = spd(seed), np.arange(5.0)
    solution = vector.copy()
    solve_symmetric(matrix.copy(), np.zeros(5, dtype=np.int64), solution)
    assert solution == pytest.approx(np.linalg.solve(matrix, vector), rel=1e-9)


def test_only_what_lies_within_the_envelope_is_read():
    blocks = np.zeros((6, 6))
    blocks[:3, :3], blocks[3:, 3:] = spd(1, 3), spd(2, 3)
    first, vector = np.array([0, 0, 0, 3, 3, 3]), np.arange(6.0)
    given = np.where(blocks == 0.0, np.nan, np.tril(blocks))
    solution = vector.copy()
    solve_symmetric(given, first, solution)
    assert solution == pytest.approx(np.linalg.solve(blocks, vector), rel=1e-9)


@pytest.mark.parametrize("limbs", [(3, 3, 3, 3), (1,), (2, 5), ()])
def test_joints_under_a_free_root_are_solved_as_any_others(limbs):
    starts = np.cumsum([0, *limbs])
    first = np.array([*np.repeat(starts[:-1], limbs), *[0] * 6], dtype=np.int64)
    whole = spd(3, len(first)) + 10.0 * np.eye(len(first))
    outside = np.indices(whole.shape)[1] < first[:, None]
    whole[outside | outside.T] = 0.0
    vector = np.arange(1.0, len(first) + 1.0)
    solution = vector.copy()
    solve_under_free_root(np.where(outside, np.nan, np.tril(whole)), first, solution)
    assert solution == pytest.approx(np.linalg.solve(whole, vector), rel=1e-9)


def test_torque_and_damping_are_products_with_the_moment_arms():
    force, slope = np.array([10.0, 20.0, 5.0]), np.array([100.0, 30.0, 7.0])
    torque, matrix = np.ones(3), np.eye(3)
    muscle_torque(force, ARMS, FIRST, JOINT, torque)
    muscle_damping(slope, ARMS, FIRST, JOINT, matrix)
    assert torque == pytest.approx(1.0 + ROWS.T @ force)
    assert matrix == pytest.approx(np.tril(np.eye(3) + ROWS.T @ np.diag(slope) @ ROWS))


def coupled(dt, mass, damping, torque, velocity, last_velocity, last_torque):
    applied, acceleration = torque.copy(), np.empty(len(torque))
    whole = np.zeros(len(torque), dtype=np.int64)
    observer_implicit(
        dt, mass.copy(), damping.copy(), whole, applied, velocity, last_velocity.copy(), last_torque, acceleration
    )
    return applied, acceleration


def test_predicted_acceleration_solves_the_implicit_equation():
    rng = np.random.default_rng(1)
    mass, damping, dt = spd(1), spd(2), 1e-3
    torque, velocity, last_velocity, last_torque = rng.normal(size=(4, 5))
    applied, a = coupled(dt, mass, damping, torque, velocity, last_velocity, last_torque)
    external = mass @ (velocity - last_velocity) / dt - last_torque
    assert mass @ a == pytest.approx(torque - dt * damping @ a + external)
    assert applied == pytest.approx(torque - dt * damping @ a)


def test_a_root_that_moves_acts_as_if_its_motion_were_eliminated():
    """Limbs of two joints each under a root of three motions, whose rows come last."""
    rng = np.random.default_rng(2)
    whole, dt = spd(6, 7), 1e-3
    whole[:2, 2:4] = whole[2:4, :2] = 0.0
    whole += 5.0 * np.eye(7)
    damping = np.zeros((4, 4))
    damping[:2, :2], damping[2:, 2:] = spd(7, 2), spd(8, 2)
    torque, velocity, last_velocity, last_torque = rng.normal(size=(4, 4))
    eliminated = whole[:4, :4] - whole[:4, 4:] @ np.linalg.solve(whole[4:, 4:], whole[4:, :4])
    expected, a = coupled(dt, eliminated, damping, torque, velocity, last_velocity, last_torque)
    applied, acceleration = torque.copy(), np.empty(7)
    first = np.array([0, 0, 2, 2, 0, 0, 0])
    observer_implicit(dt, np.tril(whole), damping, first, applied, velocity, last_velocity, last_torque, acceleration)
    assert applied == pytest.approx(expected, rel=1e-10)
    assert acceleration[:4] == pytest.approx(a, rel=1e-10)


def test_a_static_load_is_borne_without_bias():
    """Where the muscles hold a load and nothing moves, the torque that is applied is that of the muscles."""
    torque, still = np.array([3.0, -2.0, 0.5, 0.0, 1.0]), np.zeros(5)
    applied, a = coupled(1e-3, spd(3), 1e3 * spd(4), torque, still, still, torque)
    assert applied == pytest.approx(torque, rel=1e-12)
    assert a == pytest.approx(still, abs=1e-12)


def test_without_damping_the_torque_is_left_alone():
    rng = np.random.default_rng(5)
    torque, *rest = rng.normal(size=(4, 5))
    applied, _ = coupled(1e-3, spd(5), np.zeros((5, 5)), torque, *rest)
    assert applied == pytest.approx(torque, rel=1e-15)


def test_strong_damping_stops_a_joint_without_turning_it_round():
    """An explicit damper of this strength would reverse the velocity a hundredfold in one step."""
    mass, damping, dt, v = np.array([[1e-5]]), np.array([[1.0]]), 1e-3, 2.0
    for _ in range(20):
        torque = -damping[0] * v
        applied, _ = coupled(dt, mass, damping, torque, np.array([v]), np.array([v]), np.zeros(1))
        v, before = v + dt * applied[0] / mass[0, 0], v
        assert 0.0 <= v < before
    assert v < 1e-6


@pytest.mark.parametrize("rate", [0.0, 1e-9, 1e-4, 3.0, 400.0, 1e4, -2.0])
def test_relaxation_is_the_exact_solution(rate):
    x, drive, dt = 0.3, 5.0, 2e-3
    reached = dt if rate == 0.0 else -np.expm1(-rate * dt) / rate
    expected = x * np.exp(-rate * dt) + drive * reached
    assert relaxed(x, drive, rate, dt) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize(
    ("t", "value"), [(-1.0, 1.0), (0.0, 1.0), (1.0, 1.0), (1.5, 2.0), (2.0, 7.0), (2.5, 7.0), (9.0, 7.0)]
)
def test_breakpoints_are_joined_by_lines_and_the_later_of_two_holds(t, value):
    p = np.array([0.0, 1.0, 2.0, 2.0, 1.0, 1.0, 3.0, 7.0])
    assert interpolate(t, 0, 4, 0, 4, p) == pytest.approx(value)


@pytest.mark.parametrize(
    ("angle", "velocity", "torque", "damping"),
    [
        (0.5, 9.0, 0.0, 0.0),
        (1.1, 0.0, -0.1, 5.0),
        (1.1, 0.04, -0.3, 5.0),
        (1.1, -0.01, -0.05, 5.0),
        (1.1, -0.03, 0.0, 0.0),
        (-1.1, 0.0, 0.1, 5.0),
        (-1.1, -0.04, 0.3, 5.0),
        (-1.1, 0.03, 0.0, 0.0),
    ],
)
def test_a_soft_limit_resists_beyond_its_range_and_never_pulls(angle, velocity, torque, damping):
    """Dzeladini 2013 eq. 2.38 with range ±1 rad and a reference velocity of 0.02 rad/s, over the stiffness."""
    found = soft_limit.py_func(angle, velocity, -1.0, 1.0, 0.02)
    assert found == pytest.approx((torque, damping), abs=1e-12)
