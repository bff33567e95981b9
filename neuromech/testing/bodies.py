"""Laws that every engine must keep. A law takes what opens a body, runs a small body, and asserts.

    def test_period():
        pendulum_keeps_its_period(open_my_body, step=1e-3, bound=1e-5)

Bounds are the caller's, because engines differ in order; each law says what its bound is relative to.
"""

from collections.abc import Callable
from math import sin, sqrt

import numpy as np
from numpy.typing import NDArray
from scipy.special import ellipk

from neuromech.bodies.base import Body
from neuromech.compiler.dynamics import mass_matrix
from neuromech.compiler.kinematics import forward_kinematics
from neuromech.compiler.tree import lower_tree
from neuromech.errors import RunError
from neuromech.graph.model import BodyModel
from neuromech.testing.body_models import (
    BLOCK_CENTER,
    BLOCK_MASS,
    GRAVITY,
    PENDULUM_ARM,
    PENDULUM_INERTIA,
    PENDULUM_MASS,
    SLED_MASS,
    block,
    chains,
    pendulum,
    sled,
)

Floats = NDArray[np.float64]
Opener = Callable[[BodyModel, float], Body]


def run(body: Body, steps: int, torque: Floats | None = None) -> Floats:
    """Advance a body under constant torques (none where not given) and return its states; (steps + 1, state)."""
    push = np.zeros(len(body.joints)) if torque is None else torque
    states = np.zeros((steps + 1, body.layout.size))
    body.read(states[0])
    for row in states[1:]:
        body.step(push)
        body.read(row)
    return states


def pendulum_keeps_its_period(opener: Opener, step: float, bound: float, angle: float = 1.5) -> None:
    """Period over three swings against 4/ω₀ K(sin²(θ/2)); `bound` is relative. Source: DLMF 22.19.6."""
    frequency = sqrt(PENDULUM_MASS * GRAVITY * PENDULUM_ARM / PENDULUM_INERTIA)
    exact = 4.0 / frequency * float(ellipk(sin(angle / 2) ** 2))
    with opener(pendulum(angle), step) as body:
        states = run(body, int(3.6 * exact / step))
    angles = states[:, 0]
    rises = np.flatnonzero((angles[:-1] < 0.0) & (angles[1:] >= 0.0))
    crossings = step * (rises - angles[rises] / (angles[rises + 1] - angles[rises]))
    period = float(np.mean(np.diff(crossings)))
    assert len(rises) >= 3
    assert abs(period / exact - 1.0) <= bound, f"period {period} s, exact {exact} s"


def pendulum_keeps_its_energy(opener: Opener, step: float, bound: float, seconds: float = 5.0) -> None:
    """Energy of a free swing from 2 rad never leaves its first value by `bound` times 2 m g r."""
    with opener(pendulum(2.0), step) as body:
        states = run(body, int(seconds / step))
    weight = PENDULUM_MASS * GRAVITY * PENDULUM_ARM
    energy = 0.5 * PENDULUM_INERTIA * states[:, 1] ** 2 - weight * np.cos(states[:, 0])
    worst = float(np.max(np.abs(energy - energy[0]))) / (2.0 * weight)
    assert np.ptp(states[:, 0]) > 3.9, "it does not swing"
    assert worst <= bound, f"energy drifts by {worst}"


def torque_turns_the_hinge(opener: Opener, step: float, bound: float) -> None:
    """Constant torque without gravity: q = τ t²/(2 I) after half a second; `bound` is relative to q."""
    steps = round(0.5 / step)
    with opener(pendulum(0.0, gravity=0.0), step) as body:
        states = run(body, steps, np.array([0.01]))
    exact = 0.01 * 0.5**2 / (2.0 * PENDULUM_INERTIA)
    assert abs(states[-1, 0] / exact - 1.0) <= bound, f"angle {states[-1, 0]}, exact {exact}"
    assert abs(states[-1, 1] / (0.01 * 0.5 / PENDULUM_INERTIA) - 1.0) <= bound


def range_holds_the_hinge(opener: Opener, step: float, bound: float) -> None:
    """A torque against either limit of a range goes at most `bound` rad beyond it, and comes to rest there."""
    for push in (-0.5, 0.5):
        with opener(pendulum(0.1, limits=(-0.3, 0.6)), step) as body:
            states = run(body, round(1.0 / step), np.array([push]))
        assert -0.3 - bound <= states[:, 0].min() <= states[:, 0].max() <= 0.6 + bound, states[:, 0]
        assert abs(states[-1, 0] - (0.6 if push > 0.0 else -0.3)) <= bound, states[-1, 0]
        assert abs(states[-1, 1]) <= bound


def reset_starts_anew(opener: Opener, step: float) -> None:
    """A run after a reset repeats the first run bit for bit, and velocities are taken."""
    with opener(pendulum(0.7), step) as body:
        first = run(body, 50)
        body.reset([0.7])
        assert np.array_equal(run(body, 50), first)
        body.reset([0.2], [-1.5])
        assert run(body, 0)[0, :2].tolist() == [0.2, -1.5]


def runs_repeat_bit_for_bit(opener: Opener, model: BodyModel, step: float, steps: int = 200) -> None:
    """Two bodies of one model, opened side by side and stepped in turns, have the same states to the last bit."""
    with opener(model, step) as one, opener(model, step) as two:
        torque = np.linspace(-0.01, 0.02, len(one.joints))
        states = np.zeros((2, steps, one.layout.size))
        for number in range(steps):
            for body, row in ((one, states[0, number]), (two, states[1, number])):
                body.step(torque)
                body.read(row)
    assert np.array_equal(states[0], states[1])


def bodies_do_not_disturb_each_other(opener: Opener, step: float) -> None:
    """A body runs the same while another one with other gravity is opened, stepped and closed."""
    with opener(pendulum(1.0), step) as alone:
        expected = run(alone, 60)
    with opener(pendulum(1.0), step) as body:
        found = [run(body, 20)]
        with opener(pendulum(-0.5, gravity=1.0), step) as other:
            found.append(run(body, 20)[1:])
            run(other, 20)
        found.append(run(body, 20)[1:])
    assert np.array_equal(np.concatenate(found), expected)


def closed_body_refuses(opener: Opener, step: float) -> None:
    """Closing twice is fine; a closed body raises `RunError` and nothing else."""
    body = opener(pendulum(), step)
    body.close()
    body.close()
    state = np.zeros(body.layout.size)
    calls: tuple[tuple[Callable[[Floats], None], Floats], ...] = (
        (body.read, state),
        (body.step, np.zeros(1)),
        (body.reset, np.zeros(1)),
    )
    for call, argument in calls:
        try:
            call(argument)
        except RunError:
            continue
        raise AssertionError("a closed body acts")


def block_falls_freely(opener: Opener, step: float, bound: float) -> None:
    """A tilted block falls g t²/2 in 0.2 s without turning; `bound` in metres."""
    with opener(block(5.0, orientation=(0.3, -0.4, 1.0)), step) as body:
        states = run(body, round(0.2 / step))
        pose = states[:, body.layout.root_pose]
        forces = states[:, body.layout.contact_forces]
    drop = pose[0] - pose[-1]
    assert pose[0, :3].tolist() == [0.3, -0.2, 5.0] or np.allclose(pose[0, :3], (0.3, -0.2, 5.0), rtol=0.0, atol=1e-12)
    assert abs(drop[2] - 0.5 * GRAVITY * 0.2**2) <= bound, drop
    assert np.allclose(drop[[0, 1, 3, 4, 5, 6]], 0.0, rtol=0.0, atol=1e-9)
    assert not forces.any()


def ground_carries_the_weight(opener: Opener, step: float, bound: float, model: BodyModel | None = None) -> None:
    """A settled block's contact forces sum to its weight; each foot bears what the lever law says; `bound` relative."""
    with opener(model or block(0.06), step) as body:
        states = run(body, round(1.0 / step))
        forces = states[-1, body.layout.contact_forces].reshape(-1, 3)
        rest = states[-1, body.layout.root_velocity]
    weight = BLOCK_MASS * GRAVITY
    assert np.abs(rest).max() < 1e-3, rest
    assert abs(forces[:, 2].sum() / weight - 1.0) <= bound, forces
    front = weight * (0.1 + BLOCK_CENTER[0]) / 0.2
    left = weight * (0.06 + BLOCK_CENTER[1]) / 0.12
    assert abs(forces[:2, 2].sum() / front - 1.0) <= bound, forces
    assert abs(forces[::2, 2].sum() / left - 1.0) <= bound, forces


def contact_forces_change_momentum(opener: Opener, step: float, bound: float, friction: float = 1.0) -> None:
    """M dv/dt of a tilted falling block equals contact forces and weight; `bound` is relative to the largest force."""
    with opener(block(0.09, orientation=(0.3, 0.4, 0.2), friction=friction), step) as body:
        states = run(body, round(0.4 / step))
        forces = states[1:, body.layout.contact_forces].reshape(len(states) - 1, -1, 3).sum(axis=1)
        velocity = _center_velocity(states[:, body.layout.root_pose], states[:, body.layout.root_velocity])
    change = BLOCK_MASS * np.diff(velocity, axis=0) / step + np.array([0.0, 0.0, BLOCK_MASS * GRAVITY])
    assert np.abs(forces[:, 2]).max() > BLOCK_MASS * GRAVITY, "it does not touch the ground"
    assert (np.abs(forces[:, 0]).max() > 1.0) == (friction > 0.0)
    assert np.abs(forces - change).max() <= bound * np.abs(forces).max(), np.abs(forces - change).max()


def landing_has_no_rebound(opener: Opener, step: float, bound: float) -> None:
    """A level block that falls on its feet does not take off again, nor rise faster than `bound` times its impact."""
    with opener(block(0.12), step) as body:
        states = run(body, round(0.5 / step))
        force = states[:, body.layout.contact_forces].reshape(len(states), -1, 3).sum(axis=1)[:, 2]
        speed = states[:, body.layout.root_velocity][:, 2]
    landed = int(np.flatnonzero(force)[0])
    impact = -speed[landed - 1]
    assert abs(impact / sqrt(2.0 * GRAVITY * 0.06) - 1.0) <= 0.01 + step * GRAVITY, impact
    assert (force[landed:] > 0.0).all(), "it takes off again"
    assert speed[landed:].max() <= bound * impact, speed[landed:].max() / impact


def friction_is_that_of_an_incline(opener: Opener, step: float, friction: float, bound: float, creep: float) -> None:
    """A weight W pushed by W tan θ, as on an incline of angle θ, rests where tan θ < μ; else it gains (tan θ − μ) W/m.

    μ is the product of the frictions of contact and ground. Forces are means over time.

    Args:
        opener: opens a body.
        step: in seconds.
        friction: of the contact.
        bound: of forces and the force that accelerates, relative to the weight.
        creep: greatest speed (m/s) of what should rest.
    """
    weight, limit = BLOCK_MASS * GRAVITY, 0.5 * friction
    for incline in (0.9 * limit, 1.5 * limit):
        with opener(sled(friction), step) as body:
            run(body, round(0.5 / step))
            states = run(body, round(1.0 / step), np.array([0.0, incline * weight]))[round(0.2 / step) :]
            speed = states[:, body.layout.velocities][:, 1]
            x, _, z = states[1:, body.layout.contact_forces].mean(axis=0) / weight
        gain = SLED_MASS * (speed[-1] - speed[0]) / (step * (len(speed) - 1)) / weight
        assert abs(gain - max(0.0, incline - limit)) <= bound, gain
        assert abs(x + min(incline, limit)) <= bound, x
        assert abs(z - 1.0) <= bound, z
        if incline < limit:
            assert np.abs(speed).max() <= creep, np.abs(speed).max()


def planar_root_stays_planar(opener: Opener, step: float) -> None:
    """A planar root that falls and tumbles over its feet keeps y, roll and yaw exactly."""
    with opener(block(0.12, root="planar", orientation=(0.0, 0.5, 0.0)), step) as body:
        states = run(body, round(0.5 / step))
        pose, velocity = states[:, body.layout.root_pose], states[:, body.layout.root_velocity]
    assert np.ptp(pose[:, 4]) > 0.1, "it does not tumble"
    assert (pose[:, 1] == -0.2).all()
    assert not pose[:, [3, 5]].any()
    assert not velocity[:, [1, 3, 5]].any()


def torque_accelerates_by_the_mass_matrix(opener: Opener, root: str, bound: float, step: float = 1e-5) -> None:
    """From rest and without gravity one short step changes joint velocities by dt M⁻¹ τ; `bound` is relative.

    M is `compiler.dynamics.mass_matrix`, with the motion of a free or planar root eliminated.
    """
    model = chains(root)
    tree = lower_tree(model)
    torque = np.linspace(-0.02, 0.03, len(model.joints))
    with opener(model, step) as body:
        states = run(body, 1, torque)
        start, end = states[0], states[1, body.layout.velocities]
        angles, pose = start[body.layout.angles], start[body.layout.root_pose]
    rotation, position = np.zeros((len(tree.segments), 3, 3)), np.zeros((len(tree.segments), 3))
    forward_kinematics(tree.topology, tree.geometry, angles, pose, rotation, position)
    expected = step * np.linalg.solve(mass_matrix(tree, rotation, position), torque)
    assert np.abs(end - expected).max() <= bound * np.abs(expected).max(), (end, expected)


def _center_velocity(pose: Floats, velocity: Floats) -> Floats:
    axis, scalar = pose[:, 3:6], pose[:, 6:7]
    across = 2.0 * np.cross(axis, np.array(BLOCK_CENTER))
    arm = np.array(BLOCK_CENTER) + scalar * across + np.cross(axis, across)
    center: Floats = velocity[:, :3] + np.cross(velocity[:, 3:], arm)
    return center
