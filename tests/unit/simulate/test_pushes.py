"""Pushes: their impulse, their torque, their signals and their random series, in both engines and on every path."""

import numpy as np
import pytest

from neuromech.compiler.lower import lower
from neuromech.errors import DocumentError
from neuromech.pipeline import build_graph, load_document, run
from neuromech.simulate.pushes import drawn_pushes

FREE = """
body:
  engine: {engine}
  root: {{kind: {root}, position: [0 m, 0 m, 1 m]}}
  segments:
    trunk: {{mass: 3 kg, center_of_mass: [20 mm, 0 mm, 10 mm], inertia: [10 g m^2, 20 g m^2, 25 g m^2]}}
    leg: {{mass: 1 kg, center_of_mass: [0 m, 0 m, -0.1 m], inertia: [4 g m^2, 4 g m^2, 1 g m^2]}}
  joints:
    hip: {{parent: trunk, child: leg, position: [50 mm, 0 m, 0 m], axis: [0, 1, 0], initial_angle: 30 deg}}
world: {{gravity: 0 m/s^2}}
protocol:
  duration: {duration}
  {pushes}
record:
  all: {{signals: [trunk.*, leg.*, hip.*, {signals}], every: 1 ms}}
"""
ENGINES = pytest.mark.parametrize("engine", ["pybullet", "mujoco"])
KICK = "pushes: {kick: {segment: %s, force: %s, start: 10.3 ms, duration: 20.5 ms%s}}"
SERIES = """push_series:
    gusts:
      segment: trunk
      height: {uniform: [-0.1 m, 0.1 m]}
      force: 20 N
      deviation: 4 N
      growing_over: 10
      angle: {normal: [0 deg, 90 deg]}
      heading: {uniform: [0 deg, 360 deg]}
      duration: {gamma: [4, 10 ms]}
      interval: {f: [8, 12, 80 ms]}
      start: 0.2 s
"""


def free(engine, pushes, root="free", duration="50 ms", signals="kick.*"):
    return FREE.format(engine=engine, pushes=pushes, root=root, duration=duration, signals=signals)


def momentum(recording):
    """Momentum of both segments along x, y and z at the end, from positions of the centres of mass."""
    total = np.zeros(3)
    for name, mass, center in (("trunk", 3.0, (0.02, 0.0, 0.01)), ("leg", 1.0, (0.0, 0.0, -0.1))):
        places = [_place(recording, name, np.array(center), row) for row in (-2, -1)]
        total += mass * (places[1] - places[0]) / 1e-3
    return total


def _place(recording, name, center, row):
    x, y, z, roll, pitch, yaw = (
        recording.signal(f"{name}.{quantity}")[1][row] for quantity in ("x", "y", "z", "roll", "pitch", "yaw")
    )
    cr, sr, cp, sp, cy, sy = (f(angle) for angle in (roll, pitch, yaw) for f in (np.cos, np.sin))
    rotation = np.array(
        [
            [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
            [-sp, cp * sr, cp * cr],
        ]
    )
    return np.array([x, y, z]) + rotation @ center


@ENGINES
@pytest.mark.parametrize("segment", ["trunk", "leg"])
def test_impulse_is_force_times_duration_however_steps_fall(document, engine, segment):
    pushes = KICK % (segment, "[3 N, -2 N, 5 N]", ", point: [10 mm, 20 mm, 0 mm]")
    found = momentum(run(document(free(engine, pushes))))
    assert found == pytest.approx(np.array([3.0, -2.0, 5.0]) * 20.5e-3, rel=2e-3, abs=1e-6)


@ENGINES
def test_a_push_at_the_centre_of_mass_of_a_single_body_does_not_turn_it_and_beside_it_does(document, engine):
    alone = """
    body:
      engine: {engine}
      root: {{kind: free}}
      segments:
        ball: {{mass: 2 kg, center_of_mass: [20 mm, 0 mm, 10 mm], inertia: [10 g m^2, 10 g m^2, 10 g m^2]}}
    world: {{gravity: 0 m/s^2}}
    protocol:
      duration: 31 ms
      pushes: {{kick: {{segment: ball, force: [0 N, 4 N, 0 N], start: 0 ms, duration: 20 ms{point}}}}}
    record: {{all: {{signals: [ball.*, kick.*], every: 1 ms}}}}
    """
    through, beside = (
        run(document("\n".join(line[4:] for line in alone.format(engine=engine, point=point).splitlines())))
        for point in ("", ", point: [120 mm, 0 mm, 10 mm]")
    )
    assert through.signal("ball.velocity_y")[1][-1] == pytest.approx(4.0 * 0.02 / 2.0, rel=1e-9)
    assert abs(through.signal("ball.yaw")[1][-1]) < 1e-12
    # L = r F t / I; the push is constant, so the angle after it grows by this rate.
    yaw = beside.signal("ball.yaw")[1]
    assert (yaw[-1] - yaw[-6]) / 5e-3 == pytest.approx(0.1 * 4.0 * 0.02 / 0.01, rel=1e-4)


@ENGINES
def test_the_force_is_recorded_as_its_mean_over_each_step(document, engine):
    recording = run(document(free(engine, KICK % ("trunk", "[3 N, -2 N, 5 N]", ""))))
    time, force = recording.signal("kick.force_y")
    assert force[np.isclose(time, 0.009)] == 0.0
    assert force[np.isclose(time, 0.010)] == pytest.approx(-2.0 * 0.7)
    assert force[np.isclose(time, 0.020)] == pytest.approx(-2.0)
    assert force[np.isclose(time, 0.030)] == pytest.approx(-2.0 * 0.8)
    assert force.sum() * 1e-3 == pytest.approx(-2.0 * 20.5e-3)


def test_engines_agree_on_pushes(document):
    files = [document(free(engine, SERIES, "planar", "1200 ms", "gusts.*")) for engine in ("pybullet", "mujoco")]
    one, other = map(run, files)
    assert np.ptp(one.signal("hip.angle")[1]) > 0.1
    for name in ("trunk.x", "trunk.z", "trunk.pitch", "hip.angle", "gusts.force_x"):
        assert one.signal(name)[1] == pytest.approx(other.signal(name)[1], abs=1e-3)


@ENGINES
def test_compiled_loop_and_python_loop_push_alike(document, engine, monkeypatch):
    file = document(free(engine, SERIES, "free", "600 ms", "gusts.*"))
    compiled = run(file)
    body = {"pybullet": "pybullet.PyBulletBody", "mujoco": "mujoco.MujocoBody"}[engine]
    monkeypatch.setattr(f"neuromech.bodies.{body}.native", lambda self: None)
    methods = run(file)
    for name in ("trunk.x", "trunk.yaw", "hip.angle", "gusts.force_z"):
        assert np.array_equal(compiled.signal(name)[1], methods.signal(name)[1])


def test_bullet_is_pushed_alike_through_python(document, monkeypatch):
    file = document(free("pybullet", SERIES, "free", "600 ms", "gusts.*"))
    native = run(file)
    monkeypatch.setattr("neuromech.bodies.pybullet.usual_path", lambda: "python")
    python = run(file)
    assert python.provenance.engine.endswith("(python)")
    assert np.array_equal(native.signal("trunk.roll")[1], python.signal("trunk.roll")[1])


def drawn(document, seed, duration=60.0):
    program = lower(build_graph(load_document(document(free("pybullet", SERIES, duration="1 s", signals="gusts.*")))))
    return drawn_pushes(program, program.graph.body, seed, duration).numbers


def test_a_series_follows_its_seed_and_a_shorter_run_has_its_first_pushes(document):
    one, again, other, short = drawn(document, 1), drawn(document, 1), drawn(document, 2), drawn(document, 1, 5.0)
    assert np.array_equal(one, again)
    assert not np.array_equal(one[:5], other[:5])
    assert np.array_equal(short, one[: len(short)])
    assert 3 < len(short) < len(one)


def test_a_series_has_the_distributions_of_the_document(document):
    numbers = np.concatenate([drawn(document, seed, 200.0)[9:] for seed in range(10)])
    start, end, force, height = numbers[:, 0], numbers[:, 1], np.linalg.norm(numbers[:, 2:5], axis=1), numbers[:, 7]
    assert len(numbers) > 5000
    gaps = (start[1:] - end[:-1])[start[1:] > end[:-1]]
    # Means of gamma and F distributions; the tolerances are four standard errors.
    assert np.mean(end - start) == pytest.approx(4 * 10e-3, rel=4 * 0.5 / np.sqrt(len(start)))
    assert np.mean(gaps) == pytest.approx(80e-3 * 12 / 10, rel=4 * 0.95 / np.sqrt(len(gaps)))
    assert np.mean(force) == pytest.approx(20.0, rel=4 * 0.2 / np.sqrt(len(force)))
    assert np.std(force) == pytest.approx(4.0, rel=0.05)
    assert np.abs(height).max() <= 0.1
    assert np.std(height) == pytest.approx(0.2 / np.sqrt(12), rel=0.03)


def test_a_series_grows_until_it_has_its_mean(document):
    first = np.array([np.linalg.norm(drawn(document, seed, 20.0)[:10, 2:5], axis=1) for seed in range(60)])
    assert first.mean(axis=0) == pytest.approx(2.0 * np.arange(1, 11), rel=0.12)


@pytest.mark.parametrize(
    ("pushes", "words"),
    [
        (KICK % ("tail", "[1 N, 0 N, 0 N]", ""), "must name a segment"),
        (KICK % ("trunk", "[1 N, 0 N]", ""), "must have 3 entries"),
        ((KICK % ("trunk", "[1 N, 0 N, 0 N]", "")).replace("20.5 ms", "-1 ms"), "must be greater than 0 ms"),
        ((KICK % ("trunk", "[1 N, 0 N, 0 N]", "")).replace("10.3 ms", "1 s"), "must be before 0.05 s"),
        (KICK % ("trunk", "[1 N, 0 N, 0 N]", ", delay: {}"), "needs one distribution"),
        (SERIES.replace("{gamma: [4, 10 ms]}", "{gamma: [4, 10 ms], uniform: [1 ms, 2 ms]}"), "needs one distribution"),
        (SERIES.replace("[-0.1 m, 0.1 m]", "[0.1 m, -0.1 m]"), "lowest value first"),
        (SERIES.replace("80 ms", "80 mm"), "must be a time"),
    ],
)
def test_a_push_that_cannot_be_is_an_error_before_the_run(document, pushes, words):
    signals = "kick.*" if pushes.startswith("pushes") else "gusts.*"
    with pytest.raises(DocumentError, match=words):
        run(document(free("pybullet", pushes, signals=signals)))


def test_the_hinge_engine_refuses_pushes(document):
    with pytest.raises(DocumentError, match="engine 'hinge' knows no pushes"):
        run(document(free("hinge", KICK % ("leg", "[1 N, 0 N, 0 N]", ""), root="fixed")))
