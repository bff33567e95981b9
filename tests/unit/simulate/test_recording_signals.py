"""Recordings give back each signal with its time, unit and order, and say what is missing."""

import numpy as np
import pytest

from neuromech.errors import RecordingError
from neuromech.simulate.recording import GroupData, Outcome, Provenance, Recording

TIME = np.arange(5) * 0.01


def provenance(**changes):
    values = {
        "name": "cat",
        "specification": "neuromech: 1\nname: Kätzchen\n" * 4000,
        "version": "0.1.0",
        "versions": {"numpy": "2.4.6"},
        "engine": "none",
        "platform": "Linux x86_64, Python 3.11",
        "seed": 3,
        "parameters": {"d": 2.05, "load": "20 N", "count": 4},
        "outcome": Outcome("diverged", 1.5, "LF.RG-F.potential is not finite"),
        "simulated_seconds": 1.5,
        "wall_seconds": 0.25,
    }
    return Provenance(**(values | changes))


def group(names, units=None, time=TIME, scale=1.0):
    values = scale * (np.arange(len(time))[:, None] + 100.0 * np.arange(len(names))[None, :])
    return GroupData(time, tuple(names), values, tuple(units or [""] * len(names)))


def test_each_signal_comes_back_from_its_own_column():
    names = ["RF.B.activity", "LF.A.force", "LF.A.activity"]
    recording = Recording.from_groups({"all": group(names, ["", "N", ""])}, provenance())
    for column, name in enumerate(names):
        time, values = recording.signal(name)
        np.testing.assert_array_equal(time, TIME)
        np.testing.assert_array_equal(values, np.arange(5) + 100.0 * column)
    assert [recording.unit(name) for name in names] == ["", "N", ""]


def test_recorded_order_is_kept_across_quantities():
    names = ["RF.B.activity", "LF.A.force", "LF.A.activity", "A0.x.force"]
    recording = Recording.from_groups({"all": group(names)}, provenance())
    assert recording.names == names
    assert recording.match("*.force") == ["LF.A.force", "A0.x.force"]
    assert recording.match("LF.?.*") == ["LF.A.force", "LF.A.activity"]
    assert recording.match("*.angle") == []


def test_one_quantity_in_two_units_is_kept_apart():
    names = ["hip.velocity", "muscle.velocity", "hip2.velocity"]
    recording = Recording.from_groups({"body": group(names, ["rad/s", "m/s", "rad/s"])}, provenance())
    assert [recording.unit(name) for name in names] == ["rad/s", "m/s", "rad/s"]
    assert recording.signal("muscle.velocity")[1][0] == 100.0
    assert recording.signal("hip2.velocity")[1][0] == 200.0


@pytest.mark.parametrize("order", [("fine", "coarse"), ("coarse", "fine")])
def test_the_finest_rate_wins_whatever_the_order_of_groups(order):
    groups = {
        "fine": group(["A.activity"], time=np.arange(10) * 0.001),
        "coarse": group(["A.activity"], scale=-1.0),
    }
    recording = Recording.from_groups({name: groups[name] for name in order}, provenance())
    assert len(recording.signal("A.activity")[0]) == 10


def test_tree_is_described_by_dimensions_and_units():
    recording = Recording.from_groups({"neurons": group(["LF.A.activity", "LF.B.activity"])}, provenance())
    node = recording.tree["neurons"]
    assert node["activity"].dims == ("time", "activity_element")
    assert list(node["activity_element"].values) == ["LF.A", "LF.B"]
    assert node["time"].attrs["units"] == "s"
    assert recording.tree.attrs["engine"] == "none"


def test_a_missing_signal_is_named_with_the_closest_one():
    recording = Recording.from_groups({"neurons": group(["LF.RG-F.activity"])}, provenance())
    with pytest.raises(RecordingError, match=r"'LF.RGF.activity' was not recorded.*did you mean 'LF.RG-F.activity'"):
        recording.signal("LF.RGF.activity")


def test_provenance_survives_its_attributes():
    written = provenance()
    assert Provenance.from_attributes(written.to_attributes()) == written


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"values": np.zeros((4, 1))}, "values must be"),
        ({"units": ()}, "values must be"),
        ({"time": np.zeros(5)}, "time must increase"),
        ({"names": ("activity",)}, "element.quantity"),
        ({"units": ("furlong",)}, "no unit"),
    ],
)
def test_arrays_that_do_not_belong_together_are_refused(change, message):
    fields = {"time": TIME, "names": ("A.activity",), "values": np.zeros((5, 1)), "units": ("",)}
    with pytest.raises(ValueError, match=message):
        GroupData(**(fields | change))
