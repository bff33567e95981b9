"""The way of a body whose way is known, and what can be said of runs that ended early."""

import numpy as np
import pytest

from neuromech.analyse.measures import MeasuredValue, measure
from neuromech.analyse.table import MEASURES
from neuromech.errors import MeasureError
from neuromech.simulate.anatomy import Anatomy
from neuromech.simulate.recording import Outcome
from neuromech.spec.measure import Measure

FELL = Outcome("fell", 4.0, "the root is low")


def take(recording, **spec):
    return measure(recording, Measure.model_validate(spec))


@pytest.fixture
def walk(record, time):
    """A trunk that walks at 0.6 m/s forward and 0.1 m/s to its right, swings its yaw, and turns by 0.02 rad/s."""

    def make(**more):
        signals = {
            "trunk.x": (0.6 * time, "m"),
            "trunk.y": (1.0 - 0.1 * time, "m"),
            "trunk.yaw": ((3.0 + 0.02 * time + 0.1 * np.sin(2 * np.pi * time) + np.pi) % (2 * np.pi) - np.pi, "rad"),
        }
        return record(signals, **more)

    return make


def test_distance_and_speed_along_an_axis(walk):
    recording = walk()
    assert take(recording, kind="distance", segment="trunk") == MeasuredValue(pytest.approx(3.0), "m")
    assert take(recording, kind="distance", segment="trunk", axis="y", after="1 s").value == pytest.approx(-0.4)
    assert take(recording, kind="speed", segment="trunk", after="2 s") == MeasuredValue(pytest.approx(0.6), "m/s")


def test_speed_range_is_that_of_means_over_stretches(record, time):
    # The speed grows from 0.2 to 1.2 m/s in 5 s, and swings by 0.5 m/s twice in a second.
    way = 0.2 * time + 0.1 * time**2 + 0.5 / (4 * np.pi) * np.sin(4 * np.pi * time)
    ramp = record({"trunk.x": (way, "m")})
    found = take(ramp, kind="speed_range", segment="trunk", average_over="1 s")
    assert found == MeasuredValue(pytest.approx(0.2 * 4.0, abs=1e-6), "m/s")
    too_long = take(ramp, kind="speed_range", segment="trunk", average_over="6 s")
    assert too_long.value == "the window is shorter than 6 s"


def test_moving_time_ends_with_the_first_slow_stretch(record, time):
    """It walks at 0.6 m/s, swinging back and forth in each stride, and stands still from 3 s on."""
    way = 0.6 * np.minimum(time, 3.0) + 0.1 * np.sin(4 * np.pi * np.minimum(time, 3.0))
    stops = record({"trunk.x": (way, "m"), "trunk.y": (-way, "m"), "trunk.z": (0.6 * time, "m")})

    def moves(recording=stops, **more):
        asked = {"segment": "trunk", "least_speed": "0.06 m/s", "average_over": "1 s", **more}
        return take(recording, kind="moving_time", **asked).value

    # A tenth of the stretch is still walked, with the swing of the last tenth of a second before the stop.
    assert 2.8 < moves() < 3.0
    assert moves(until="2 s") == pytest.approx(2.0)
    assert moves(axis="y") == 0.0
    assert moves(axis="z") == pytest.approx(time[-1])
    assert moves(after="4 s") == 0.0
    # Within a stride it swings back; a stretch of a fraction of it sees that.
    assert moves(average_over="10 ms") < 0.3
    assert moves(record({"trunk.x": (way, "m")}, outcome=FELL)) == moves()
    assert moves(average_over="20 s", until="2 s") == pytest.approx(2.0)


def test_froude_number(walk):
    recording = walk(anatomy=Anatomy(6.0, 9.81, {}))
    found = take(recording, kind="froude_number", segment="trunk", leg_length="200 mm")
    assert found == MeasuredValue(pytest.approx(0.36 / (9.81 * 0.2)), "")
    with pytest.raises(MeasureError, match="needs gravity"):
        take(walk(), kind="froude_number", segment="trunk", leg_length="200 mm")


def test_direction_of_the_way(walk, record, time):
    found = take(walk(), kind="travel_direction", segment="trunk")
    assert found == MeasuredValue(pytest.approx(-np.arctan2(0.1, 0.6)), "rad")
    still = record({"trunk.x": (0.0 * time, "m"), "trunk.y": (0.0 * time, "m")})
    assert take(still, kind="travel_direction", segment="trunk").value == "trunk does not move"


def test_heading_drift_leaves_out_the_yaw_of_each_cycle_and_goes_round_the_circle(walk):
    found = take(walk(), kind="heading_drift", segment="trunk")
    swing_on_slope = -6.0 * 0.1 / np.pi / 5.0  # least squares of a sine over whole cycles is not quite flat
    assert found == MeasuredValue(pytest.approx(0.02 * 5.0 + swing_on_slope, abs=1e-4), "rad")


def test_time_alive(walk):
    assert take(walk(), kind="time_alive") == MeasuredValue(5.0, "s")
    assert take(walk(), kind="time_alive", after="1 s", until="3 s").value == 2.0
    assert take(walk(outcome=FELL), kind="time_alive").value == 4.0
    assert take(walk(outcome=FELL), kind="time_alive", until="6 s").value == 4.0
    assert take(walk(outcome=FELL), kind="time_alive", after="4.5 s").value == 0.0


def test_what_can_be_measured_of_a_run_that_fell(walk, time):
    early = walk(outcome=FELL)
    assert take(early, kind="outcome").value == "fell"
    assert take(early, kind="distance", segment="trunk").value == pytest.approx(3.0)
    assert take(early, kind="speed", segment="trunk").value == pytest.approx(0.6)
    assert take(early, kind="heading_drift", segment="trunk").value == "the run ended in a fall at 4 s"
    assert take(early, kind="mean", signal="trunk.x").value == "the run ended in a fall at 4 s"
    assert take(early, kind="mean", signal="trunk.x", until="3 s").value == pytest.approx(0.9)


def test_a_run_that_fell_before_the_window_has_no_distance(walk, record, time):
    short = record({"trunk.x": (time, "m")}, outcome=Outcome("fell", 5.0, ""))
    found = take(short, kind="distance", segment="trunk", after="6 s")
    assert found == MeasuredValue("the run ended at 5 s, before there was a signal", "m")


def test_kinds_of_early_ends_are_those_that_say_so():
    partial = {name for name, kind in MEASURES.items() if kind.of_early_end}
    until_it_falls = {"outcome", "time_alive", "running_time", "distance", "speed", "froude_number", "touchdowns"}
    assert partial == until_it_falls | {"moving_time", "metabolic_energy"}


@pytest.mark.parametrize(
    ("spec", "message"),
    [
        ({"kind": "speed"}, "measure 'speed' needs 'segment'"),
        ({"kind": "speed", "segment": "t", "signal": "t.x"}, "measure 'speed' takes no 'signal'. Hint: it takes axis"),
        ({"kind": "outcome", "level": 1}, "measure 'outcome' takes no 'level'"),
        ({"kind": "gait", "feet": ["a", "b"]}, r"measure 'gait' takes 4 feet \(got 2\)"),
        ({"kind": "gait"}, "measure 'gait' needs either 'signals' or 'feet'"),
        ({"kind": "gait", "feet": ["a"] * 4, "signals": ["b.c"]}, "measure 'gait' takes either .* not both"),
        ({"kind": "mean", "signal": "a.b", "least_duration": "1 s"}, "measure 'mean' takes no 'least_duration'"),
        ({"kind": "center", "signal": "a.b", "feet": ["a"], "reference": "c.d"}, "takes either .* not both"),
    ],
)
def test_arguments_that_are_missing_or_mean_nothing(walk, spec, message):
    with pytest.raises(MeasureError, match=message):
        take(walk(), **spec)
