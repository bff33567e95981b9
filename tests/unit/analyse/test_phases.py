"""Phases and gaits of signals whose phases are known."""

import numpy as np
import pytest

from neuromech.analyse.measures import measure
from neuromech.analyse.phases import circular_distance, circular_mean
from neuromech.analyse.windows import NotMeasurableError
from neuromech.spec.measure import Measure

LEGS = ("LF", "RF", "LH", "RH")


def take(recording, **spec):
    return measure(recording, Measure.model_validate(spec)).value


def legs(record, burst, phases, period=0.457):
    return record({f"{leg}.RG-F.activity": burst(period, phase) for leg, phase in zip(LEGS, phases, strict=True)})


def gait(recording, **more):
    return take(recording, kind="gait", signals=[f"{leg}.RG-F.activity" for leg in LEGS], **more)


@pytest.mark.parametrize("phase", [0.0, 0.03, 0.5, 0.97])
def test_phase_of_onset(record, burst, phase):
    recording = record({"A.activity": burst(), "B.activity": burst(onset=phase)})
    found = take(recording, kind="phase", signal="B.activity", reference="A.activity", after="0.1 s")
    assert 0.0 <= found < 1.0
    assert circular_distance(found, phase) < 1e-4


@pytest.mark.parametrize("phase", [0.0, 0.24, 0.9])
def test_phase_of_activity_center(record, burst, phase):
    recording = record({"A.activity": burst(0.5), "B.activity": 0.2 + burst(0.5, onset=phase, duty=0.2)})
    found = take(recording, kind="phase", event="center", signal="B.activity", reference="A.activity", after="0.1 s")
    onset = 0.3 * np.arcsin(0.5) / np.pi
    assert circular_distance(found, phase + 0.1 - onset) < 2e-4


def test_the_mean_of_phases_goes_round_the_circle():
    assert circular_distance(circular_mean(np.array([0.98, 0.02])), 0.0) < 1e-12
    assert circular_mean(np.array([0.2, 0.3])) == pytest.approx(0.25)
    with pytest.raises(NotMeasurableError, match="no phase locking"):
        circular_mean(np.array([0.0, 0.25, 0.5, 0.75]))


def test_two_rhythms_that_drift_have_no_phase(record, burst):
    recording = record({"A.activity": burst(0.4), "B.activity": burst(0.47)})
    assert take(recording, kind="phase", signal="B.activity", reference="A.activity") == "no phase locking"


def test_order_of_pattern_formation(record, burst):
    centers = {"PFsw": 0.24, "PFtd": 0.39, "PFst": 0.76, "PFlo": 0.06}
    signals = {f"LF.{name}.activity": burst(onset=phase - 0.1, duty=0.2) for name, phase in centers.items()}
    recording = record({"LF.RG-F.activity": burst(onset=-0.05)} | signals)
    found = take(
        recording, kind="phase_order", signals=["LF.PF*.activity"], reference="LF.RG-F.activity", after="0.2 s"
    )
    assert found == "PFlo < PFsw < PFtd < PFst"


def test_order_names_the_leg_where_legs_differ(record, burst):
    recording = record({"RF.A.activity": burst(onset=0.5), "LF.A.activity": burst(onset=0.2), "X.activity": burst()})
    found = take(recording, kind="phase_order", signals=["RF.A.activity", "LF.A.activity"], reference="X.activity")
    assert found == "LF.A < RF.A"


@pytest.mark.parametrize(
    ("phases", "name"),
    [
        ((0.0, 0.5, 0.5, 0.0), "trot"),
        ((0.3, 0.83, 0.77, 0.31), "trot"),
        ((0.0, 0.5, 0.0, 0.5), "pace"),
        ((0.0, 0.0, 0.5, 0.5), "bound"),
        ((0.0, 0.02, 0.98, 0.01), "pronk"),
        ((0.23, 0.73, 0.0, 0.5), "lateral-sequence walk"),
        ((0.17, 0.66, 0.0, 0.5), "lateral-sequence walk"),
        ((0.0, 0.5, 0.25, 0.75), "diagonal-sequence walk"),
        ((0.0, 0.2, 0.5, 0.7), "gallop"),
        ((0.0, 0.9, 0.5, 0.6), "gallop"),
        ((0.0, 0.5, 0.5, 0.7), "no symmetrical gait"),
        ((0.0, 0.2, 0.5, 0.5), "no symmetrical gait"),
    ],
)
def test_gaits(record, burst, phases, name):
    assert gait(legs(record, burst, phases), after="0.4 s") == name


def test_gait_tolerance_is_a_twentieth_of_a_cycle_unless_given(record, burst):
    almost = legs(record, burst, (0.0, 0.5, 0.56, 0.06))
    assert gait(almost, after="0.2 s") == "lateral-sequence walk"
    assert gait(almost, after="0.2 s", tolerance=0.07) == "trot"


def test_a_silent_leg_has_no_gait(record, burst, time):
    signals = {f"{leg}.RG-F.activity": burst() for leg in LEGS} | {"RH.RG-F.activity": 0.0 * time}
    assert gait(record(signals)) == "no rhythm"


def test_interlimb_phases_as_text(record, burst):
    found = take(
        legs(record, burst, (0.2, 0.7, 0.7, 0.2)),
        kind="interlimb_phases",
        signals=[f"{leg}.RG-F.activity" for leg in LEGS],
        after="0.2 s",
    )
    assert found == "0.50 0.50 0.00"
