"""Averages, levels and differences of signals whose answers are known."""

import numpy as np
import pytest

from neuromech.analyse.levels import rms_difference_of_runs
from neuromech.analyse.measures import MeasuredValue, measure
from neuromech.analyse.windows import NotMeasurableError, View
from neuromech.errors import MeasureError
from neuromech.spec.measure import Measure


def take(recording, **spec):
    return measure(recording, Measure.model_validate(spec))


@pytest.mark.parametrize(
    ("kind", "value"),
    [("mean", 2.0), ("minimum", 0.0), ("maximum", 4.0), ("range", 4.0), ("final", 4.0)],
)
def test_values_of_a_ramp(record, time, kind, value):
    found = take(record({"M.force": (time - 1.0, "N")}), kind=kind, signal="M.force", after="1 s")
    assert found == MeasuredValue(pytest.approx(value, abs=1e-12), "N")


def test_rms_and_standard_deviation_of_a_shifted_sine(record, time):
    recording = record({"trunk.roll": (0.3 + 0.2 * np.sin(2 * np.pi * time), "rad")})
    spec = {"signal": "trunk.roll", "until": "4.9995 s"}
    assert take(recording, kind="rms", **spec) == MeasuredValue(pytest.approx(np.sqrt(0.09 + 0.02)), "rad")
    assert take(recording, kind="standard_deviation", **spec).value == pytest.approx(0.2 / np.sqrt(2.0))


def test_the_mean_weighs_by_time_and_not_by_samples(record):
    time = np.concatenate((np.arange(0.0, 1.0, 0.001), [2.0]))
    found = take(record({"M.force": (np.minimum(time, 1.0), "N")}, time=time), kind="mean", signal="M.force")
    exact = (0.999**2 / 2 + (0.999 + 1.0) / 2 * 1.001) / 2.0
    assert found.value == pytest.approx(exact, abs=1e-9)


def test_silence_is_the_largest_of_all(record, time):
    recording = record({"A.activity": 0.001 * time, "B.activity": 0.002 * time, "M.force": (time, "N")})
    assert take(recording, kind="silence", signals=["*.activity"]) == MeasuredValue(pytest.approx(0.01), "")
    with pytest.raises(MeasureError, match="signals of one unit"):
        take(recording, kind="silence", signals=["*"])
    with pytest.raises(MeasureError, match=r"no recorded signal matches '\*.angle'"):
        take(recording, kind="silence", signals=["*.angle"])


def test_held_or_released(record, time):
    recording = record({"E.activity": np.where(time < 4.0, 0.3, 0.1)})
    assert take(recording, kind="held", signal="E.activity", level=0.2).value == "released"
    assert take(recording, kind="held", signal="E.activity", level=0.2, until="3.9 s").value == "held"
    assert take(recording, kind="held", signal="E.activity", level=0.05).value == "held"


def test_fraction_of_the_cycle(record, time, burst):
    fore, back = burst(0.4, duty=0.27), burst(0.4, onset=0.27, duty=0.73)
    recording = record({"F.activity": fore, "E.activity": back})
    found = take(recording, kind="fraction_active", signal="F.activity", reference="E.activity")
    assert found == MeasuredValue(pytest.approx(0.27, abs=1e-3), "")
    half = take(recording, kind="fraction_active", signal="F.activity", level=0.2)
    assert half.value == pytest.approx(0.27 * 2.0 / 3.0, abs=1e-4)
    with pytest.raises(MeasureError, match="needs either 'level' or 'reference'"):
        take(recording, kind="fraction_active", signal="F.activity")


def test_rms_difference_and_correlation_of_two_sines(record, time):
    turn = 2 * np.pi * time
    recording = record(
        {"A.angle": (np.sin(turn), "rad"), "B.angle": (0.5 + np.cos(turn), "rad"), "C.force": (turn, "N")}
    )
    found = take(recording, kind="rms_difference", signal="A.angle", reference="B.angle")
    assert found == MeasuredValue(pytest.approx(np.sqrt(1.25), abs=1e-3), "rad")
    assert take(recording, kind="correlation", signal="A.angle", reference="B.angle").value == pytest.approx(
        0, abs=1e-3
    )
    assert take(recording, kind="correlation", signal="A.angle", reference="A.angle").value == pytest.approx(1.0)
    with pytest.raises(MeasureError, match="cannot be compared"):
        take(recording, kind="rms_difference", signal="A.angle", reference="C.force")


def test_a_constant_signal_has_no_correlation(record, time):
    recording = record({"A.angle": np.ones_like(time), "B.angle": time})
    assert "no correlation" in take(recording, kind="correlation", signal="A.angle", reference="B.angle").value


def test_rms_difference_of_two_runs_with_different_clocks(record, time):
    coarse = time[::7]
    first = record({"A.angle": (3.0 * time, "rad")})
    second = record({"A.angle": (3.0 * coarse + 0.25, "rad")}, time=coarse)
    spec = Measure(kind="rms_difference", signal="A.angle")
    assert rms_difference_of_runs(View(first, spec), View(second, spec)) == pytest.approx(0.25)
    later = record({"A.angle": (coarse, "rad")}, time=coarse + 10.0)
    with pytest.raises(NotMeasurableError, match="no time in common"):
        rms_difference_of_runs(View(first, spec), View(later, spec))
