"""Weights on strings are seen while they swing, where they were recorded, and at no other time."""

import json

import numpy as np
import pytest

from neuromech.pipeline import run
from neuromech.report.replay import Motion, recorded_body
from neuromech.report.scene import Picture, Scene
from neuromech.report.shot import shoot
from neuromech.report.solids import WEIGHT
from neuromech.report.weights import recorded_swings

BODY = {
    "neuromech": 1,
    "name": "block",
    "body": {
        "engine": "mujoco",
        "root": {"kind": "free", "position": ["0 m", "0 m", "60 mm"]},
        "segments": {
            "block": {
                "mass": "3 kg",
                "inertia": ["10 g m^2"] * 3,
                "shape": {"kind": "box", "size": ["200 mm", "100 mm", "100 mm"]},
            }
        },
        "contacts": {
            f"foot_{x}_{y}": {"segment": "block", "position": [f"{x} mm", f"{y} mm", "-50 mm"], "radius": "10 mm"}
            for x in (-90, 90)
            for y in (-40, 40)
        },
    },
    "world": {
        "ground": {},
        "pendulums": {
            "blow": {
                "segment": "block",
                "mass": "0.2 kg",
                "side": "front",
                "target": ["100 mm", "0 mm", "0 mm"],
                "release": "0.1 s",
            }
        },
    },
    "protocol": {"duration": "0.8 s"},
    "record": {"all": {"signals": ["block.*", "blow.*"], "every": "2 ms"}},
}


@pytest.fixture(scope="module")
def recording(tmp_path_factory):
    file = tmp_path_factory.mktemp("weights") / "block.yaml"
    file.write_text(json.dumps(BODY), encoding="utf-8")
    return run(file)


def test_a_swing_is_from_its_release_until_it_is_taken_away(recording):
    (swing,) = recorded_swings(recorded_body(recording), recording)
    touched = recording.signal("blow.force_x")
    hit = touched[0][np.flatnonzero(touched[1])[0]]
    assert swing.begin == 0.1
    assert swing.end == pytest.approx(hit + 0.1, abs=6e-3)
    times = np.array([0.05, 0.101, 0.3, hit, swing.end + 0.01])
    places, swings = swing.at(times)
    assert swings.tolist() == [False, True, True, True, False]
    assert np.linalg.norm(places[1:4] - swing.pivot, axis=1) == pytest.approx(0.5, abs=1e-4)


def test_what_was_not_recorded_is_not_drawn(recording, tmp_path):
    file = tmp_path / "block.yaml"
    record = {"all": {"signals": ["block.*", "blow.x", "blow.y"], "every": "2 ms"}}
    file.write_text(json.dumps(BODY | {"record": record}), encoding="utf-8")
    assert recorded_swings(recorded_body(recording), run(file, duration=0.2)) == []


def test_a_weight_is_seen_while_it_swings_only(recording):
    motion = Motion(recorded_body(recording), recording)
    (swing,) = recorded_swings(motion.body, recording)
    shot = shoot(motion, "side", np.array([0.02, swing.end - 0.11, swing.end + 0.05]))
    with Scene(shot, Picture(320, 200)) as scene:
        seen = [_bluish(scene.image(number)) for number in range(3)]
    assert seen[0] == 0
    assert seen[1] > 30
    assert seen[2] == 0


def _bluish(image):
    red, green, blue = np.moveaxis(image.astype(float), -1, 0)
    wanted = WEIGHT[0] / WEIGHT[2]
    return int(np.count_nonzero((np.abs(red / np.maximum(blue, 1.0) - wanted) < 0.1) & (green > red)))
