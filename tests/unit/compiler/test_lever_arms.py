"""Lever arms of Dzeladini 2013 eq. 2.18 to 2.24: the length is their integral, and the pennation factor scales it."""

from math import acos, cos, degrees, hypot, radians, sin

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from neuromech.compiler.lower import lower
from neuromech.compiler.paths import CONSTANT, COSINE, GEOMETRIC, lever
from neuromech.pipeline import build_graph, load_document

angles = st.floats(0.05, np.pi - 0.05)
forms = st.sampled_from([CONSTANT, COSINE, GEOMETRIC])


@given(forms, angles, angles, angles)
def test_the_arm_is_the_slope_of_its_integral(form, angle, reference, peak):
    h = 1e-5
    arm, way = lever.py_func(form, 0.05, angle, reference, peak)
    ahead, behind = (lever.py_func(form, 0.05, angle + d, reference, peak)[1] for d in (h, -h))
    assert (ahead - behind) / (2.0 * h) == pytest.approx(arm, abs=1e-9)
    assert lever.py_func(form, 0.05, reference, reference, peak)[1] == 0.0
    assert np.sign(way) == np.sign(lever.py_func(form, -0.05, angle, reference, peak)[1]) * -1.0


@given(st.sampled_from([COSINE, GEOMETRIC]), angles, angles)
def test_the_arm_is_the_radius_at_its_maximum_and_smaller_elsewhere(form, angle, peak):
    assert lever.py_func(form, 0.05, peak, 1.0, peak)[0] == pytest.approx(0.05, rel=1e-12)
    assert abs(lever.py_func(form, 0.05, angle, 1.0, peak)[0]) <= 0.05 * (1.0 + 1e-12)


@given(angles, st.floats(0.1, 0.9))
def test_the_geometric_arm_is_that_of_a_straight_line(angle, share):
    """From a point at r_0 on one segment to one at r_0/share on the other: twice the area over the length."""
    radius = 0.05
    x, y = radius * cos(angle) - radius / share, radius * sin(angle)
    arm = radius / share * y / hypot(x, y)
    assert lever.py_func(GEOMETRIC, radius, angle, 1.0, acos(share))[0] == pytest.approx(arm, rel=1e-9)


def test_cosine_and_geometric_arm_of_the_knee_extensor_agree_within_a_fifth_over_the_range_of_walking():
    """Figure 2.2: the two hardly differ where a knee moves in walking, 110° to 175°."""
    peak = radians(165.0)
    for angle in np.radians(np.arange(130.0, 176.0, 5.0)):
        cosine, exact = (lever.py_func(form, 1.0, angle, 1.0, peak)[0] for form in (COSINE, GEOMETRIC))
        assert cosine == pytest.approx(exact, abs=0.2), degrees(angle)


LEG = """\
neuromech: 1
name: leg
network:
  neurons: {pool: {kind: static_neuron}}
parameters:
  radius: {value: 50 mm}
  peak: {value: 140 deg}
body:
  segments:
    thigh: &part {mass: 1 kg, inertia: [2 g m^2, 2 g m^2, 2 g m^2]}
    shank: *part
    foot: *part
  joints:
    knee: {parent: thigh, child: shank, position: [0 m, 0 m, -0.5 m], axis: [0, 1, 0]}
    ankle: {parent: shank, child: foot, position: [0 m, 0 m, -0.5 m], axis: [0, 1, 0]}
muscles:
  GAS:
    kind: muscle_tendon_unit
    motoneuron: pool
    maximal_force: 1500 N
    optimal_length: 50 mm
    tendon_slack_length: 400 mm
    maximal_velocity: 12 1/s
    path:
      kind: lever_arms
      reference_length: 450 mm
      pennation_factor: 0.7
      arms:
        knee:
          kind: cosine
          radius: "${radius}"
          angle_of_maximum: "${peak}"
          reference_angle: 165 deg
          zero_angle: 180 deg
        ankle: {kind: geometric, radius: -50 mm, angle_of_maximum: 110 deg, reference_angle: 80 deg, zero_angle: 90 deg}
solver: {coupling: explicit}
protocol:
  duration: 10 ms
  events: {grows: {at: 5 ms, set: {radius: 60 mm}}}
record: {all: {signals: ["*"], every: 1 ms}}
"""


@pytest.fixture(scope="module")
def leg(tmp_path_factory):
    file = tmp_path_factory.mktemp("leg") / "leg.yaml"
    file.write_text(LEG, encoding="utf-8")
    return lower(build_graph(load_document(file)))


def length(program, knee, ankle):
    """Length as the compiled mechanics give it, and the arms that they leave behind."""
    memory, header = program.memory(), program.header
    body = header["body"]
    memory.s[body : body + 2] = knee, ankle
    memory.s[body + 10] = 1.0  # The root's quaternion.
    program.module.lengths_now(memory.s, memory.p, memory.F, memory.I, memory.T, memory.D)
    return memory.s[program.layout.signals["GAS.length"]], memory.F[header["arms"] :][:2].copy()


def test_length_of_a_path_over_two_joints_is_the_sum_of_its_integrals_times_the_pennation_factor(leg):
    knee, ankle = radians(-20.0), radians(12.0)
    a = cos(radians(110.0))

    def span(angle):
        return (1.0 + a * a - 2.0 * a * cos(angle)) ** 0.5 / a

    over_knee = 0.05 * (sin(radians(160.0 - 140.0)) - sin(radians(165.0 - 140.0)))
    over_ankle = -0.05 * (span(radians(102.0)) - span(radians(80.0)))
    found, arms = length(leg, knee, ankle)
    assert found == pytest.approx(0.45 - 0.7 * (over_knee + over_ankle), rel=1e-12)
    assert arms[0] == pytest.approx(0.05 * cos(radians(20.0)), rel=1e-12)
    assert arms[1] == pytest.approx(-0.05 * sin(radians(102.0)) / (span(radians(102.0)) * a), rel=1e-12)


@pytest.mark.parametrize("seed", range(5))
def test_the_slope_of_the_length_is_minus_the_arm_times_the_pennation_factor(leg, seed):
    pose, h = np.random.default_rng(seed).uniform((-1.2, -0.4), (0.1, 0.5)), 1e-6
    _, arms = length(leg, *pose)
    for joint, step in enumerate(h * np.eye(2)):
        slope = (length(leg, *(pose + step))[0] - length(leg, *(pose - step))[0]) / (2.0 * h)
        assert slope == pytest.approx(-0.7 * arms[joint], abs=1e-8)


def test_a_lever_arm_follows_its_parameter(leg):
    assert leg.layout.bound_to("radius").size == 1
    assert leg.layout.bound_to("peak").size == 1
    assert leg.parameters[leg.layout.bound_to("peak")[0]] == pytest.approx(radians(140.0))
