"""Both engines keep the laws of `neuromech.testing.worlds`."""

from dataclasses import replace

import numpy as np
import pytest

from neuromech.bodies.factory import open_body
from neuromech.bodies.pybullet import PyBulletBody
from neuromech.graph.model import Motion
from neuromech.spec.world import Ground, Slope, Step
from neuromech.testing import worlds as laws
from neuromech.testing.bodies import run
from neuromech.testing.body_models import block, block_on, chains
from neuromech.units import Quantity


def opener(engine):
    return lambda model, step: open_body(replace(model, engine=engine), step)


BULLET, MUJOCO = opener("pybullet"), opener("mujoco")
ENGINES = pytest.mark.parametrize("open_engine", [BULLET, MUJOCO], ids=["pybullet", "mujoco"])


def rough_ground():
    slope = Slope(start=Quantity(-1.0), length=Quantity(1.2), angle=Quantity(-0.2), friction=Quantity(0.3))
    step = {"start": Quantity(0.25), "length": Quantity(0.3), "width": Quantity(2.0), "height": Quantity(0.02)}
    return Ground(slopes=(slope,), steps={"block": Step.model_validate(step)})


@ENGINES
@pytest.mark.parametrize("angle", [0.2, -0.6])
def test_below_the_angle_of_friction_it_stays(open_engine, angle):
    laws.slope_holds_below_its_angle_of_friction(open_engine, 1e-3, angle, bound=1e-3)


@pytest.mark.parametrize(("angle", "friction"), [(0.21, 0.1), (-0.5, 0.3), (0.7, 0.2)])
def test_above_the_angle_of_friction_it_slides(angle, friction):
    laws.slope_lets_slide_above_its_angle_of_friction(BULLET, 1e-3, angle, friction, bound=1e-4)
    # What slides in MuJoCo hops a little, see docs/engines.md.
    laws.slope_lets_slide_above_its_angle_of_friction(MUJOCO, 1e-3, angle, friction, bound=1e-2)


@ENGINES
def test_step_bears_at_its_height(open_engine):
    laws.step_bears_at_its_height(open_engine, 1e-3, bound=1e-4)


def test_feet_on_one_side_of_a_step_roll_the_body():
    laws.feet_on_one_side_of_a_step_roll_the_body(BULLET, 1e-3, bound=1e-3)
    laws.feet_on_one_side_of_a_step_roll_the_body(MUJOCO, 1e-3, bound=5e-3)


@ENGINES
def test_slopes_join_without_a_gap(open_engine):
    laws.slopes_join_without_a_gap(open_engine, 1e-3)


def test_rough_ground_gives_the_same_bits_on_both_paths_to_bullet():
    model = block_on(rough_ground(), -0.5, 0.01, 1.0, -0.2)
    with PyBulletBody(model, 1e-3, "native") as one, PyBulletBody(model, 1e-3, "python") as other:
        first, second = run(one, 800), run(other, 800)
    assert first[:, one.layout.contact_forces].any()
    assert np.array_equal(first, second)


def test_engines_agree_on_rough_ground():
    model = block_on(rough_ground(), -0.5, 0.0, 0.3, -0.2)
    with BULLET(model, 5e-4) as one, MUJOCO(model, 5e-4) as other:
        first, second = run(one, 3000), run(other, 3000)
    places = slice(one.layout.root_pose.start, one.layout.root_pose.start + 3)
    assert abs(first[-1, places.start] - first[0, places.start]) > 0.1, "it does not move"
    assert np.abs(first[:, places] - second[:, places]).max() < 1e-2


@ENGINES
def test_first_motion_is_that_of_the_model(open_engine):
    falling = replace(block(5.0), motion=Motion(root=(0.3, -0.2, 0.7)))
    planar = replace(chains("planar"), motion=Motion({"fore.1": 0.8, "hind.2": 0.1}, (0.3, 0.0, 0.7)))
    with open_engine(falling, 1e-3) as one, open_engine(planar, 1e-3) as other:
        first, second = run(one, 100), run(other, 0)
        other.reset([joint.initial_angle for joint in planar.joints.values()])
        third = run(other, 0)
    assert first[0, one.layout.root_velocity].tolist() == pytest.approx([0.3, -0.2, 0.7, 0.0, 0.0, 0.0], abs=1e-15)
    assert first[-1, one.layout.root_pose.start] - first[0, one.layout.root_pose.start] == pytest.approx(0.03, rel=1e-9)
    assert second[0, other.layout.velocities].tolist() == [0.0, 0.8, 0.0, 0.0, 0.0, 0.1]
    assert second[0, other.layout.root_velocity].tolist() == [0.3, 0.0, 0.7, 0.0, 0.0, 0.0]
    assert third[0, other.layout.root_velocity].tolist() == [0.3, 0.0, 0.7, 0.0, 0.0, 0.0]
    assert not third[0, other.layout.velocities].any()
