"""Figures of walkers: disturbances as they were drawn, lever arms as the equations say."""

from math import cos, pi, radians

import numpy as np
import pytest

from neuromech.components.paths import ConstantArm, CosineArm, GeometricArm
from neuromech.report.joints import joint_angles
from neuromech.report.layout import NotDrawableError
from neuromech.report.lever_arms import lever_arm, lever_arm_figure
from neuromech.report.pushes import of_time, of_value, push_series_figure
from neuromech.report.terrain import terrain_figure
from neuromech.spec.pushes import RandomAngle, RandomTime

ANGLES = {"radius": "50 mm", "reference_angle": "165 deg", "zero_angle": "180 deg"}
SLOPE = """
body:
  root: {kind: planar}
  segments: {block: {mass: 1 kg, inertia: [1 kg m^2, 1 kg m^2, 1 kg m^2]}}
world: {ground: {slopes: [{start: 1 m, length: 2 m, angle: 9 deg}]}}
"""
SERIES = """
protocol:
  push_series:
    gusts:
      segment: trunk
      height: {uniform: [0 m, 0.8 m]}
      force: 80 N
      deviation: 16 N
      growing_over: 20
      angle: {normal: [0 deg, 90 deg]}
      duration: {gamma: [6.25, 40 ms]}
      interval: {f: [10, 10, 0.8 s]}
"""
SHANK = """
neuromech: 1
name: shank
body:
  engine: hinge
  segments:
    thigh: {mass: 1 kg, inertia: [1 g m^2, 1 g m^2, 1 g m^2]}
    shank: {mass: 3 kg, inertia: [50 g m^2, 50 g m^2, 6 g m^2]}
  joints:
    knee:
      parent: thigh
      child: shank
      position: [0 m, 0 m, -0.5 m]
      axis: [0, -1, 0]
      soft_limit: {range: [-100 deg, -5 deg], stiffness: 17 N m/rad, reference_velocity: 1 deg/s}
muscles:
  VAS:
    kind: muscle_tendon_unit
    motoneuron: Mn
    maximal_force: 6000 N
    optimal_length: 80 mm
    tendon_slack_length: 230 mm
    maximal_velocity: 12 1/s
    path:
      kind: lever_arms
      reference_length: 310 mm
      arms:
        knee: {kind: cosine, radius: 60 mm, angle_of_maximum: 165 deg, reference_angle: 125 deg, zero_angle: 180 deg}
network: {neurons: {Mn: {kind: static_neuron}}}
"""


def test_what_a_sensor_sees_as_an_angle_is_no_joint(record):
    document = "sensors: {lean: {}}\ninstances: {left: {sensors: {over: {}}}}"
    signals = {name: ("rad", np.zeros(9)) for name in ("lean.angle", "left.over.angle", "left.knee.angle")}
    assert joint_angles(record(signals, specification=document)) == {"left": ["left.knee.angle"]}


def test_slope_is_shown_where_it_lies_and_as_steep_as_it_is(record):
    recording = record({"block.x": ("m", np.linspace(0.0, 4.0, 100))}, specification=SLOPE)
    slope = terrain_figure(recording).axes[1].lines[0]
    percent = np.interp([0.5, 2.0, 3.5], slope.get_xdata(), slope.get_ydata())
    assert percent == pytest.approx([0.0, 100.0 * np.tan(radians(9.0)), 0.0], abs=1e-6)


def test_level_ground_is_not_drawn(record):
    level = SLOPE.partition("world:")[0] + "world: {ground: {}}"
    with pytest.raises(NotDrawableError, match="level"):
        terrain_figure(record({"block.x": ("m", np.zeros(10))}, specification=level))


def test_densities_of_pushes_are_those_of_the_document(record):
    assert of_time(RandomTime(gamma=("6.25", "40 ms"))).mean() == pytest.approx(0.25)
    assert of_time(RandomTime(f=("10", "10", "0.8 s"))).mean() == pytest.approx(0.8 * 10 / 8)
    assert of_value(RandomAngle(normal=("0 deg", "90 deg"))).std() == pytest.approx(pi / 2)
    figure = push_series_figure(record({"gusts.force_x": ("N", np.ones(9))}, specification=SERIES))
    assert [axes.get_xlabel() for axes in figure.axes] == [
        "time (s)", "duration (s)", "time between (s)", "angle (deg)", "height (m)",
    ]  # fmt: skip
    assert figure.axes[0].get_title(loc="left") == "mean force grows to 80 ± 16 N in 20 pushes"


def test_cosine_and_geometric_arm_have_one_maximum_at_one_angle_and_differ_elsewhere():
    """Equations 2.19 and 2.20; the second of a straight line over two equal segments never changes its sign."""
    cosine = CosineArm(kind="cosine", angle_of_maximum="140 deg", **ANGLES)
    exact = GeometricArm(kind="geometric", angle_of_maximum="140 deg", **ANGLES)
    for form in ("cosine", "geometric"):
        assert lever_arm(form, cosine, radians(-40.0)) == pytest.approx(0.05)
    bent = radians(-130.0)
    assert lever_arm("cosine", cosine, bent) == pytest.approx(0.05 * cos(radians(90.0)), abs=1e-12)
    assert lever_arm("geometric", exact, bent) > 0.02
    assert lever_arm("constant", ConstantArm(kind="constant", **ANGLES), bent) == 0.05


def test_lever_arms_are_drawn_over_the_range_of_the_joint_in_both_forms(record):
    (axes,) = lever_arm_figure(record({"knee.angle": ("rad", np.zeros(9))}, specification=SHANK)).axes
    own, other = (line for line in axes.lines if len(line.get_xdata()) > 2)
    assert (own.get_xdata()[0], own.get_xdata()[-1]) == pytest.approx((-100.0, -5.0))
    assert (own.get_ydata().max(), other.get_ydata().max()) == pytest.approx((60.0, 60.0), rel=1e-3)
    assert own.get_ydata()[0] == pytest.approx(60.0 * cos(radians(80.0 - 165.0)))
