"""The MuJoCo body beyond the laws: its model is the document's, it refuses what it cannot do, and it fails aloud."""

import logging
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import mujoco
import numba
import numpy as np
import pytest

from neuromech.bodies import mujoco_native
from neuromech.bodies.factory import open_body
from neuromech.bodies.mjcf import mjcf_text
from neuromech.bodies.mujoco import MujocoBody
from neuromech.bodies.pybullet import PyBulletBody
from neuromech.errors import DocumentError, MissingExtraError, RunError
from neuromech.pipeline import build_graph, load_document
from neuromech.spec.model import BoxShape, CapsuleShape, Contact, Root
from neuromech.spec.world import Ground, World
from neuromech.testing.bodies import run
from neuromech.testing.body_models import block, chains, pendulum, segment, vector
from neuromech.units import Quantity

SPECS = Path(__file__).parents[3] / "specs"


@numba.njit
def compiled_run(engine, torques, states):
    for k in range(torques.shape[0]):
        mujoco_native.read(engine, states[k])
        if mujoco_native.step(engine, torques[k]) != 0:
            return k
    return -1


def cat():
    return build_graph(load_document(SPECS / "cat" / "suspended.yaml", ["body.engine=mujoco"])).body


def cat_on_its_feet():
    body = cat()
    return replace(body, root=Root(kind="free", position=vector(0.0, 0.0, 0.24), orientation=vector(0.02, 0.0, 0.3)))


def with_contact(body, **changes):
    return replace(body, contacts={n: c.model_copy(update=changes) for n, c in body.contacts.items()})


def messages(error):
    return [problem.message for problem in error.value.problems]


@pytest.mark.parametrize(
    "model",
    [cat, cat_on_its_feet, lambda: block(0.06), lambda: block(0.12, root="planar", orientation=(0.0, 0.5, 0.0))],
    ids=["suspended cat", "cat on its feet", "block", "planar block"],
)
def test_compiled_and_python_path_give_the_same_bits(model):
    with MujocoBody(model(), 1e-3, "native") as one, MujocoBody(model(), 1e-3, "python") as two:
        assert two.native() is None
        torques = np.random.default_rng(1).normal(0.0, 0.05, (500, len(one.joints)))
        states = np.zeros((2, 500, one.layout.size))
        assert compiled_run(one.native(), torques, states[0]) == -1
        for torque, state in zip(torques, states[1], strict=True):
            two.read(state)
            two.step(torque)
        assert np.array_equal(states[0], states[1])
        assert np.ptp(states[0], axis=0).max() > 1e-3


def test_feet_of_the_cat_touch_the_ground():
    with MujocoBody(cat_on_its_feet(), 1e-3) as body:
        forces = run(body, 200)[:, body.layout.contact_forces].reshape(201, -1, 3)
    assert forces.any(axis=(0, 2)).all()


def test_model_has_the_masses_inertias_and_armatures_of_the_document():
    body = chains("free")
    joint = body.joints["fore.1"].model_copy(update={"armature": Quantity(2e-3)})
    body = replace(body, joints=body.joints | {"fore.1": joint})
    with MujocoBody(body, 1e-3) as opened:
        model = opened._model
        for name, part in body.segments.items():
            assert model.body(name).inertia.tolist() == [float(x) for x in part.inertia]
            assert model.body(name).mass == part.mass
        assert model.dof_armature.sum() == model.joint("fore.1").armature[0] == 2e-3
        assert not model.dof_damping.any()
        assert not model.jnt_stiffness.any()
        assert not model.dof_frictionloss.any()


def test_soft_contact_is_the_spring_of_the_document():
    # Pressed by a known weight, a spring of 2e4 N/m gives way by weight / stiffness.
    with MujocoBody(block(0.06, stiffness=2e4, damping=200.0), 1e-4) as body:
        last = run(body, 10_000)[-1]
    sunk = 0.06 - last[body.layout.root_pose][2]
    force = last[body.layout.contact_forces].reshape(4, 3)[:, 2]
    assert sunk == pytest.approx(force.sum() / 4 / 2e4, rel=1e-2)


def test_soft_landing_is_that_of_bullet():
    model = block(0.08, stiffness=2e4, damping=200.0)
    heights = []
    for engine in (MujocoBody, PyBulletBody):
        with engine(model, 1e-4) as body:
            heights.append(run(body, 2500)[:, body.layout.root_pose][:, 2])
    assert heights[1].min() < 0.0595
    assert np.abs(heights[0] - heights[1]).max() < 1e-4


def test_friction_is_the_product_of_contact_and_ground():
    speeds = {}
    for friction in (1.0, 0.0):
        world = World(ground=Ground(friction=Quantity(friction)))
        with MujocoBody(replace(block(0.06), world=world), 1e-3) as body:
            run(body, 300)
            body._data.qvel[0] = 0.5
            speeds[friction] = run(body, 300)[-1, body.layout.root_velocity][0]
    assert speeds[1.0] == pytest.approx(0.0, abs=1e-5)
    assert speeds[0.0] == pytest.approx(0.5, abs=1e-9)


def test_segments_do_not_collide_with_each_other():
    body = chains("fixed")
    for name in ("fore2", "hind2"):
        ball = Contact(segment=name, position=vector(0.0, 0.0, 0.0), radius=Quantity(0.5))
        body.contacts[name] = ball
    with MujocoBody(body, 1e-3) as with_balls, MujocoBody(chains("fixed"), 1e-3) as without:
        torque = np.linspace(-0.01, 0.01, 6)
        assert np.array_equal(run(with_balls, 50, torque)[:, :12], run(without, 50, torque)[:, :12])


def test_free_root_reports_velocities_in_the_world():
    with MujocoBody(block(5.0, orientation=(0.4, 0.2, 1.3)), 1e-4) as body, PyBulletBody(block(5.0), 1e-4) as bullet:
        body._data.qvel[3:6] = (1.0, 2.0, 3.0)
        states = run(body, 20)
        assert states.shape == run(bullet, 20).shape
    pose, velocity = states[:, body.layout.root_pose], states[:, body.layout.root_velocity]
    assert (pose[11, :3] - pose[9, :3]) / 2e-4 == pytest.approx(velocity[10, :3], abs=2e-3)
    x, y, z, w = pose[10, 3:]
    rate = (pose[11, 3:] - pose[9, 3:]) / 2e-4
    # ω = 2 q̇ q*, vector part.
    turned = 2.0 * (w * rate[:3] - rate[3] * np.array([x, y, z]) + np.cross([x, y, z], rate[:3]))
    assert turned == pytest.approx(velocity[10, 3:], abs=2e-3)


def test_shapes_are_drawn_and_change_nothing():
    body = pendulum(1.0)
    shapes = [
        CapsuleShape(start=vector(0.0, 0.0, 0.0), end=vector(0.3, 0.0, 0.0), radius=Quantity(0.02)),
        BoxShape(size=vector(0.2, 0.1, 0.04), position=vector(0.0, 0.0, -0.1)),
    ]
    with MujocoBody(body, 1e-3) as bare:
        expected = run(bare, 50)
    for shape, wanted in zip(shapes, ({"fromto": "0.0 0.0 0.0 0.3 0.0 0.0"}, {"size": "0.1 0.05 0.02"}), strict=True):
        rod = body.segments["rod"].model_copy(update={"shape": shape})
        drawn = replace(body, segments=body.segments | {"rod": rod})
        geometry = ElementTree.fromstring(mjcf_text(drawn, 1e-3)).find(".//body[@name='rod']/geom")
        assert wanted.items() <= geometry.attrib.items()
        with MujocoBody(drawn, 1e-3) as opened:
            assert np.array_equal(run(opened, 50), expected)


def test_engine_is_named_with_its_version():
    with open_body(pendulum(engine="mujoco"), 1e-3) as body:
        assert str(body.engine) == f"mujoco {mujoco.__version__} (native)"


def test_divergence_is_an_error_and_no_new_start(tmp_path, monkeypatch, caplog):
    monkeypatch.chdir(tmp_path)
    with MujocoBody(pendulum(0.5), 1e-3) as body, caplog.at_level(logging.INFO):
        run(body, 5)
        with pytest.raises(RunError, match=r"MuJoCo failed: Nan, Inf or huge value in QACC"):
            body.step(np.array([np.nan]))
        assert np.isnan(run(body, 0)[0, :2]).any()
        body.reset([0.5])
        assert np.isfinite(run(body, 5)).all()
    assert list(tmp_path.iterdir()) == [], "MuJoCo has written a file"


def test_divergence_stops_the_compiled_path():
    with MujocoBody(pendulum(0.5), 1e-3) as body:
        torques = np.zeros((10, 1))
        torques[6] = np.nan
        assert compiled_run(body.native(), torques, np.zeros((10, body.layout.size))) == 6
        with pytest.raises(RunError, match="MuJoCo failed"):
            body.check()


def test_closed_body_has_no_compiled_path():
    body = MujocoBody(pendulum(), 1e-3)
    body.close()
    for call in (body.native, body.check):
        with pytest.raises(RunError, match="closed"):
            call()


def test_body_without_the_address_of_mj_step_has_the_python_path(monkeypatch):
    monkeypatch.setattr("neuromech.bodies.mujoco.step_address", lambda package: None)
    with MujocoBody(pendulum(1.0), 1e-3) as body:
        assert body.native() is None
        assert body.engine.path == "python"
    with pytest.raises(RunError, match="mj_step cannot be called"):
        MujocoBody(pendulum(), 1e-3, path="native")


def test_missing_package_is_named_with_the_extra(monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "mujoco", None)
    with pytest.raises(MissingExtraError, match=r"mujoco is not installed\. Hint: pip install 'neuromech\[mujoco\]'"):
        open_body(pendulum(engine="mujoco"), 1e-3)


def test_it_refuses_what_it_cannot_move():
    tilted = replace(block(1.0, root="planar"), root=Root(kind="planar", orientation=vector(0.0, 0.0, 0.1)))
    with pytest.raises(DocumentError) as error:
        MujocoBody(with_contact(tilted, stiffness=Quantity(1e4)), 1e-3)
    assert messages(error) == [
        *(f"contact 'foot{number}' has stiffness only" for number in range(4)),
        "a planar root moves in the x–z plane, so its roll and yaw must be zero",
    ]


def test_it_refuses_a_step_for_which_it_would_soften_contacts():
    with pytest.raises(DocumentError, match=r"need a body_step of at most 7\.5 ms, not 8 ms"):
        MujocoBody(block(1.0), 8e-3)
    MujocoBody(block(1.0), 7.5e-3).close()
    MujocoBody(pendulum(), 8e-3).close()


def test_it_refuses_a_contact_that_it_would_change():
    with pytest.raises(DocumentError, match="contact 'foot0' is too stiff or too soft for MuJoCo at this step"):
        MujocoBody(block(1.0, stiffness=1e13, damping=0.0), 1e-3)
    with pytest.raises(DocumentError, match="too stiff or too soft"):
        MujocoBody(block(1.0, stiffness=1e-3, damping=0.0), 1e-3)


def test_it_refuses_an_impossible_inertia():
    body = chains("free")
    body.segments["hind1"] = segment(0.1, (1e-4, 1e-4, 3e-4))
    with pytest.raises(DocumentError, match="MuJoCo cannot load the body"):
        MujocoBody(body, 1e-3)
