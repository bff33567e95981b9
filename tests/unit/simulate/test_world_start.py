"""How a body starts, drawn from the run's seed, and when it counts as fallen on ground that is not level."""

import numpy as np
import pytest

from neuromech.errors import DocumentError
from neuromech.pipeline import run

WALKER = """
body:
  engine: {engine}
  root: {{kind: free, position: [0 m, 0 m, 0.3 m]}}
  segments:
    trunk: {{mass: 3 kg, inertia: [10 g m^2, 10 g m^2, 10 g m^2]}}
    left: {{mass: 0.3 kg, center_of_mass: [0 m, 0 m, -0.1 m], inertia: [1 g m^2, 1 g m^2, 1 g m^2]}}
    right: {{mass: 0.3 kg, center_of_mass: [0 m, 0 m, -0.1 m], inertia: [1 g m^2, 1 g m^2, 1 g m^2]}}
  joints:
    L.hip: {{parent: trunk, child: left, position: [0 m, 50 mm, 0 m], axis: [0, 1, 0]}}
    R.hip: {{parent: trunk, child: right, position: [0 m, -50 mm, 0 m], axis: [0, 1, 0]}}
  contacts:
    left_foot: {{segment: left, position: [0 m, 0 m, -0.2 m], radius: 10 mm}}
    right_foot: {{segment: right, position: [0 m, 0 m, -0.2 m], radius: 10 mm}}
network:
  neurons: {{cell: {{kind: rate_neuron, time_constant: 10 ms}}}}
world: {world}
protocol:
  duration: {duration}
  initial: {initial}
  fall: {fall}
record:
  all: {{signals: [trunk.*, "*.angle", "*.velocity", "*_foot.z"], every: 1 ms}}
"""
RANDOM = (
    "{trunk.clearance: {uniform: [1 mm, 9 mm]}, trunk.roll: {uniform: [-5 deg, 5 deg]}, trunk.yaw: 90 deg, "
    "trunk.velocity_x: {uniform: [0.1 m/s, 0.3 m/s]}, '*.hip.angle': {uniform: [-20 deg, 20 deg]}, "
    "L.hip.velocity: 100 deg/s, cell.rate: {uniform: [0, 1]}}"
)


def walker(engine="pybullet", world="{ground: {}}", duration="1 ms", initial="{}", fall="null"):
    names = {"L.hip": "left_hip", "R.hip": "right_hip"}
    text = WALKER.format(engine=engine, world=world, duration=duration, initial=initial, fall=fall)
    for dotted, name in names.items():
        text = text.replace(dotted, name)
    return text.replace("*.hip", "*_hip")


def first(recording, name):
    return float(recording.signal(name)[1][0])


@pytest.mark.parametrize("world", ["{ground: {}}", "{ground: {slopes: [{start: -1 m, length: 3 m, angle: 9 deg}]}}"])
def test_a_random_start_is_the_same_in_both_engines_and_another_with_another_seed(document, world):
    files = [document(walker(engine, world, initial=RANDOM)) for engine in ("pybullet", "mujoco")]
    bullet, again, mujoco, other = (run(files[k], seed=seed) for k, seed in ((0, 3), (0, 3), (1, 3), (0, 4)))
    for name in ("trunk.z", "trunk.roll", "trunk.velocity_x", "left_hip.angle", "right_hip.angle", "left_hip.velocity"):
        assert first(bullet, name) == first(again, name)
        assert first(bullet, name) == pytest.approx(first(mujoco, name), rel=1e-12, abs=1e-15)
        assert (first(bullet, name) != first(other, name)) == (name != "left_hip.velocity")
    assert first(bullet, "left_hip.angle") != first(bullet, "right_hip.angle")
    assert first(bullet, "left_hip.velocity") == pytest.approx(np.radians(100.0))
    assert first(bullet, "trunk.yaw") == pytest.approx(np.radians(90.0))


def test_clearance_puts_the_lowest_foot_so_high(document):
    recording = run(document(walker(initial="{trunk.clearance: 4 mm, right_hip.angle: 30 deg}")))
    assert first(recording, "left_foot.z") == pytest.approx(0.014, abs=1e-12)
    assert first(recording, "right_foot.z") > 0.03


def test_a_value_counts_by_itself_wherever_it_stands(document):
    one, other = (
        run(document(walker(initial=initial)))
        for initial in (
            "{trunk.roll: {uniform: [-5 deg, 5 deg]}}",
            "{trunk.pitch: {uniform: [-5 deg, 5 deg]}, 'trunk.r*': {uniform: [-5 deg, 5 deg]}}",
        )
    )
    assert first(one, "trunk.roll") == pytest.approx(first(other, "trunk.roll"), rel=1e-12)


def test_a_fall_is_judged_above_the_ground_below(document):
    world = "{ground: {slopes: [{start: -3 m, length: 6 m, angle: -10 deg}], steps: {}}}"
    drop = document(walker(world=world, initial="{trunk.x: 2.5 m, trunk.clearance: 0 mm}", fall="{height: 0.1 m}"))
    assert run(drop, duration=0.02).outcome.kind == "finished", "0.97 m lower than where the slope begins"
    high = walker(world=world, initial="{trunk.x: -2.9 m, trunk.clearance: 0 mm}", fall="{height: 0.25 m}")
    for engine in ("pybullet", "mujoco"):
        outcome = run(document(high.replace("engine: pybullet", f"engine: {engine}")), duration=0.02).outcome
        assert (outcome.kind, outcome.time) == ("fell", 0.0)
        assert outcome.message == "the root is 0.210 m high, below 0.25 m"


@pytest.mark.parametrize(
    ("initial", "words"),
    [
        ("{trunk.z: {uniform: [0.15 m, 0.25 m]}}", "starts 60 mm below the ground at an extreme of the random start"),
        ("{trunk.z: 0.2 m}", "starts 10 mm below the ground"),
        ("{trunk.clearance: -3 mm}", "starts 3 mm below the ground"),
        ("{trunk.clearance: 0 mm, trunk.z: 0.3 m}", "stands beside the height of 'trunk'"),
        ("{trunk.velocity_q: 1 m/s}", "matches no state"),
        ("{trunk.z: 3 deg}", "must be a value in units like m"),
    ],
)
def test_a_start_that_cannot_be_is_an_error_before_the_run(document, initial, words):
    with pytest.raises(DocumentError, match=words) as error:
        run(document(walker(initial=initial)))
    assert error.value.problems[0].mark.line > 0


def test_a_drawn_start_in_a_step_is_an_error_too(document):
    # The extremes of x are beside the step, what lies between is in it.
    world = "{ground: {steps: {block: {start: -0.2 m, length: 0.4 m, width: 1 m, height: 50 mm}}}}"
    initial = "{trunk.x: {uniform: [-1 m, 1 m]}, trunk.z: 0.22 m}"
    file = document(walker(world=world, initial=initial))
    outcomes = set()
    for seed in range(12):
        try:
            outcomes.add(run(file, seed=seed).outcome.kind)
        except DocumentError as error:
            assert f"below the ground with seed {seed}" in str(error)
            outcomes.add("refused")
    assert outcomes == {"finished", "refused"}
