"""Moment arms are what they are defined to be, r = −dl/dq, for every kind of path and joint."""

import numpy as np
import pytest

from neuromech.compiler.lower import lower
from neuromech.pipeline import build_graph, load_document

# Three joints between four segments, the middle one a slide, and oblique axes. The first muscle runs over all three
# with a via point on each segment between, the second turns back and forth between two neighbours, the third crosses
# the last two joints with constant arms.
CHAIN = """\
network:
  neurons: {pool: {kind: rate_neuron, time_constant: 10 ms}}
body:
  root: {position: [0.1 m, -0.2 m, 1 m], orientation: [10 deg, 20 deg, 30 deg]}
  segments:
    trunk: &part {mass: 1 kg, inertia: [2 g m^2, 2 g m^2, 2 g m^2]}
    thigh: *part
    sleeve: *part
    foot: *part
  joints:
    hip: {parent: trunk, child: thigh, position: [0.1 m, 0.05 m, 0 m], axis: [0.2, 1, -0.3]}
    stretch: {kind: slide, parent: thigh, child: sleeve, position: [0 m, 0.01 m, -0.1 m], axis: [0.1, 0.3, -1]}
    ankle: {parent: sleeve, child: foot, position: [0 m, 0 m, -0.1 m], axis: [1, 0.4, 0.2]}
muscles:
  long:
    kind: brown_muscle
    motoneuron: pool
    flexor: pool
    extensor: pool
    maximal_force: 50 N
    optimal_length: 300 mm
    standing_length: 300 mm
    passive_stiffness_in_flexion: 0
    passive_stiffness_in_extension: 0
    path:
      kind: straight_lines
      points:
        - {segment: trunk, position: [40 mm, 70 mm, 30 mm]}
        - {segment: thigh, position: [30 mm, 20 mm, -40 mm]}
        - {segment: thigh, position: [35 mm, 10 mm, -60 mm]}
        - {segment: sleeve, position: [20 mm, 0 mm, -50 mm]}
        - {segment: foot, position: [30 mm, -20 mm, -30 mm]}
  over_two:
    kind: brown_muscle
    motoneuron: pool
    flexor: pool
    extensor: pool
    maximal_force: 50 N
    optimal_length: 300 mm
    standing_length: 300 mm
    passive_stiffness_in_flexion: 0
    passive_stiffness_in_extension: 0
    path:
      kind: straight_lines
      points:
        - {segment: trunk, position: [-40 mm, 50 mm, 20 mm]}
        - {segment: sleeve, position: [-30 mm, 0 mm, -20 mm]}
  constant:
    kind: brown_muscle
    motoneuron: pool
    flexor: pool
    extensor: pool
    maximal_force: 50 N
    optimal_length: 100 mm
    standing_length: 100 mm
    passive_stiffness_in_flexion: 0.1
    passive_stiffness_in_extension: 0.1
    passive_scale: 0.5
    path:
      kind: constant_moment_arms
      reference_length: 100 mm
      reference_angles: {hip: 10 deg, ankle: -20 deg}
      moment_arms: {hip: -7 mm, ankle: 12.5 mm}
solver: {coupling: explicit}
protocol: {duration: 1 s}
record: {all: {signals: ["*"], every: 1 ms}}
"""


class Bench:
    """The chain put into poses; lengths, velocities and arms as the compiled mechanics give them."""

    def __init__(self, program):
        self.program, self.memory = program, program.memory()
        self.header, self.places = program.header, program.layout.signals
        self.samples = np.empty(len(program.layout.states) + len(self.memory.s) + len(self.memory.u))
        self.memory.s[self.header["body"] + 6 : self.header["body"] + 13] = (0.1, -0.2, 1.0, 0.0, 0.0, 0.0, 1.0)

    def at(self, angles, velocities=(0.0, 0.0, 0.0)):
        body, memory = self.header["body"], self.memory
        memory.s[body : body + 6] = (*angles, *velocities)
        self.program.module.tick(0, 1e-3, *memory.buffers, self.samples, memory.T, memory.D)
        return memory.s

    def length(self, muscle, angles):
        return self.at(angles)[self.places[f"{muscle}.length"]]

    def arms(self, muscle, angles):
        """Arm at each joint; (3,)."""
        self.at(angles)
        index, offsets = sorted(["long", "over_two", "constant"]).index(muscle), self.memory.I
        first, last = offsets[self.header["path_first"] + index :][:2]
        found = np.zeros(3)
        joints = offsets[self.header["path_joint"] :][first:last]
        found[joints] = self.memory.F[self.header["arms"] :][first:last]
        return found


@pytest.fixture(scope="module")
def bench(tmp_path_factory):
    file = tmp_path_factory.mktemp("chain") / "chain.yaml"
    file.write_text("neuromech: 1\nname: chain\n" + CHAIN, encoding="utf-8")
    return Bench(lower(build_graph(load_document(file))))


@pytest.mark.parametrize("seed", range(20))
@pytest.mark.parametrize("muscle", ["long", "over_two"])
def test_arms_of_straight_lines_are_the_slope_of_the_length(bench, muscle, seed):
    pose = np.random.default_rng(seed).uniform((-1.0, -0.05, -1.0), (1.0, 0.05, 1.0))
    arms, h = bench.arms(muscle, pose), 1e-6
    slope = [(bench.length(muscle, pose + d) - bench.length(muscle, pose - d)) / (2 * h) for d in h * np.eye(3)]
    assert arms == pytest.approx(-np.array(slope), abs=1e-8)
    assert np.count_nonzero(arms) == (3 if muscle == "long" else 2)


@pytest.mark.parametrize("muscle", ["long", "over_two", "constant"])
def test_velocity_is_the_change_of_the_length(bench, muscle):
    pose, speed, h = np.array([0.3, 0.02, -0.6]), np.array([2.0, 0.4, -3.0]), 1e-6
    slope = (bench.length(muscle, pose + h * speed) - bench.length(muscle, pose - h * speed)) / (2 * h)
    assert bench.at(pose, speed)[bench.places[f"{muscle}.velocity"]] == pytest.approx(slope, abs=1e-8)


def test_length_of_straight_lines_is_the_sum_of_distances(bench):
    """At angle zero all frames have the axes of the root, so that positions just add up."""
    hip, stretch, ankle = (100, 50, 0), (100, 60, -100), (100, 60, -200)
    origins = np.array([(0, 0, 0), hip, hip, stretch, ankle])
    points = origins + np.array([(40, 70, 30), (30, 20, -40), (35, 10, -60), (20, 0, -50), (30, -20, -30)])
    expected = np.linalg.norm(np.diff(points, axis=0), axis=1).sum() / 1e3
    assert bench.length("long", np.zeros(3)) == pytest.approx(expected, rel=1e-12)


def test_constant_arms_are_exact(bench):
    pose = np.array([0.7, 0.03, -0.4])
    assert bench.arms("constant", pose).tolist() == [-7e-3, 0.0, 12.5e-3]
    expected = 0.1 + 7e-3 * (0.7 - np.radians(10)) - 12.5e-3 * (-0.4 + np.radians(20))
    assert bench.length("constant", pose) == pytest.approx(expected, rel=1e-12)


def test_a_pull_turns_a_joint_the_way_of_its_arm(bench):
    pose = np.array([0.2, 0.0, 0.3])
    s = bench.at(pose)
    forces = {muscle: s[bench.places[f"{muscle}.force"]] for muscle in ("long", "over_two", "constant")}
    torque = s[bench.header["torque"] :][:3].copy()
    assert min(forces.values()) > 0.0
    assert torque == pytest.approx(sum(forces[muscle] * bench.arms(muscle, pose) for muscle in forces), rel=1e-9)
