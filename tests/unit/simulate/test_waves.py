"""Wavy ground that is drawn from the run's seed, and ground that gets steadily steeper."""

from math import radians, tan

import numpy as np
import pytest

from neuromech.errors import DocumentError
from neuromech.graph.terrain import terrain
from neuromech.pipeline import run
from neuromech.simulate.ground import drawn_ground
from neuromech.spec.world import Ground

WAVES = {
    "start": "1 m",
    "number": 40,
    "angle": "5 deg",
    "growing_over": 20,
    "length": {"normal": ["1 m", "0.2 m"]},
    "space": {"normal": ["0.5 m", "0.2 m"]},
}
SLIDER = """
body:
  engine: {engine}
  root: {{kind: planar, position: [0 m, 0 m, {height}]}}
  segments: {{block: {{mass: 2 kg, inertia: [10 g m^2, 20 g m^2, 25 g m^2]}}}}
  contacts:
    fore: {{segment: block, position: [100 mm, 0 mm, -50 mm], radius: 10 mm, friction: 0}}
    hind: {{segment: block, position: [-100 mm, 0 mm, -50 mm], radius: 10 mm, friction: 0}}
world: {{ground: {ground}}}
protocol: {{duration: 2 s, initial: {{block.velocity_x: 1.5 m/s}}, fall: {{height: 30 mm}}}}
record: {{all: {{signals: [block.*, fore.*, hind.*], every: 1 ms}}}}
"""
WAVY = (
    "{waves: {start: 0.3 m, number: 8, angle: 4 deg, length: {uniform: [0.2 m, 0.4 m]}, "
    "space: {uniform: [0.1 m, 0.2 m]}}}"
)


def drawn(seed, **changes):
    ground = drawn_ground(Ground.model_validate({"waves": WAVES | changes}), seed)
    assert ground is not None
    return ground


def test_waves_follow_the_seed():
    assert drawn(3) == drawn(3)
    assert drawn(3) != drawn(4)


def test_each_wave_ends_as_high_as_it_began_and_they_get_steeper():
    ground = drawn(1)
    heights = [z for _, z in terrain(ground).corners]
    assert heights[0] == heights[-1] == pytest.approx(0.0, abs=1e-12)
    assert min(heights) > -1e-9
    up = [float(slope.angle) for slope in ground.slopes[::2]]
    down = [float(slope.angle) for slope in ground.slopes[1::2]]
    assert down == [-angle for angle in up]
    assert np.degrees(up) == pytest.approx([*np.arange(1, 21) / 4.0, *[5.0] * 20])


def test_lengths_and_spaces_have_the_distributions_of_the_document():
    lengths, spaces = [], []
    for seed in range(50):
        starts = np.array([float(slope.start) for slope in drawn(seed).slopes])
        ends = starts + [float(slope.length) for slope in drawn(seed).slopes]
        lengths += (ends[1::2] - starts[::2]).tolist()
        spaces += (starts[::2] - [1.0, *ends[1:-1:2]]).tolist()
    assert len(lengths) == 2000
    assert np.mean(lengths) == pytest.approx(1.0, abs=4 * 0.2 / np.sqrt(2000))
    assert np.std(lengths) == pytest.approx(0.2, rel=0.1)
    # Drawn again where it is not positive, which happens once in 160 times.
    assert np.mean(spaces) == pytest.approx(0.5, abs=4 * 0.2 / np.sqrt(2000) + 0.005)
    assert min(spaces) > 0.0


def test_waves_end_with_the_ground():
    ground = drawn_ground(Ground.model_validate({"waves": WAVES, "x": ["-1 m", "10 m"]}), 2)
    assert ground is not None
    assert 0 < len(ground.slopes) < 20
    assert float(ground.slopes[-1].start) + float(ground.slopes[-1].length) <= 10.0


def test_an_incline_gets_steadily_steeper_without_gaps():
    incline = {"start": "2 m", "length": "10 m", "angle": "8 deg", "pieces": 20}
    surface = terrain(Ground.model_validate({"incline": incline}))
    middles = 2.25 + 0.5 * np.arange(20)
    slopes = [(surface.height(x + 0.01, 0.0) - surface.height(x - 0.01, 0.0)) / 0.02 for x in middles]
    assert slopes == pytest.approx([tan(radians(0.4 * k)) for k in range(1, 21)], rel=1e-9)
    assert surface.height(1.9, 0.0) == 0.0
    assert surface.height(20.0, 0.0) == surface.height(12.0, 0.0)


@pytest.mark.parametrize(
    "ground", [WAVY, "{incline: {start: 0.3 m, length: 1 m, angle: 8 deg}}"], ids=["waves", "incline"]
)
def test_feet_follow_the_ground_in_both_engines_and_a_fall_is_judged_above_it(document, ground):
    for engine in ("pybullet", "mujoco"):
        file = document(SLIDER.format(engine=engine, height="60 mm", ground=ground))
        recording = run(file, seed=5)
        assert recording.outcome.kind == "finished"
        spec = Ground.model_validate({"waves": {"start": "0.3 m", "number": 8, "angle": "4 deg", **_random()}})
        if "incline" in ground:
            spec = Ground.model_validate({"incline": {"start": "0.3 m", "length": "1 m", "angle": "8 deg"}})
        surface = terrain(drawn_ground(spec, 5) or spec)
        x, z = recording.signal("fore.x")[1], recording.signal("fore.z")[1]
        gap = z - 0.01 - [surface.height(float(at), 0.0) for at in x]
        assert np.ptp(x) > 1.0
        assert gap.min() > -0.008, "the foot sinks in"
        assert np.median(gap) < 5e-3, "the foot is off the ground"


def _random():
    return {"length": {"uniform": ["0.2 m", "0.4 m"]}, "space": {"uniform": ["0.1 m", "0.2 m"]}}


@pytest.mark.parametrize(
    ("ground", "words"),
    [
        (WAVY.replace("[0.2 m, 0.4 m]", "[-0.2 m, 0.4 m]"), "must be positive"),
        (WAVY.replace("{uniform: [0.2 m, 0.4 m]}", "{normal: [-1 m, 0.4 m]}"), "must have a positive mean"),
        (WAVY.replace("{uniform: [0.2 m, 0.4 m]}", "{}"), "needs one distribution"),
        (WAVY.replace("{waves", "{slopes: [{start: 0 m, length: 1 m, angle: 1 deg}], waves"), "stands beside 'slopes'"),
        (WAVY.replace("0.3 m", "3 km"), "is outside the ground"),
        ("{incline: {start: 999.5 m, length: 1 m, angle: 8 deg}}", "is outside the ground"),
        (
            WAVY.replace("{waves", "{steps: {a: {start: 0 m, length: 1 m, width: 1 m, height: 1 mm}}, waves"),
            "reaches over the beginning of 'waves'",
        ),
    ],
)
def test_ground_that_cannot_be_is_an_error_before_the_run(document, ground, words):
    with pytest.raises(DocumentError, match=words):
        run(document(SLIDER.format(engine="pybullet", height="100 mm", ground=ground)))
