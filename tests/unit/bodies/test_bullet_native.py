"""Bullet from compiled code gives the bits of the portable path, frees what it opened, and runs in threads."""

import subprocess
import sys
import threading
from dataclasses import replace
from pathlib import Path

import numba
import numpy as np
import pytest

from neuromech.bodies import bullet_c, bullet_native
from neuromech.bodies.pybullet import PyBulletBody, usual_path
from neuromech.errors import DocumentError, RunError
from neuromech.pipeline import build_graph, load_document
from neuromech.spec.model import Contact
from neuromech.spec.world import World
from neuromech.testing.bodies import run
from neuromech.testing.body_models import block, chains, pendulum, vector
from neuromech.units import Quantity


@numba.njit(nogil=True)
def loop(engine, state, torque, steps):
    for _ in range(steps):
        if bullet_native.read(engine, state) or bullet_native.step(engine, torque):
            return 1
    return 0


def with_ground(kind):
    """Two legs that touch the ground, one foot soft."""
    feet = {
        "fore": Contact(segment="fore2", position=vector(0.0, 0.0, -0.1), radius=Quantity(0.02)),
        "hind": Contact(
            segment="hind2",
            position=vector(0.0, 0.0, -0.1),
            radius=Quantity(0.03),
            stiffness=Quantity(2e4),
            damping=Quantity(300.0),
        ),
    }
    return replace(chains(kind), contacts=feet, world=block(1.0).world)


def random_torques(steps, joints):
    return np.random.default_rng(3).normal(0.0, 0.02, (steps, joints))


def states_under(body, torques):
    states = np.zeros((len(torques) + 1, body.layout.size))
    body.read(states[0])
    for torque, row in zip(torques, states[1:], strict=True):
        body.step(torque)
        body.read(row)
    return states


@pytest.mark.parametrize(
    "model",
    [
        pendulum(0.5),
        pendulum(0.1, limits=(-0.3, 0.6)),
        chains("fixed"),
        chains("planar"),
        with_ground("planar"),
        with_ground("free"),
        block(0.3, orientation=(0.1, 0.3, -0.2)),
        replace(block(5.0), world=World(gravity=Quantity(3000.0), ground=block(1.0).world.ground)),
        replace(block(0.3), world=World()),
    ],
    ids=[
        "pendulum",
        "limits",
        "fixed",
        "planar",
        "planar on ground",
        "free on ground",
        "falling block",
        "very fast",
        "no ground",
    ],
)
def test_both_paths_give_the_same_bits(model):
    torques = random_torques(1000, len(model.joints))
    with PyBulletBody(model, 1e-3, "native") as native, PyBulletBody(model, 1e-3, "python") as python:
        first = states_under(native, torques)
        assert np.array_equal(first, states_under(python, torques))
        angles = np.linspace(-0.1, 0.2, len(model.joints))
        for body in (native, python):
            body.reset(angles, 3.0 * angles)
        assert np.array_equal(states_under(native, torques[:50]), states_under(python, torques[:50]))
    assert np.ptp(first, axis=0).max() > 0.1, "nothing moves"
    if model.contacts and model.world.ground:
        assert np.abs(first[:, native.layout.contact_forces]).max() > 0.5, "nothing touches"


def test_both_paths_give_the_same_bits_for_the_suspended_cat():
    file = Path(__file__).parents[3] / "specs" / "cat" / "suspended.yaml"
    model = build_graph(load_document(file)).body
    torques = random_torques(1000, len(model.joints))
    with PyBulletBody(model, 1e-3, "native") as native, PyBulletBody(model, 1e-3, "python") as python:
        states = states_under(native, torques)
        assert np.array_equal(states, states_under(python, torques))
    assert np.ptp(states[:, native.layout.angles], axis=0).min() > 0.1


def test_the_compiled_loop_does_what_the_methods_do():
    model = with_ground("free")
    torque = np.full(6, 0.01)
    with PyBulletBody(model, 1e-3) as compiled, PyBulletBody(model, 1e-3) as called:
        state = np.zeros(compiled.layout.size)
        assert loop(compiled.native(), state, torque, 500) == 0
        assert np.array_equal(state, run(called, 499, torque)[-1])


def test_provenance_names_the_path():
    with PyBulletBody(pendulum(), 1e-3) as one, PyBulletBody(pendulum(), 1e-3, "python") as two:
        assert str(one.engine) == "pybullet 3.2.7 (native)"
        assert str(two.engine) == "pybullet 3.2.7 (python)"
        assert one.native() is not None
        assert two.native() is None


def test_without_bullets_c_functions_the_portable_path_is_taken(monkeypatch):
    monkeypatch.setattr(bullet_c, "_SIGNATURES", {"b3NoSuchFunction": (None,)})
    bullet_c.bullet_library.cache_clear()
    try:
        assert usual_path() == "python"
        with PyBulletBody(pendulum(), 1e-3) as body:
            assert body.native() is None
            assert body.engine.path == "python"
        with pytest.raises(RunError, match="does not offer the C functions"):
            PyBulletBody(pendulum(), 1e-3, "native")
    finally:
        bullet_c.bullet_library.cache_clear()


def test_structures_of_another_version_are_not_trusted(monkeypatch):
    monkeypatch.setattr(bullet_c, "version", lambda name: "3.2.8")
    bullet_c.bullet_library.cache_clear()
    try:
        assert usual_path() == "python"
    finally:
        bullet_c.bullet_library.cache_clear()


def test_a_world_that_does_not_answer_is_a_failed_run():
    with PyBulletBody(pendulum(), 1e-3) as body:
        body.native().world[bullet_native.ROBOT] = 77
        with pytest.raises(RunError, match="does not answer"):
            body.read(np.zeros(body.layout.size))
        with pytest.raises(RunError, match="does not answer"):
            body.check()
        body.reset([0.1])
        assert run(body, 3)[0, 0] == 0.1


def test_a_closed_body_says_so():
    body = PyBulletBody(pendulum(), 1e-3)
    body.close()
    body.close()
    for call in (body.native, body.check, lambda: body.read(np.zeros(15)), lambda: body.step(np.zeros(1))):
        with pytest.raises(RunError, match="closed"):
            call()


def test_a_file_that_bullet_cannot_load_is_a_wrong_document(monkeypatch, capfd):
    monkeypatch.setattr("neuromech.bodies.pybullet_world.urdf_text", lambda body: "no robot")
    for path in ("native", "python"):
        with pytest.raises(DocumentError, match="PyBullet cannot load the body: Cannot load URDF file"):
            PyBulletBody(pendulum(), 1e-3, path)
    capfd.readouterr()


def test_bodies_in_two_threads_do_not_disturb_each_other():
    model = with_ground("free")
    torques = [np.full(6, 0.01), np.full(6, -0.01)]
    with PyBulletBody(model, 1e-3) as one, PyBulletBody(model, 1e-3) as two:
        states = [np.zeros(one.layout.size), np.zeros(one.layout.size)]
        loop(one.native(), states[0], torques[0], 1)
        one.reset(np.zeros(6))
        two.reset(np.zeros(6))
        threads = [
            threading.Thread(target=loop, args=(body.native(), state, torque, 2000))
            for body, state, torque in zip((one, two), states, torques, strict=True)
        ]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
    for state, torque in zip(states, torques, strict=True):
        with PyBulletBody(model, 1e-3) as alone:
            alone.reset(np.zeros(6))
            expected = np.zeros(alone.layout.size)
            loop(alone.native(), expected, torque, 2000)
        assert np.array_equal(state, expected)


@pytest.mark.skipif(not Path("/proc/self/statm").exists(), reason="needs the memory of the process")
def test_two_hundred_bodies_leave_no_world_behind():
    def megabytes():
        return int(Path("/proc/self/statm").read_text().split()[1]) * 4096 / 1e6

    def open_and_close():
        with PyBulletBody(block(0.06), 1e-3, "native") as body:
            run(body, 2)

    for _ in range(20):
        open_and_close()
    before = megabytes()
    for _ in range(200):
        open_and_close()
    # One world is 17 MB.
    assert megabytes() - before < 4.0


def test_nobody_greets_on_stderr_and_engines_are_imported_when_needed():
    code = """
import sys
import neuromech.simulate.run
assert not [name for name in sys.modules if name.split(".")[0] in ("pybullet", "mujoco")]
import os
import neuromech.bodies.pybullet_import
os.write(2, b"what else is said\\n")
assert "pybullet" in sys.modules
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "what else is said\n")
