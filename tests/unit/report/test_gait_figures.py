"""Figures of gait show the contacts that the measures count, and cycles as they are."""

import json

import numpy as np
import pytest

from neuromech.analyse.cycles import Cycles
from neuromech.report.cycle import cycle_figure
from neuromech.report.footfall import flexor_contact_figure, footfall_figure, load_figure
from neuromech.report.layout import NotDrawableError
from neuromech.report.recovery import recovery_figure
from neuromech.report.speed import speed_figure
from neuromech.report.steps import feet
from neuromech.report.trunk import inclination_figure
from neuromech.simulate.recording import Outcome

PERIOD = 0.4
STANCE = 0.25
TIME = np.arange(0.0, 8.0, 0.001)


@pytest.fixture
def record(record):
    """Make a recording of eight seconds of a body of 6 kg."""

    def make(signals, specification="", parameters=None):
        return record(signals, Outcome("finished", 8.0), 6.0, specification, parameters)

    return make


def stepping(shift):
    """Force of a foot that is loaded from `shift` to `shift + STANCE` of each period, in s."""
    return np.where((TIME - shift) % PERIOD < STANCE, 20.0, 0.0)


def bars(axes):
    """Return {row: [(start, end) of each bar]}; rows count downwards from 0."""
    return {
        row: [(path.get_extents().x0, path.get_extents().x1) for path in rows.get_paths()]
        for row, rows in enumerate(axes.collections)
    }


def test_a_footfall_diagram_covers_exactly_the_contacts(record):
    shifts = {"LH": 0.1, "LF": 0.2, "RF": 0.0, "RH": 0.3}
    recording = record({f"{leg}.foot.force_z": ("N", stepping(shift)) for leg, shift in shifts.items()})
    axes = footfall_figure(recording).axes[0]
    assert [label.get_text() for label in axes.get_yticklabels()] == ["LH", "LF", "RF", "RH"]
    shown = bars(axes)
    for row, (leg, foot) in enumerate(feet(recording).items()):
        assert np.allclose(shown[row], foot.contacts)
        whole = [bar for bar in shown[row] if bar[0] > 0.0 and bar[1] < TIME[-1]]
        phases = (np.array([start for start, _ in whole]) - shifts[leg] + 0.1) % PERIOD
        assert phases == pytest.approx(0.1, abs=2e-3)
        assert [end - start for start, end in whole] == pytest.approx([STANCE] * len(whole), abs=2e-3)
        assert len(whole) >= 18


def test_the_mean_stride_starts_with_the_touchdown_of_its_foot(record):
    shifts = {"LH": 0.1, "LF": 0.2, "RF": 0.0, "RH": 0.3}
    recording = record({f"{leg}.foot.force_z": ("N", stepping(shift)) for leg, shift in shifts.items()})
    axes = footfall_figure(recording).axes[1]
    assert axes.get_title(loc="left") == "lateral-sequence walk"
    for row, shift in enumerate(shifts.values()):
        expected = 100.0 * ((shift - 0.1) % PERIOD) / PERIOD
        starts = [start for start, _ in bars(axes)[row]]
        assert any(abs(start - expected) < 1.0 for start in starts)
        assert all(end - start == pytest.approx(62.5, abs=1.0) for start, end in bars(axes)[row])


def test_feet_that_never_touch_are_not_drawn(record):
    recording = record({"LH.foot.force_z": ("N", np.zeros(3000))})
    for draw in (footfall_figure, load_figure, flexor_contact_figure):
        with pytest.raises(NotDrawableError, match="no foot touches"):
            draw(recording)


def test_contacts_of_one_leg_are_one_foot(record):
    recording = record({"L.heel.force_z": ("N", stepping(0.0)), "L.toe.force_z": ("N", stepping(0.1))})
    (foot,) = feet(recording).values()
    inner = foot.contacts[1:-1]
    assert np.allclose(inner[:, 1] - inner[:, 0], STANCE + 0.1, atol=3e-3)


def test_leg_loads_are_those_recorded(record):
    (axes,) = load_figure(record({"LH.foot.force_z": ("N", stepping(0.0))})).axes
    (line,) = axes.get_lines()
    time, load = line.get_data()
    assert np.array_equal(load, np.interp(time, TIME, stepping(0.0)))
    assert axes.get_ylabel() == "load (N)"


def test_the_flexor_is_compared_with_the_contacts_of_its_own_leg(record):
    active = np.where((TIME + 0.05) % PERIOD < 0.1, 0.5, 0.0)  # For 50 ms of each contact of 250 ms.
    signals = {"LH.RG-F.activity": ("", active), "RH.RG-E.activity": ("", active)}
    signals |= {f"{leg}.foot.force_z": ("N", stepping(0.0)) for leg in ("LH", "RH")}
    (axes,) = flexor_contact_figure(record(signals)).axes
    assert axes.get_title(loc="left") == "LH: RG-F active during 20 % of contact"


def test_a_normalised_sinusoid_is_a_sinusoid():
    onsets = np.array([0.3, 1.1, 2.3, 3.0])
    phase = np.interp(TIME, onsets, np.arange(4.0))
    curves = Cycles(onsets).normalised(TIME, np.sin(2.0 * np.pi * phase), 51)
    assert curves.shape == (3, 51)
    assert np.allclose(curves, np.sin(2.0 * np.pi * np.linspace(0.0, 1.0, 51)), atol=1e-4)


def test_a_cycle_from_touchdown_shows_mean_spread_and_stance(record):
    angle = 0.5 * np.sin(2.0 * np.pi * TIME / PERIOD)
    signals = {"LH.hip.angle": ("rad", angle), "LH.foot.force_z": ("N", stepping(0.1))}
    (axes,) = cycle_figure(record(signals)).axes
    assert axes.get_xlabel() == "% of cycle from\ntouchdown"
    mean, bar = axes.get_lines()[:2]
    percent, shown = mean.get_data()
    expected = np.rad2deg(0.5) * np.sin(2.0 * np.pi * (percent / 100.0 + 0.25))
    assert np.allclose(shown, expected, atol=0.5)
    assert bar.get_xdata()[1] == pytest.approx(62.5, abs=1.0)
    spread = axes.collections[0].get_paths()[0].get_extents()
    assert spread.height < np.ptp(expected) + 1.0


@pytest.mark.parametrize(("begins_at", "peak"), [("touchdown", 25.0), ("liftoff", 87.5)])
def test_a_claimed_reference_stands_beside_the_angle_with_the_same_mean(record, begins_at, peak):
    angle = 0.5 + 0.2 * np.sin(2.0 * np.pi * TIME / PERIOD)
    signals = {"LH.hip.angle": ("rad", angle), "LH.foot.force_z": ("N", stepping(0.1))}
    curve = {"columns": ["-hip_deg"], "begins_at": begins_at, "phases": [0, 25, 50, 75], "values": [[0, 8, 0, -8]]}
    measure = {"kind": "curve_correlation", "signals": ["LH.hip.angle"], "feet": ["LH.foot"], "curve": curve}
    document = json.dumps({"claims": {"hip": {"measure": measure}, "gone": None}})
    figure = cycle_figure(record(signals, specification=document))
    mean, *_, reference = figure.axes[0].get_lines()
    percent, shown = reference.get_data()
    assert np.ptp(shown) == pytest.approx(16.0, abs=0.5)
    assert shown.mean() == pytest.approx(mean.get_ydata().mean())
    assert percent[np.argmax(shown)] == pytest.approx(peak, abs=2.0)
    assert [text.get_text() for text in figure.legends[0].get_texts()] == ["reference, shifted to the same mean"]


def test_a_cycle_in_the_air_starts_with_a_neuron(cat):
    figure = cycle_figure(cat())
    assert {axes.get_xlabel() for axes in figure.axes if axes.get_xlabel()} == {"% of cycle from\nonset of RG-F"}
    assert [axes.get_ylabel() for axes in figure.axes[::4]] == ["hip (deg)", "knee (deg)", "ankle (deg)"]


def test_a_leg_that_does_not_move_has_no_cycle(record):
    with pytest.raises(NotDrawableError, match="rhythmically"):
        cycle_figure(record({"LH.hip.angle": ("rad", np.zeros(3000))}))


def test_inclination_is_in_degrees_with_the_contacts_below(record):
    signals = {"trunk.roll": ("rad", 0.02 * np.sin(TIME)), "trunk.pitch": ("rad", 0.01 * np.cos(TIME))}
    signals["LH.foot.force_z"] = ("N", stepping(0.0))
    tilt, contacts = inclination_figure(record(signals)).axes
    roll = tilt.get_lines()[0]
    assert np.allclose(roll.get_ydata(), np.rad2deg(0.02 * np.sin(roll.get_xdata())), atol=1e-9)
    assert [label.get_text() for label in contacts.get_yticklabels()] == ["LH"]


SPECIFICATION = """
protocol:
  duration: 8 s
  ramps:
    faster: {parameter: drive, start: 2 s, end: 6 s, to: 1.5}
  events:
    push: {at: 1 s, set: {load: 0.2 kg}}
parameters: {}
"""
PARAMETERS = {"drive": 1.0, "load": "100 g"}


def test_speed_is_the_way_over_a_cycle_and_parameters_move_as_the_protocol_says(record):
    way = 0.5 * TIME + 0.01 * np.sin(2.0 * np.pi * TIME / PERIOD)
    signals = {"trunk.x": ("m", way), "LH.foot.force_z": ("N", stepping(0.0))}
    left, right = speed_figure(record(signals, SPECIFICATION, PARAMETERS)).axes
    assert np.allclose(left.get_lines()[0].get_ydata(), 0.5, atol=1e-3)
    load, drive = sorted(right.get_lines(), key=lambda line: line.get_label(), reverse=True)
    assert (load.get_label(), drive.get_label()) == ("load (g)", "drive")
    assert np.interp([0.5, 1.5], *load.get_data()) == pytest.approx([100.0, 200.0])
    assert np.interp([1.0, 4.0, 7.0], *drive.get_data()) == pytest.approx([1.0, 1.25, 1.5])


def test_a_body_that_stays_has_no_speed(record):
    with pytest.raises(NotDrawableError, match="does not move"):
        speed_figure(record({"trunk.x": ("m", np.zeros(3000))}))


def test_recovery_has_a_colour_for_every_five_seconds_after_the_event(record):
    signals = {"LH.hip.angle": ("rad", np.sin(TIME)), "LH.hip.velocity": ("rad/s", np.cos(TIME))}
    recording = record(signals, SPECIFICATION, PARAMETERS)
    (axes,) = recovery_figure(recording).axes
    assert [line.get_label() for line in axes.get_lines()] == ["before", "0 to 5 s", "5 to 10 s"]
    angles = axes.get_lines()[1].get_xdata()
    assert angles == pytest.approx(np.rad2deg(np.sin(TIME[(TIME >= 1.0) & (TIME <= 6.0)])))
    (axes,) = recovery_figure(recording, after=4.0).axes
    assert [line.get_label() for line in axes.get_lines()] == ["before", "0 to 5 s"]
    with pytest.raises(NotDrawableError, match="ended before"):
        recovery_figure(recording, after=9.0)


PUSHED = """
protocol:
  duration: 8 s
  pushes:
    shove: {segment: trunk, force: [0 N, 0 N, -9 N], start: 1 s, delay: {uniform: [1 s, 2 s]}, duration: 100 ms}
"""


def test_a_push_is_no_foot_and_begins_when_its_force_does(record):
    signals = {"LH.hip.angle": ("rad", np.sin(TIME)), "LH.hip.velocity": ("rad/s", np.cos(TIME))}
    signals["LH.foot.force_z"] = ("N", stepping(0.0))
    signals["shove.force_z"] = ("N", np.where(abs(TIME - 2.55) < 0.0501, -9.0, 0.0))
    recording = record(signals, PUSHED)
    assert list(feet(recording)) == ["LH"]
    (axes,) = recovery_figure(recording).axes
    after = axes.get_lines()[1].get_xdata()
    assert after[0] == pytest.approx(np.rad2deg(np.sin(2.5)), abs=0.1)
    assert after[-1] == pytest.approx(np.rad2deg(np.sin(7.5)), abs=0.1)


def test_no_disturbance_no_recovery(record):
    signals = {"LH.hip.angle": ("rad", np.sin(TIME)), "LH.hip.velocity": ("rad/s", np.cos(TIME))}
    with pytest.raises(NotDrawableError, match="disturbs nothing"):
        recovery_figure(record(signals))
