"""Rhythm, period, centre and settling of signals whose answers are known."""

import numpy as np
import pytest

from neuromech.analyse.cycles import bursts, onsets
from neuromech.analyse.measures import MeasuredValue, measure
from neuromech.errors import MeasureError, RecordingError
from neuromech.simulate.recording import Outcome
from neuromech.spec.measure import Measure


def take(recording, **spec):
    return measure(recording, Measure.model_validate(spec))


@pytest.mark.parametrize("period", [0.457, 0.2, 1.1])
def test_period_of_a_burst_train_is_exact_between_samples(record, burst, period):
    found = take(record({"F.activity": burst(period)}), kind="period", signal="F.activity", after="0.3 s")
    assert found.unit == "s"
    assert found.value == pytest.approx(period, abs=2e-6)


def test_period_is_the_median_so_that_one_odd_cycle_does_not_count(record, time):
    warped = np.where(time < 2.0, time, time - np.clip(time - 2.0, 0.0, 0.1))
    found = take(record({"F.activity": np.sin(2 * np.pi * warped / 0.5)}), kind="period", signal="F.activity")
    assert found.value == pytest.approx(0.5, abs=1e-5)


def test_noise_at_half_amplitude_does_not_count_twice(record, time):
    noise = 0.1 * np.random.default_rng(4).standard_normal(len(time))
    signal = np.sin(2 * np.pi * time / 0.5) + noise
    assert len(onsets(time, signal)) == 10
    assert take(record({"F.activity": signal}), kind="period", signal="F.activity").value == pytest.approx(
        0.5, abs=0.02
    )


@pytest.mark.parametrize(
    "shape",
    [
        lambda t: 0.0 * t,
        lambda t: 0.3 + 0.004 * np.sin(2 * np.pi * t / 0.5),
        lambda t: np.exp(-t),
        lambda t: np.where(t < 2.0, np.sin(2 * np.pi * t / 0.4), 0.0),
        lambda t: np.sin(2 * np.pi * t / 2.4),
    ],
    ids=["silent", "too small", "decay", "stops", "too few cycles"],
)
def test_no_rhythm_is_said_in_words(record, time, shape):
    recording = record({"F.activity": shape(time)})
    assert take(recording, kind="rhythm", signal="F.activity") == MeasuredValue("no rhythm", None)
    assert take(recording, kind="period", signal="F.activity") == MeasuredValue("no rhythm", "s")


def test_the_amplitude_criterion_can_be_set_in_the_unit_of_the_signal(record, time):
    recording = record({"hip.angle": (np.deg2rad(4.0) * np.sin(2 * np.pi * time / 0.5), "rad")})
    assert take(recording, kind="rhythm", signal="hip.angle", least_amplitude="7.9 deg").value == "rhythm"
    assert take(recording, kind="rhythm", signal="hip.angle", least_amplitude="8.1 deg").value == "no rhythm"
    with pytest.raises(MeasureError, match=r"must be a least amplitude in units like rad \(got 3 N\)"):
        take(recording, kind="rhythm", signal="hip.angle", least_amplitude="3 N")


def test_center_is_the_midpoint_of_the_extremes_and_not_the_mean(record, time, burst):
    angle = np.deg2rad(60.0) + np.deg2rad(20.0) * burst(0.5, height=1.0)
    found = take(record({"hip.angle": (angle, "rad")}), kind="center", signal="hip.angle")
    assert found == MeasuredValue(pytest.approx(np.deg2rad(70.0), abs=1e-5), "rad")
    amplitude = take(record({"hip.angle": (angle, "rad")}), kind="amplitude", signal="hip.angle")
    assert amplitude.value == pytest.approx(np.deg2rad(10.0), abs=1e-5)


def test_center_of_a_still_joint_can_be_taken_over_the_cycles_of_another_signal(record, time, burst):
    recording = record({"hip.angle": (np.full_like(time, 2.5), "rad"), "F.activity": burst()})
    assert take(recording, kind="center", signal="hip.angle").value == "no rhythm"
    assert take(recording, kind="center", signal="hip.angle", reference="F.activity").value == 2.5


def test_settling_time_is_the_start_of_the_first_cycle_that_stays(record, time):
    drift = np.where(time < 2.0, 1.0, 0.0)
    recording = record({"hip.angle": (drift + 0.8 * np.cos(2 * np.pi * time / 0.25), "rad")})
    found = take(recording, kind="settling_time", signal="hip.angle", tolerance="1 deg")
    assert found.unit == "s"
    assert 2.0 <= found.value <= 2.25
    later = take(recording, kind="settling_time", signal="hip.angle", tolerance="1 deg", after="1 s")
    assert later.value == pytest.approx(found.value - 1.0, abs=1e-6)


def test_a_steady_drift_never_settles(record, time):
    recording = record({"hip.angle": (0.1 * time + np.cos(2 * np.pi * time / 0.25), "rad")})
    assert take(recording, kind="settling_time", signal="hip.angle", tolerance="0.1 deg").value == "not settled"


def test_bursts_give_onset_duration_peak_and_center(time, burst):
    found = bursts(time, burst(1.0, onset=0.25, duty=0.5), 0.0)
    assert len(found) == 5
    for number, one in enumerate(found):
        assert one.onset == pytest.approx(number + 0.25, abs=1e-3)
        assert one.duration == pytest.approx(0.5, abs=2e-3)
        assert one.peak == pytest.approx(0.4, abs=1e-6)
        assert one.center == pytest.approx(number + 0.5, abs=1e-3)


def test_burst_duration_leaves_out_bursts_that_the_record_cuts(record, time, burst):
    recording = record({"F.activity": burst(1.0, onset=0.9, duty=0.3)})
    found = take(recording, kind="burst_duration", signal="F.activity", level=0.2)
    assert found.value == pytest.approx(0.2, abs=2e-3)
    assert take(recording, kind="burst_duration", signal="F.activity", level=0.5).value == "no burst"


def test_what_is_not_finite_is_said_and_not_measured(record, time):
    signal = np.sin(20 * time)
    signal[-1] = np.nan
    assert take(record({"F.activity": signal}), kind="mean", signal="F.activity").value == "F.activity is not finite"


def test_a_run_that_ended_early_can_only_be_measured_before_its_end(record, time):
    recording = record({"F.activity": np.sin(20 * time)}, outcome=Outcome("diverged", 5.0, "x"))
    assert take(recording, kind="rhythm", signal="F.activity").value == "the run diverged at 5 s"
    assert take(recording, kind="rhythm", signal="F.activity", until="4 s").value == "rhythm"
    assert take(recording, kind="outcome").value == "diverged"


def test_a_window_after_the_end_is_said_in_words(record, time):
    recording = record({"F.activity": np.sin(20 * time)})
    assert "ended at 5 s" in take(recording, kind="maximum", signal="F.activity", after="6 s").value


def test_wrong_measures_are_refused_with_a_hint(record, time):
    recording = record({"F.activity": np.sin(20 * time)})
    with pytest.raises(MeasureError, match=r"'periode' is not a measure. Hint: did you mean 'period'"):
        take(recording, kind="periode", signal="F.activity")
    with pytest.raises(MeasureError, match="measure 'period' needs 'signal'"):
        take(recording, kind="period")
    with pytest.raises(RecordingError, match=r"did you mean 'F.activity'"):
        take(recording, kind="period", signal="F.activty")
