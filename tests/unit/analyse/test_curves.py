"""Correlation with curves of which the signals are known functions."""

import numpy as np
import pytest

from neuromech.analyse.measures import MeasuredValue, measure
from neuromech.errors import MeasureError
from neuromech.spec.measure import Measure

PERIOD, DUTY = 0.5, 0.6
PHASES = np.arange(0.0, 100.0, 2.0)
FOOT = {"kind": "curve_correlation", "feet": ["L.foot"], "level": "1 N"}


def take(recording, **spec):
    return measure(recording, Measure.model_validate(FOOT | spec))


def curve(*functions, phases=PHASES, **more):
    values = [list(function(phases / 100.0)) for function in functions]
    columns = [f"joint{index}" for index in range(len(functions))]
    return {"columns": columns, "phases": list(phases), "values": values} | more


def hump(phase):
    return np.sin(2 * np.pi * phase) + 0.3 * np.cos(4 * np.pi * phase)


@pytest.fixture
def walk(record, time):
    cycle = time / PERIOD
    return record(
        {
            "L.foot.force_z": (np.where(cycle % 1.0 < DUTY, 20.0, 0.0), "N"),
            "L.hip.angle": (0.2 + 3.0 * hump(cycle % 1.0), "rad"),
            "L.knee.angle": (np.cos(2 * np.pi * cycle), "rad"),
            "L.ankle.angle": (0.0 * time, "rad"),
        }
    )


def test_correlation_of_a_scaled_and_shifted_copy_is_one(walk):
    found = take(walk, signals=["L.hip.angle"], curve=curve(hump))
    assert found == MeasuredValue(pytest.approx(1.0, abs=1e-4), "")
    assert take(walk, signals=["L.hip.angle"], curve=curve(lambda p: -hump(p))).value == pytest.approx(-1.0, abs=1e-4)


def test_the_least_of_several_joints_counts(walk):
    # Two sines at right angles do not correlate; a phase of 60° between them gives cos 60°.
    curves = curve(hump, lambda p: np.cos(2 * np.pi * p + np.pi / 3.0))
    found = take(walk, signals=["L.hip.angle", "L.knee.angle"], curve=curves)
    assert found.value == pytest.approx(0.5, abs=6e-3)  # a touchdown is known to a sample


def test_a_curve_that_begins_at_liftoff(walk):
    shifted = curve(lambda p: hump((p + DUTY) % 1.0), begins_at="liftoff")
    assert take(walk, signals=["L.hip.angle"], curve=shifted).value == pytest.approx(1.0, abs=1e-4)


def test_only_the_last_whole_cycle_counts(record, time):
    cycle = time / PERIOD
    late = cycle >= 7.5
    signals = {
        "L.foot.force_z": (np.where(cycle % 1.0 < DUTY, 20.0, 0.0), "N"),
        "L.hip.angle": (np.where(late, hump(cycle % 1.0), -hump(cycle % 1.0)), "rad"),
    }
    assert take(record(signals), signals=["L.hip.angle"], curve=curve(hump), until="4.7 s").value > 0.999
    assert take(record(signals), signals=["L.hip.angle"], curve=curve(hump), until="3.7 s").value < -0.999


def test_a_joint_that_does_not_move_has_no_correlation(walk):
    assert "no correlation" in take(walk, signals=["L.ankle.angle"], curve=curve(hump)).value


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"columns": ["a", "b"]}, r"a column for each signal \(got 2 for 1\)"),
        ({"values": []}, "needs either a 'file', or 'phases' and"),
        ({"phases": [0.0, 50.0]}, "at least 3 phases, and a value for each"),
        ({"phases": list(np.linspace(0.0, 200.0, 50))}, "between 0 and 100 percent"),
    ],
)
def test_curves_that_are_none(walk, change, message):
    with pytest.raises(MeasureError, match=message):
        take(walk, signals=["L.hip.angle"], curve=curve(hump) | change)
