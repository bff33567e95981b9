"""What each engine refuses, and the traps of PyBullet that its body must step over."""

from dataclasses import replace
from xml.etree import ElementTree

import numpy as np
import pybullet
import pytest

from neuromech.bodies.base import root_quaternion
from neuromech.bodies.factory import open_body
from neuromech.bodies.hinge import HingeBody
from neuromech.bodies.pybullet import PyBulletBody
from neuromech.bodies.urdf import urdf_text
from neuromech.errors import DocumentError
from neuromech.spec.model import CapsuleShape, Contact, Joint, Root
from neuromech.spec.world import Ground, World
from neuromech.testing.bodies import run
from neuromech.testing.body_models import PENDULUM_INERTIA, block, chains, pendulum, segment, vector
from neuromech.units import Quantity


def clients():
    return sum(pybullet.isConnected(number) for number in range(1024))


def with_joint(body, name, **changes):
    return replace(body, joints=body.joints | {name: body.joints[name].model_copy(update=changes)})


def robot_of(body):
    """Return Bullet's number of the robot, and the client as PyBullet wants it."""
    return {"objectUniqueId": body._motion.world.robot, "physicsClientId": body._motion.client.number}


def messages(error):
    return [problem.message for problem in error.value.problems]


def test_the_document_chooses_the_engine():
    with open_body(pendulum(engine="hinge"), 1e-3) as one, open_body(pendulum(engine="pybullet"), 1e-3) as two:
        assert (type(one), type(two)) == (HingeBody, PyBulletBody)
        assert two.engine.name == "pybullet"
        assert two.engine.version.startswith("3.")


def test_hinge_refuses_everything_that_is_more_than_a_hinge():
    with pytest.raises(DocumentError) as error:
        open_body(replace(block(1.0), engine="hinge"), 1e-3)
    assert messages(error) == [
        "engine 'hinge' moves exactly one hinge between two segments, not 0 joints and 1 segments",
        "engine 'hinge' needs a fixed root, not a free one",
        "engine 'hinge' knows no contacts",
    ]
    with pytest.raises(DocumentError):
        open_body(with_joint(pendulum(engine="hinge"), "hinge", kind="slide"), 1e-3)


def test_hinge_has_the_inertia_of_its_segment_about_its_axis():
    body = with_joint(pendulum(), "hinge", armature=Quantity(0.5))
    with HingeBody(body, 1e-3) as hinge:
        assert hinge.inertia == pytest.approx(PENDULUM_INERTIA + 0.5, rel=1e-14)


def test_hinge_hangs_towards_the_ground_however_its_root_is_turned():
    turned = replace(pendulum(), root=Root(orientation=vector(0.4, 0.3, -0.9)))
    with HingeBody(turned, 1e-3) as hinge, PyBulletBody(turned, 1e-4) as bullet:
        states = run(hinge, 200)
        reference = run(bullet, 2000)[::10]
    assert np.abs(states[-1, 0]) > 0.05
    assert np.abs(states - reference).max() < 1e-3


def test_pybullet_refuses_what_bullet_does_not_know():
    body = with_joint(chains("planar"), "fore.1", armature=Quantity(1e-3))
    toe = Contact(segment="fore2", position=vector(0.0, 0.0, 0.0), radius=Quantity(0.01), stiffness=Quantity(1e4))
    body = replace(body, contacts={"toe": toe}, root=Root(kind="planar", orientation=vector(0.0, 0.0, 0.1)))
    before = clients()
    with pytest.raises(DocumentError) as error:
        PyBulletBody(body, 1e-3, "python")
    assert messages(error) == [
        "joint 'fore.1' has an armature, and PyBullet knows none",
        "contact 'toe' has stiffness only",
        "a planar root moves in the x–z plane, so its roll and yaw must be zero",
    ]
    assert clients() == before


def test_pybullet_refuses_an_impossible_inertia_instead_of_zeroing_it(capfd):
    body = chains("free")
    body.segments["hind1"] = segment(0.1, (1e-4, 1e-4, 3e-4))
    before = clients()
    for path in ("python", "native"):
        with pytest.raises(DocumentError, match="PyBullet refuses the inertia of segment 'hind1'"):
            PyBulletBody(body, 1e-3, path)
    assert clients() == before
    capfd.readouterr()


def test_loading_prints_nothing(capfd):
    for model in (chains("planar"), block(1.0), pendulum()):
        open_body(model, 1e-3).close()
    assert capfd.readouterr() == ("", "")


def test_clients_are_given_back():
    before = clients()
    with PyBulletBody(chains("free"), 1e-3, "python") as body:
        body.reset(np.zeros(6))
        assert clients() == before + 1
    assert clients() == before


def test_nothing_damps_a_joint_or_a_root():
    # Bullet's defaults (motors, damping 0.04) would stop a tenth of this motion within the second.
    with open_body(pendulum(gravity=0.0), 1e-3) as body:
        body.reset([0.0], [3.0])
        assert run(body, 1000)[-1, 1] == pytest.approx(3.0, rel=1e-12)


def test_joints_may_turn_faster_than_bullets_default_limit():
    with open_body(pendulum(gravity=0.0), 1e-4) as body:
        body.reset([0.0], [400.0])
        assert run(body, 100)[-1, 1] == pytest.approx(400.0, rel=1e-12)


def test_engine_applies_no_joint_damping_or_stiffness_of_its_own():
    damped = with_joint(pendulum(1.0), "hinge", damping=Quantity(0.5), stiffness=Quantity(2.0))
    for engine in ("hinge", "pybullet"):
        with (
            open_body(replace(damped, engine=engine), 1e-3) as one,
            open_body(pendulum(1.0, engine=engine), 1e-3) as two,
        ):
            assert np.array_equal(run(one, 100), run(two, 100))


def test_contacts_of_one_segment_are_told_apart():
    with open_body(block(0.06), 1e-3) as body:
        forces = run(body, 1000)[-1, body.layout.contact_forces].reshape(-1, 3)
    assert (forces[:, 2] > 1.0).all()
    with open_body(block(0.06, orientation=(0.0, 0.3, 0.0)), 1e-3) as body:
        # Nose down: the front feet touch, the hind feet do not.
        states = run(body, 60)[:, body.layout.contact_forces].reshape(61, 4, 3)
    touched = np.abs(states).sum(axis=(0, 2)) > 0.0
    assert touched.tolist() == [True, True, False, False]


def test_ground_stands_at_its_height():
    body = block(1.06)
    with open_body(replace(body, world=World(ground=Ground(height=Quantity(1.0)))), 1e-3) as opened:
        states = run(opened, 500)
    assert states[-1, opened.layout.root_pose][2] == pytest.approx(1.06, abs=2e-4)


def test_without_ground_everything_falls():
    with open_body(replace(block(0.06), world=World()), 1e-3) as body:
        states = run(body, 500)
    assert states[-1, body.layout.root_pose][2] < -1.0


def test_friction_is_the_product_of_contact_and_ground():
    sliding = {}
    for friction in (1.0, 0.0):
        world = World(ground=Ground(friction=Quantity(friction)))
        with PyBulletBody(replace(block(0.06), world=world), 1e-3, "python") as opened:
            run(opened, 300)
            pybullet.resetBaseVelocity(linearVelocity=[0.5, 0.0, 0.0], **robot_of(opened))
            sliding[friction] = run(opened, 300)[-1, opened.layout.root_velocity][0]
    assert sliding[1.0] == pytest.approx(0.0, abs=1e-6)
    assert sliding[0.0] == pytest.approx(0.5, abs=1e-6)


def test_segments_do_not_collide_with_each_other():
    body = chains("fixed")
    for name in ("fore2", "hind2"):
        spheres = {f"{name}.ball": Contact(segment=name, position=vector(0.0, 0.0, 0.0), radius=Quantity(0.5))}
        body.contacts.update(spheres)
    with open_body(body, 1e-3) as with_spheres, open_body(chains("fixed"), 1e-3) as without:
        torque = np.linspace(-0.01, 0.01, 6)
        assert np.array_equal(run(with_spheres, 50, torque)[:, :12], run(without, 50, torque)[:, :12])


def test_root_quaternion_is_yaw_after_pitch_after_roll():
    root = Root(orientation=vector(0.3, -0.7, 2.0))
    assert root_quaternion(root) == pytest.approx(pybullet.getQuaternionFromEuler((0.3, -0.7, 2.0)), abs=1e-12)


def test_free_root_reports_its_frame_not_its_centre_of_mass():
    with PyBulletBody(block(5.0, orientation=(0.1, 0.2, 0.3)), 1e-4, "python") as body:
        pybullet.resetBaseVelocity(linearVelocity=[0.0, 0.0, 0.0], angularVelocity=[1.0, 2.0, 3.0], **robot_of(body))
        states = run(body, 20)
    pose, velocity = states[:, body.layout.root_pose], states[:, body.layout.root_velocity]
    assert pose[0, :3] == pytest.approx([0.3, -0.2, 5.0], abs=1e-12)
    rate = (pose[11, :3] - pose[9, :3]) / 2e-4
    assert np.abs(velocity[10, :2]).max() > 0.01
    assert rate == pytest.approx(velocity[10, :3], abs=2e-3)


def test_urdf_draws_a_capsule_from_end_to_end():
    body = pendulum()
    shape = CapsuleShape(start=vector(0.0, 0.0, 0.0), end=vector(0.3, 0.0, 0.0), radius=Quantity(0.02))
    body.segments["rod"] = body.segments["rod"].model_copy(update={"shape": shape})
    visual = ElementTree.fromstring(urdf_text(body)).find("link[@name='rod']/visual")
    assert [float(x) for x in visual.find("origin").get("rpy").split()] == pytest.approx([0.0, np.pi / 2, 0.0])
    assert visual.find("origin").get("xyz") == "0.15 0.0 0.0"
    assert visual.find("geometry/capsule").attrib == {"radius": "0.02", "length": "0.3"}


def test_names_of_modules_pass_through_urdf():
    body = pendulum()
    joint = Joint(parent="base", child="LF.rod+1", position=vector(0, 0, 0), axis=vector(0, 1, 0))
    named = replace(
        body, segments={"base": body.segments["base"], "LF.rod+1": body.segments["rod"]}, joints={"LF.hip-2": joint}
    )
    with open_body(named, 1e-3) as opened:
        assert opened.joints == ("LF.hip-2",)
        assert run(opened, 1).shape == (2, 15)
