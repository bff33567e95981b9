"""MuJoCo keeps the laws of `neuromech.testing.bodies`, and both engines those of landing and friction."""

from dataclasses import replace

import pytest

from neuromech.bodies.factory import open_body
from neuromech.testing import bodies as laws
from neuromech.testing.body_models import block, chains, pendulum


def opener(engine):
    return lambda model, step: open_body(replace(model, engine=engine), step)


MUJOCO, BULLET = opener("mujoco"), opener("pybullet")


@pytest.mark.parametrize("angle", [0.1, 1.5, 2.8])
def test_period_is_the_elliptic_integral(angle):
    laws.pendulum_keeps_its_period(MUJOCO, step=1e-3, bound=4e-6, angle=angle)


def test_energy_is_kept():
    laws.pendulum_keeps_its_energy(MUJOCO, step=1e-3, bound=5e-3)


def test_it_is_first_order_in_the_step():
    laws.torque_turns_the_hinge(MUJOCO, step=1e-3, bound=2.1e-3)
    laws.torque_turns_the_hinge(MUJOCO, step=1e-4, bound=2.1e-4)


def test_range_holds():
    laws.range_holds_the_hinge(MUJOCO, step=1e-3, bound=6e-3)


def test_reset_starts_anew():
    laws.reset_starts_anew(MUJOCO, step=1e-3)


@pytest.mark.parametrize(
    "model",
    [pendulum(0.5), chains("free", 9.81), block(0.08, orientation=(0.2, 0.3, 0.0))],
    ids=["pendulum", "chains", "block"],
)
def test_runs_repeat(model):
    laws.runs_repeat_bit_for_bit(MUJOCO, model, step=1e-3)


def test_bodies_do_not_disturb_each_other():
    laws.bodies_do_not_disturb_each_other(MUJOCO, step=1e-3)


def test_closed_body_refuses():
    laws.closed_body_refuses(MUJOCO, step=1e-3)


def test_free_fall():
    laws.block_falls_freely(MUJOCO, step=1e-3, bound=1.0e-3)


def test_ground_carries_the_weight():
    laws.ground_carries_the_weight(MUJOCO, step=1e-3, bound=2e-4)


def test_soft_contacts_carry_the_weight():
    laws.ground_carries_the_weight(MUJOCO, 1e-3, 1e-3, block(0.06, stiffness=2e4, damping=200.0))


@pytest.mark.parametrize("friction", [0.0, 1.0])
def test_contact_forces_change_momentum(friction):
    # The centre of mass turns about the root's origin while MuJoCo steps: first order, where Bullet is exact.
    laws.contact_forces_change_momentum(MUJOCO, step=1e-3, bound=2e-3, friction=friction)
    laws.contact_forces_change_momentum(MUJOCO, step=1e-4, bound=2.2e-4, friction=friction)


def test_planar_root_stays_planar():
    laws.planar_root_stays_planar(MUJOCO, step=1e-3)


@pytest.mark.parametrize("root", ["fixed", "planar", "free"])
def test_torque_accelerates_by_the_mass_matrix(root):
    laws.torque_accelerates_by_the_mass_matrix(MUJOCO, root, bound=1e-9)


def test_bullet_lands_without_rebound():
    laws.landing_has_no_rebound(BULLET, step=1e-3, bound=1e-9)


def test_mujoco_lands_with_the_rebound_of_its_soft_contact():
    # A fiftieth of the energy: MuJoCo pushes a penetration of 6 mm out again.
    laws.landing_has_no_rebound(MUJOCO, step=1e-3, bound=0.14)


@pytest.mark.parametrize("friction", [0.4, 1.6])
def test_friction_in_bullet(friction):
    laws.friction_is_that_of_an_incline(BULLET, step=1e-3, friction=friction, bound=1e-3, creep=1e-6)


@pytest.mark.parametrize("friction", [0.4, 1.6])
def test_friction_in_mujoco(friction):
    # What slides hops in MuJoCo, so that its forces come in pulses; their means are those of the law.
    laws.friction_is_that_of_an_incline(MUJOCO, step=1e-3, friction=friction, bound=0.05, creep=1e-4)
