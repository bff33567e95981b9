"""Strides of feet whose touchdowns and liftoffs are known."""

import numpy as np
import pytest

from neuromech.analyse.contacts import footfalls
from neuromech.analyse.forces import filtered
from neuromech.analyse.measures import MeasuredValue, measure
from neuromech.analyse.phases import circular_distance
from neuromech.analyse.windows import View
from neuromech.errors import MeasureError
from neuromech.simulate.anatomy import Anatomy
from neuromech.simulate.recording import Outcome
from neuromech.spec.measure import Measure

PERIOD, DUTY, PEAK, LEVEL = 0.457, 0.62, 30.0, 1.5
LEGS = ("LF", "RF", "LH", "RH")
CAT = Anatomy(6.0, 9.81, {})


def take(recording, **spec):
    return measure(recording, Measure.model_validate(spec))


def edges(level=LEVEL, duty=DUTY):
    """Phases at which the half sine rises through the level and falls through half of it."""
    return duty * np.arcsin(level / PEAK) / np.pi, duty * (1.0 - np.arcsin(level / 2.0 / PEAK) / np.pi)


@pytest.fixture
def feet(record, burst):
    """Four feet that are loaded for a part of each cycle, from given phases on."""

    def make(phases=(0.0, 0.5, 0.5, 0.0), duty=DUTY, **more):
        signals = {
            f"{leg}.foot.force_z": (burst(PERIOD, phase, duty, PEAK), "N")
            for leg, phase in zip(LEGS, phases, strict=True)
        }
        return record(signals, **more)

    return make


def of(*legs):
    return {"feet": [f"{leg}.foot" for leg in legs], "level": f"{LEVEL} N"}


def test_durations_of_strides(feet):
    rise, fall = edges()
    recording = feet()
    for kind, expected in (
        ("cycle_duration", PERIOD),
        ("stance_duration", (fall - rise) * PERIOD),
        ("swing_duration", (1.0 - fall + rise) * PERIOD),
    ):
        assert take(recording, kind=kind, **of("LF")) == MeasuredValue(pytest.approx(expected, abs=2e-5), "s")
    assert take(recording, kind="duty_factor", **of(*LEGS)) == MeasuredValue(pytest.approx(fall - rise, abs=5e-5), "")


def test_duty_factor_is_averaged_over_feet(record, burst):
    recording = record(
        {
            "LF.foot.force_z": (burst(PERIOD, 0.0, 0.6, PEAK), "N"),
            "RF.foot.force_z": (burst(PERIOD, 0.5, 0.7, PEAK), "N"),
        }
    )
    rise, fall = np.mean([edges(duty=duty) for duty in (0.6, 0.7)], axis=0)
    assert take(recording, kind="duty_factor", **of("LF", "RF")).value == pytest.approx(fall - rise, abs=1e-4)


def test_a_foot_is_loaded_from_two_percent_of_body_weight_on_where_no_level_is_given(feet):
    rise, fall = edges(level=0.02 * CAT.weight)
    found = take(feet(anatomy=CAT), kind="duty_factor", feet=["LF.foot"])
    assert found.value == pytest.approx(fall - rise, abs=5e-5)
    with pytest.raises(MeasureError, match="needs a body with weight"):
        take(feet(), kind="duty_factor", feet=["LF.foot"])


def test_chatter_of_a_contact_does_not_count(feet, record, burst, time):
    load = burst(PERIOD, 0.0, DUTY, PEAK)
    phase = (time / PERIOD) % 1.0
    load[(phase > 0.2) & (phase < 0.2 + 0.015 / PERIOD)] = 0.0  # a gap of 15 ms in stance
    load[(phase > 0.8) & (phase < 0.8 + 0.015 / PERIOD)] = PEAK  # a scuff of 15 ms in swing
    chattering = record({"LF.foot.force_z": (load, "N")})
    expected = take(feet(), kind="duty_factor", **of("LF")).value
    assert take(chattering, kind="duty_factor", **of("LF")).value == pytest.approx(expected, abs=1e-9)
    short = take(chattering, kind="cycle_duration", least_duration="1 ms", **of("LF")).value
    assert short < 0.9 * PERIOD


def test_a_load_between_half_the_level_and_the_level_keeps_what_it_was(record, time):
    load = np.where(time < 1.0, 0.0, np.where(time < 2.0, 1.2, np.where(time < 3.0, 3.0, 1.2)))
    recording = record({"LF.foot.force_z": (load, "N")})
    (found,) = footfalls(View(recording, Measure.model_validate({"kind": "touchdowns", **of("LF")})))
    assert found.contacts == pytest.approx(np.array([[2.0, 5.0]]), abs=1e-3)
    assert list(found.loaded(np.array([0.5, 1.5, 2.5, 4.9]))) == [False, False, True, True]


def test_heel_and_toe_are_one_foot(record, burst):
    heel, toe = burst(PERIOD, 0.0, 0.4, PEAK), burst(PERIOD, 0.2, 0.4, PEAK)
    recording = record({"L.heel.force_z": (heel, "N"), "L.toe.force_z": (toe, "N")})
    found = take(recording, kind="duty_factor", feet=["L.*"], level="1.5 N").value
    rise, fall = edges(duty=0.4)
    assert found == pytest.approx(0.2 + fall - rise, abs=2e-4)


def test_feet_of_two_limbs_are_not_one_foot(feet):
    with pytest.raises(MeasureError, match=r"'\*.foot' must be the contacts of one foot \(got those of LF, RF, LH, RH"):
        take(feet(), kind="duty_factor", feet=["*.foot"], level="1 N")


def test_touchdowns_are_counted_also_of_a_run_that_fell(feet):
    phases = (0.1, 0.5, 0.5, 0.0)
    for leg, count in {"LF": 11.0, "LH": 10.0}.items():  # in 10.28 cycles
        assert take(feet(phases), kind="touchdowns", until="4.7 s", **of(leg)) == MeasuredValue(count, "")
    fell = feet(phases, outcome=Outcome("fell", 5.0, ""))
    assert take(fell, kind="touchdowns", **of("LF", "LH")).value == 22.0


def test_a_foot_that_stands_or_hangs_makes_no_strides(record, time, burst):
    steps = burst(PERIOD, 0.0, DUTY, PEAK)
    signals = {"A.foot": 0.0 * time, "B.foot": 0.0 * time + PEAK, "C.foot": np.where(time < 3.0, steps, PEAK)}
    recording = record({f"{name}.force_z": (load, "N") for name, load in signals.items()})
    assert take(recording, kind="duty_factor", **of("A")).value == "A.foot makes fewer than 3 strides"
    assert take(recording, kind="duty_factor", **of("B")).value == "B.foot makes fewer than 3 strides"
    assert take(recording, kind="duty_factor", **of("C")).value == "C.foot stops stepping"


def test_gait_and_phases_of_feet(feet):
    walk = feet((0.17, 0.66, 0.0, 0.5))
    assert take(walk, kind="gait", **of(*LEGS)).value == "lateral-sequence walk"
    assert take(feet(), kind="gait", **of(*LEGS)).value == "trot"
    assert take(walk, kind="interlimb_phases", **of(*LEGS)).value == "0.49 0.83 0.33"
    phase = take(walk, kind="interlimb_phase", **of("LH", "LF"))
    assert circular_distance(phase.value, 0.17) < 1e-4
    assert phase.unit == ""


def test_cycles_of_feet_serve_other_measures(record, burst, time):
    turn = 2 * np.pi * time / PERIOD
    recording = record(
        {
            "LF.foot.force_z": (burst(PERIOD, 0.0, DUTY, PEAK), "N"),
            "LF.hip.angle": (0.3 + 0.2 * np.sin(turn) + 0.01 * np.sin(7 * turn), "rad"),
            "LF.RG-F.activity": burst(PERIOD, 0.6, 0.2),
        }
    )
    hip = {"signal": "LF.hip.angle", **of("LF")}
    assert take(recording, kind="center", **hip).value == pytest.approx(0.3, abs=1e-3)
    span = np.ptp(recording.signal("LF.hip.angle")[1])
    assert take(recording, kind="cycle_range", **hip) == MeasuredValue(pytest.approx(span, abs=1e-4), "rad")
    found = take(recording, kind="phase", event="center", signal="LF.RG-F.activity", **of("LF")).value
    assert circular_distance(found, 0.7 - edges()[0]) < 1e-4


@pytest.mark.parametrize("duty", [0.4, 0.62, 0.8])
def test_double_support_of_two_feet_in_antiphase(feet, duty):
    rise, fall = edges(duty=duty)
    expected = max(0.0, (fall - rise - 0.5) * PERIOD)
    found = take(feet(duty=duty), kind="double_support_duration", **of("LF", "RF"))
    assert found == MeasuredValue(pytest.approx(expected, abs=5e-5), "s")


@pytest.mark.parametrize("duty", [0.3, 0.4, 0.62])
def test_flight_of_two_feet_in_antiphase(feet, duty):
    rise, fall = edges(duty=duty)
    found = take(feet(duty=duty), kind="flight_duration", **of("LF", "RF"))
    assert found == MeasuredValue(pytest.approx((0.5 - fall + rise) * PERIOD, abs=5e-5), "s")


def test_flight_is_that_of_the_shortest_step(feet):
    rise, fall = edges(duty=0.3)
    recording = feet((0.0, 0.4, 0.0, 0.0), duty=0.3)
    expected = pytest.approx((0.4 - fall + rise) * PERIOD, abs=5e-5)
    assert take(recording, kind="flight_duration", **of("LF", "RF")).value == expected


def test_feet_run_until_one_touches_down_beside_the_other(record, burst, time):
    left, right = burst(PERIOD, 0.0, 0.3, PEAK), burst(PERIOD, 0.5, 0.3, PEAK)
    rise, _ = edges(duty=0.3)
    walked = np.where(time < 6.0 * PERIOD, right, burst(PERIOD, 0.2, 0.3, PEAK))
    hopped = np.where(time < 6.0 * PERIOD, right, 0.0)
    for other, expected in ((right, time[-1]), (walked, (6.2 + rise) * PERIOD), (hopped, (7.0 + rise) * PERIOD)):
        recording = record({"LF.foot.force_z": (left, "N"), "RF.foot.force_z": (other, "N")})
        assert take(recording, kind="running_time", **of("LF", "RF")).value == pytest.approx(expected, abs=1e-4)


def test_feet_that_never_touch_the_ground_run_to_the_end(record, time):
    recording = record({f"{leg}.foot.force_z": (np.zeros(len(time)), "N") for leg in ("LF", "RF")})
    assert take(recording, kind="running_time", **of("LF", "RF")).value == time[-1]


def test_asymmetry_of_stance(record, burst):
    recording = record(
        {f"{leg}.foot.force_z": (burst(PERIOD, 0.0, duty, PEAK), "N") for leg, duty in (("L", 0.5), ("R", 0.7))}
    )
    left, right = (np.subtract(*edges(duty=duty)[::-1]) for duty in (0.5, 0.7))
    expected = (right - left) / ((right + left) / 2.0)
    assert take(recording, kind="stance_asymmetry", **of("L", "R")).value == pytest.approx(expected, abs=1e-3)
    assert take(recording, kind="stance_asymmetry", **of("L", "L")).value == 0.0


def test_ratio_of_periods(record, burst):
    recording = record(
        {
            "F.foot.force_z": (burst(0.3, 0.0, DUTY, PEAK), "N"),
            "H.foot.force_z": (burst(0.45, 0.0, DUTY, PEAK), "N"),
            "RG.activity": burst(0.6),
        }
    )
    assert take(recording, kind="period_ratio", **of("F", "H")).value == pytest.approx(2.0 / 3.0, abs=1e-4)
    neural = take(recording, kind="period_ratio", signals=["RG.activity", "F.foot.force_z"])
    assert neural == MeasuredValue(pytest.approx(2.0, abs=1e-3), "")
    with pytest.raises(MeasureError, match="takes the names of signals, not patterns"):
        take(recording, kind="period_ratio", signals=["*.activity", "RG.activity"])
    with pytest.raises(MeasureError, match=r"takes 2 signals \(got 1\)"):
        take(recording, kind="period_ratio", signals=["RG.activity"])


def test_touchdowns_per_cycle_of_the_network(record, burst):
    signals = {"RG.activity": burst(0.4), "L.foot.force_z": (burst(0.4, 0.3, 0.5, PEAK), "N")}
    signals["R.foot.force_z"] = (burst(0.2, 0.3, 0.5, PEAK), "N")
    recording = record(signals)
    regular = take(recording, kind="touchdowns_per_cycle", reference="RG.activity", **of("L"))
    assert regular == MeasuredValue(1.0, "")
    assert take(recording, kind="touchdowns_per_cycle", reference="RG.activity", **of("L", "R")).value == 1.5


def test_part_of_the_activity_in_stance(record, burst, time):
    load = np.where((time / 0.5) % 1.0 < 0.6, PEAK, 0.0)
    ramp = (time / 0.5) % 1.0 - 0.2  # below zero it is no activity
    recording = record({"L.foot.force_z": (load, "N"), "RG.activity": ramp, "Mn.activity": 0.0 * time})
    found = take(recording, kind="fraction_in_stance", signal="RG.activity", **of("L"))
    assert found == MeasuredValue(pytest.approx(0.4**2 / 0.8**2, abs=2e-3), "")
    silent = take(recording, kind="fraction_in_stance", signal="Mn.activity", **of("L"))
    assert silent.value == "Mn.activity is never active"


def test_peak_of_a_constant_load_after_the_filter(record, time):
    stance = 0.3
    load = np.where((time / 0.5) % 1.0 < stance / 0.5, 90.0, 0.0)
    recording = record({"L.foot.force_z": (load, "N")}, anatomy=CAT)
    expected = 90.0 * (1.0 - np.exp(-100.0 * stance)) / CAT.weight
    assert take(recording, kind="ground_reaction_peak", feet=["L.foot"]) == MeasuredValue(
        pytest.approx(expected, rel=1e-3), ""
    )


def test_the_filter_is_exact_for_a_ramp():
    time = np.arange(0.0, 0.1, 1e-3)
    slope = 3000.0
    exact = slope * (time - (1.0 - np.exp(-100.0 * time)) / 100.0)
    assert filtered(time, slope * time) == pytest.approx(exact, abs=1e-9)
    assert filtered(time, np.full_like(time, 7.0)) == pytest.approx(7.0)


def test_a_load_with_two_humps_has_two_peaks(record, time):
    phase = (time / 1.0) % 1.0
    slow = np.where(phase < 0.6, 800.0 + 100.0 * np.sin(2 * np.pi * phase / 0.6), 0.0)
    recording = record({"L.foot.force_z": (slow, "N")}, anatomy=Anatomy(80.0, 9.81, {}))
    first, second = (take(recording, kind=kind, feet=["L.foot"]).value for kind in ("loading_peak", "push_off_peak"))
    gain = 1.0 / np.sqrt(1.0 + (2 * np.pi / 0.6 / 100.0) ** 2)
    assert first * 80.0 * 9.81 == pytest.approx(800.0 + 100.0 * gain, rel=2e-3)
    assert second < first - 0.05


@pytest.mark.parametrize("kind", ["ground_reaction_peak", "loading_peak", "push_off_peak"])
def test_an_average_over_a_whole_oscillation_of_a_force_has_its_mean_as_peak(record, time, kind):
    phase = (time / 1.0) % 1.0
    load = np.where(phase < 0.6, 800.0 + 400.0 * np.sin(2 * np.pi * phase / 0.1), 0.0)
    recording = record({"L.foot.force_z": (load, "N")}, anatomy=Anatomy(80.0, 9.81, {}))
    assert take(recording, kind=kind, feet=["L.foot"]).value * 80.0 * 9.81 > 1000.0
    found = take(recording, kind=kind, feet=["L.foot"], average_over="100 ms").value
    assert found * 80.0 * 9.81 == pytest.approx(800.0, rel=0.02)


@pytest.mark.parametrize("humps", [1, 2, 3])
def test_humps_of_a_force_are_counted_and_an_average_over_them_has_one(record, time, humps):
    phase = (time / 1.0) % 1.0
    wave = 0.6 - 0.4 * np.cos(2.0 * np.pi * humps * phase / 0.6)
    recording = record(
        {"L.foot.force_z": (np.where(phase < 0.6, 800.0 * wave, 0.0), "N")}, anatomy=Anatomy(80.0, 9.81, {})
    )
    assert take(recording, kind="force_humps", feet=["L.foot"]).value == humps
    smooth = take(recording, kind="force_humps", feet=["L.foot"], average_over=f"{0.6 / humps!r} s")
    assert smooth.value == 1.0
