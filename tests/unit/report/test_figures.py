"""Figures show the signals that were recorded, in the units of the field and in authored order."""

import matplotlib as mpl
import numpy as np
import pytest
from matplotlib.collections import PolyCollection
from matplotlib.patches import Rectangle

from neuromech.report.activity import activity_figure
from neuromech.report.feet import foot_path_figure
from neuromech.report.joints import joint_angle_figure, phase_plane_figure
from neuromech.report.layout import by_scope, recent, trace
from neuromech.report.muscles import muscle_force_figure
from neuromech.report.overview import write_figures

THESIS_ORDER = ["RG-F", "RG-E", "PFsw", "PFtd", "PFst", "PFlo", "Mn1", "Mn2", "Mn3", "Mn4", "Mn5", "Mn6"]


def test_figures_are_written_for_the_signals_that_exist(cat, tmp_path):
    drawn = write_figures(cat(), tmp_path / "air")
    assert {path.stem for path in drawn.files} == {
        "activity",
        "joint_angles",
        "cycle",
        "phase_plane",
        "muscle_forces",
        "foot_path",
    }
    assert drawn.reasons() == {
        "no foot touches the ground": ["footfall", "leg_loads", "vertical_force", "flexor_contact"],
        "no claim compares a signal with a curve": ["correlations"],
        "no joint torque is recorded": ["cycle_torques"],
        "no activation of a muscle is recorded": ["cycle_activations"],
        "roll and pitch of the root are not recorded": ["inclination"],
        "trunk does not move": ["speed"],
        "the protocol disturbs nothing, and no time was given": ["recovery"],
        "the body in the recording cannot be used: body has no segment": ["terrain", "stills"],
        "the protocol has no series of pushes": ["push_series"],
        "no muscle has lever arms": ["lever_arms"],
    }
    for path in (tmp_path / "air").iterdir():
        assert path.read_bytes().startswith(b"\x89PNG")


def test_a_network_alone_gives_its_activity_only(record, tmp_path):
    wave = 0.5 + 0.5 * np.sin(np.arange(3000) * 0.012)
    recording = record({"A.activity": ("", wave), "B.activity": ("", 1.0 - wave)})
    assert [path.name for path in write_figures(recording, tmp_path, ["png", "svg"]).files] == [
        "activity.png",
        "activity.svg",
    ]
    (reason,) = write_figures(recording, tmp_path).reasons()
    assert reason == "the document has no body"
    assert "suspended cat" in activity_figure(recording).axes[0].get_title(loc="left")


def test_drawing_leaves_the_settings_of_the_user_alone(record, tmp_path):
    before = dict(mpl.rcParams)
    write_figures(record({"A.activity": ("", np.zeros(10))}), tmp_path)
    assert dict(mpl.rcParams) == before


def test_the_same_recording_gives_the_same_files(record, tmp_path):
    recording = record({"A.activity": ("", np.sin(np.arange(3000) * 0.012))})
    first = [path.read_bytes() for path in write_figures(recording, tmp_path / "a", ["png", "svg"]).files]
    assert first == [path.read_bytes() for path in write_figures(recording, tmp_path / "b", ["png", "svg"]).files]


def test_activities_are_stacked_in_the_order_of_the_thesis_without_interneurons(cat):
    axes = activity_figure(cat()).axes
    assert [one.get_title(loc="left") for one in axes] == ["LF", "RF", "LH", "RH"]
    rows = [label.get_text() for label in axes[0].get_yticklabels()]
    assert rows == THESIS_ORDER
    assert list(axes[0].get_yticks()) == sorted(axes[0].get_yticks(), reverse=True)


def test_one_cycle_of_the_motoneurons_is_framed(cat):
    for axes in activity_figure(cat()).axes:
        (frame,) = [patch for patch in axes.patches if isinstance(patch, Rectangle)]
        assert frame.get_width() == pytest.approx(0.457, abs=1e-3)
        start, end = axes.get_xlim()
        assert start <= frame.get_x() < frame.get_x() + frame.get_width() <= end
        rows = [y for y in axes.get_yticks() if frame.get_y() < y < frame.get_y() + frame.get_height()]
        assert len(rows) == 6


def test_no_activity_goes_beyond_its_row(cat):
    for axes in activity_figure(cat()).axes:
        filled = [one for one in axes.collections if isinstance(one, PolyCollection)][:12]
        for row, shape in enumerate(filled):
            heights = shape.get_paths()[0].vertices[:, 1]
            assert heights.min() == pytest.approx(-row)
            assert -row + 0.2 < heights.max() <= -row + 0.86


def test_the_window_holds_four_cycles_at_the_end(cat):
    start, end = recent(cat())
    assert end - start == pytest.approx(4 * 0.457, abs=1e-3)
    assert end > 11.5


def test_the_window_of_a_run_without_rhythm_is_its_last_two_seconds(record):
    assert recent(record({"A.activity": ("", np.zeros(5000))})) == pytest.approx((2.999, 4.999))


def test_joint_angles_are_in_degrees_with_their_centers(cat):
    axes = joint_angle_figure(cat()).axes
    assert axes[0].get_ylabel() == "angle (deg)"
    assert [one.get_title(loc="left") for one in axes[::2]] == ["LF", "RF", "LH", "RH"]
    labels = [text.get_text() for text in axes[1].get_legend().get_texts()]
    assert labels == ["hip, centre 70 deg", "knee, centre 110 deg", "ankle, centre 120 deg"]


def test_a_still_joint_is_drawn_without_a_center(record):
    axes = joint_angle_figure(record({"LF.hip.angle": ("rad", np.ones(3000))})).axes
    assert [text.get_text() for text in axes[1].get_legend().get_texts()] == ["hip"]


def test_phase_planes_are_of_joints_and_not_of_muscles(cat):
    figure = phase_plane_figure(cat())
    panels = [one for one in figure.axes if one.get_title(loc="left")]
    assert [one.get_title(loc="left") for one in panels[:3]] == ["LF hip", "LF knee", "LF ankle"]
    assert len(panels) == 12
    assert panels[-1].get_xlabel() == "angle (deg)"
    assert panels[0].get_ylabel() == "velocity (deg/s)"


def test_muscle_forces_are_grouped_by_leg(cat):
    axes = muscle_force_figure(cat()).axes
    assert [one.get_title(loc="left") for one in axes] == ["LF", "RF", "LH", "RH"]
    assert [text.get_text() for text in axes[0].get_legend().get_texts()] == [f"M{n}" for n in range(1, 7)]
    assert axes[0].get_ylabel() == "force (N)"


def test_foot_paths_are_relative_to_the_trunk_in_millimetres(cat):
    (line,) = foot_path_figure(cat()).axes[0].get_lines()
    x, z = line.get_data()
    assert (x.min(), x.max()) == (pytest.approx(-50.0, abs=0.1), pytest.approx(50.0, abs=0.1))
    assert z.min() == pytest.approx(-200.0)


def test_a_diverged_run_is_drawn_as_far_as_it_is_finite(cat, record, tmp_path):
    values = np.sin(np.arange(3000) * 0.012)
    values[2000:] = np.inf
    signals = {"LF.RG-F.activity": ("", values), "LF.hip.angle": ("rad", values), "LF.hip.velocity": ("rad/s", values)}
    recording = record(signals | {"LF.M1.force": ("N", values)})
    assert len(write_figures(recording, tmp_path).files) == 4


def test_a_run_of_a_single_sample_can_be_drawn(record, tmp_path):
    units = {"RG-F.activity": "", "hip.angle": "rad", "hip.velocity": "rad/s", "M1.force": "N"}
    units |= {"foot.x": "m", "foot.z": "m", "foot.force_z": "N"}
    recording = record({f"LF.{name}": (unit, np.ones(1)) for name, unit in units.items()})
    assert len(write_figures(recording, tmp_path).files) == 5


def test_scopes_keep_recorded_order_and_nested_names(record):
    zero = ("", np.zeros(3))
    recording = record({"R.a.B.activity": zero, "L.a.A.activity": zero, "R.a.A.activity": zero, "X.activity": zero})
    assert by_scope(recording, "activity") == {
        "R.a": ["R.a.B.activity", "R.a.A.activity"],
        "L.a": ["L.a.A.activity"],
        "": ["X.activity"],
    }


@pytest.mark.parametrize(("unit", "shown", "factor"), [("rad", "deg", 180 / np.pi), ("m", "mm", 1e3), ("N", "N", 1.0)])
def test_units_of_the_reader(record, unit, shown, factor):
    seen = trace(record({"LF.a.b": (unit, np.ones(3))}), "LF.a.b")
    assert (seen.unit, seen.values[0]) == (shown, pytest.approx(factor))


def test_a_first_jerk_does_not_squeeze_the_phase_plane(record):
    angle, velocity = np.sin(np.arange(5000) * 0.01), np.cos(np.arange(5000) * 0.01)
    velocity[:5] = 500.0
    figure = phase_plane_figure(record({"LH.hip.angle": ("rad", angle), "LH.hip.velocity": ("rad/s", velocity)}))
    low, high = figure.axes[0].get_ylim()
    assert low == pytest.approx(-1.3 * 180 / np.pi, rel=0.01)
    assert high == pytest.approx(1.3 * 180 / np.pi, rel=0.01)
