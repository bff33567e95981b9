"""Both engines keep the laws of `neuromech.testing.bodies`, each to its own bound."""

from dataclasses import replace

import pytest

from neuromech.bodies.factory import open_body
from neuromech.testing import bodies as laws
from neuromech.testing.body_models import block, chains, pendulum


def opener(engine):
    return lambda model, step: open_body(replace(model, engine=engine), step)


ENGINES = pytest.mark.parametrize("open_engine", [opener("hinge"), opener("pybullet")], ids=["hinge", "pybullet"])
HINGE, BULLET = opener("hinge"), opener("pybullet")


@pytest.mark.parametrize("angle", [0.1, 1.5, 2.8])
def test_hinge_period_is_the_elliptic_integral(angle):
    laws.pendulum_keeps_its_period(HINGE, step=1e-3, bound=5e-10, angle=angle)


@pytest.mark.parametrize("angle", [0.1, 1.5, 2.8])
def test_pybullet_period_is_the_elliptic_integral(angle):
    laws.pendulum_keeps_its_period(BULLET, step=1e-3, bound=4e-6, angle=angle)


def test_hinge_keeps_energy_to_rounding():
    laws.pendulum_keeps_its_energy(HINGE, step=1e-3, bound=1e-12)


def test_pybullet_keeps_energy():
    laws.pendulum_keeps_its_energy(BULLET, step=1e-3, bound=5e-3)


def test_hinge_is_exact_without_gravity():
    laws.torque_turns_the_hinge(HINGE, step=1e-3, bound=1e-12)


def test_pybullet_is_first_order_in_the_step():
    laws.torque_turns_the_hinge(BULLET, step=1e-3, bound=2.1e-3)
    laws.torque_turns_the_hinge(BULLET, step=1e-4, bound=2.1e-4)


def test_hinge_stops_at_its_range():
    laws.range_holds_the_hinge(HINGE, step=1e-3, bound=1e-15)


def test_pybullet_stops_at_its_range():
    laws.range_holds_the_hinge(BULLET, step=1e-3, bound=6e-3)


@ENGINES
def test_reset_starts_anew(open_engine):
    laws.reset_starts_anew(open_engine, step=1e-3)


@ENGINES
def test_runs_repeat(open_engine):
    laws.runs_repeat_bit_for_bit(open_engine, pendulum(0.5), step=1e-3)


@pytest.mark.parametrize(
    "model", [chains("free", 9.81), block(0.08, orientation=(0.2, 0.3, 0.0))], ids=["chains", "block"]
)
def test_moving_roots_repeat(model):
    laws.runs_repeat_bit_for_bit(BULLET, model, step=1e-3)


@ENGINES
def test_bodies_do_not_disturb_each_other(open_engine):
    laws.bodies_do_not_disturb_each_other(open_engine, step=1e-3)


@ENGINES
def test_closed_body_refuses(open_engine):
    laws.closed_body_refuses(open_engine, step=1e-3)


def test_free_fall():
    laws.block_falls_freely(BULLET, step=1e-3, bound=1.0e-3)


def test_ground_carries_the_weight():
    laws.ground_carries_the_weight(BULLET, step=1e-3, bound=1e-4)


def test_soft_contacts_carry_the_weight():
    laws.ground_carries_the_weight(BULLET, 1e-3, 1e-3, block(0.06, stiffness=2e4, damping=200.0))


@pytest.mark.parametrize("friction", [0.0, 1.0])
def test_contact_forces_change_momentum(friction):
    laws.contact_forces_change_momentum(BULLET, step=1e-3, bound=1e-12, friction=friction)


def test_planar_root_stays_planar():
    laws.planar_root_stays_planar(BULLET, step=1e-3)


@pytest.mark.parametrize("root", ["fixed", "planar", "free"])
def test_torque_accelerates_by_the_mass_matrix(root):
    laws.torque_accelerates_by_the_mass_matrix(BULLET, root, bound=1e-9)
