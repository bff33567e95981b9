"""Figures of a cycle beside reference curves, and of vertical forces, show what the measures count."""

import json

import numpy as np
import pytest

from neuromech.report.correlations import correlation_figure
from neuromech.report.layout import NotDrawableError
from neuromech.report.vertical_force import vertical_force_figure
from neuromech.simulate.recording import Outcome

PERIOD, STANCE, MASS = 0.5, 0.3, 4.0
TIME = np.arange(0.0, 8.0, 0.001)
PHASES = list(range(0, 100, 5))


def claim(sign=1.0, signal="L.knee.angle", **more):
    values = [sign * np.sin(2 * np.pi * phase / 100) for phase in PHASES]
    curve = {"columns": ["knee"], "phases": PHASES, "values": [values]}
    measured = {"kind": "curve_correlation", "signals": [signal], "feet": ["L.foot"], "curve": curve}
    return {"measure": measured, "expected": {"at_least": 0.8}, "claim": "x", "source": "y", **more}


@pytest.fixture
def stepping(record):
    """Make the recording of a foot that carries `load` for 0.3 s of each 0.5 s, and of a knee that turns with it."""

    def make(claims=None, load=60.0, mass=MASS):
        phase = (TIME / PERIOD) % 1.0
        signals = {
            "L.foot.force_z": ("N", np.where(phase < STANCE / PERIOD, load, 0.0)),
            "L.knee.angle": ("rad", 0.2 + 0.5 * np.sin(2 * np.pi * phase)),
        }
        specification = json.dumps({"claims": claims} if claims else {})
        return record(signals, Outcome("finished", 8.0), mass, specification)

    return make


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_signal_is_drawn_beside_its_curve_with_their_correlation(stepping, sign):
    (axes,) = correlation_figure(stepping({"knee": claim(sign)})).axes
    assert axes.get_title(loc="left") == f"L.knee.angle, r = {sign:.2f}"
    measured, expected = (line.get_ydata() for line in axes.lines)
    assert measured == pytest.approx(np.sqrt(2.0) * np.sin(2 * np.pi * np.array(PHASES) / 100), abs=0.05)
    assert expected == pytest.approx(sign * measured, abs=0.05)


def test_what_is_not_recorded_is_not_drawn(stepping):
    claims = {"own": claim(), "other": claim(signal="L.hip.angle")}
    assert len(correlation_figure(stepping(claims)).axes) == 1


def test_what_a_comparison_needs(stepping):
    with pytest.raises(NotDrawableError, match="no claim compares"):
        correlation_figure(stepping())
    with pytest.raises(NotDrawableError, match="no foot makes strides"):
        correlation_figure(stepping({"knee": claim()}, load=0.0))


def test_force_of_a_stance_in_body_weights(stepping):
    (axes,) = vertical_force_figure(stepping()).axes
    line = axes.lines[0].get_ydata()
    assert line.max() == pytest.approx(60.0 / (MASS * 9.81), rel=1e-3)
    assert line[70:95].max() < 0.05
    with pytest.raises(NotDrawableError, match="weight"):
        vertical_force_figure(stepping(mass=0.0))
