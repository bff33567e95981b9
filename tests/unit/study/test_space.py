"""From a point in the box to values in a document, and back."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from neuromech.pipeline import load_document
from neuromech.study.space import Dimension, Space
from neuromech.units import measure

coordinates = st.floats(0.0, 1.0)


@pytest.fixture
def space(relaxing):
    def make(tune):
        return Space.of(load_document(relaxing({"tune": tune})))

    return make


@given(
    coordinate=coordinates,
    least=st.floats(1e-9, 1e6),
    width=st.floats(1e-9, 1e6),
    unit=st.sampled_from(["", "ms", "deg", "mm", "nS", "%"]),
    log=st.booleans(),
)
def test_what_is_read_back_lies_within_the_bounds(coordinate, least, width, unit, log):
    most = measure(f"{least + width!r} {unit}".strip())[0]
    dimension = Dimension("x", (), measure(f"{least!r} {unit}".strip())[0], most, unit, log)
    assert dimension.least <= measure(dimension.text(coordinate))[0] <= dimension.most


def test_the_ends_of_the_box_are_the_bounds(space):
    found = space({"bias": {}, "time_constant": {"range": ["0.5 ms", "50 ms"]}})
    assert found.values(np.array([0.0, 1.0])) == {
        "parameters.bias.value": "-2.0",
        "parameters.time_constant.value": "50.0 ms",
    }


def test_half_way_on_a_logarithmic_scale_is_the_geometric_mean(space):
    found = space({"time_constant": {"range": ["1 ms", "100 ms"], "scale": "log"}})
    assert measure(found.parameters(np.array([0.5]))["time_constant"])[0] == pytest.approx(0.01)


def test_the_documents_own_values_are_the_start(space, relaxing):
    tune = {"bias": {}, "weight": {"scale": "log"}, "time_constant": {}}
    found = space(tune)
    own = found.parameters(found.point(load_document(relaxing({"tune": tune}))))
    assert {name: measure(text)[0] for name, text in own.items()} == pytest.approx(
        {"bias": 1.0, "weight": 0.5, "time_constant": 0.02}
    )


def test_a_start_outside_of_the_range_moves_to_its_end(space, relaxing):
    found = space({"bias": {"range": [2, 3]}})
    assert found.point(load_document(relaxing())).tolist() == [0.0]


def test_what_follows_gets_the_same_text(space):
    found = space({"weight": {"also": ["start"], "range": [0.1, 0.9]}})
    values = found.parameters(np.array([0.3]))
    assert values["start"] == values["weight"]
    assert found.names == ("weight",)
    assert found.all_names == ("weight", "start")


def test_what_is_mirrored_gets_the_negative_to_the_last_bit(space):
    found = space({"weight": {"also": ["start", "-bias"], "range": [0.1, 0.9], "scale": "log"}})
    for coordinate in (0.0, 0.3, 1.0):
        values = found.parameters(np.array([coordinate]))
        assert values["start"] == values["weight"]
        assert float(values["bias"]) == -float(values["weight"]) < 0.0
    assert found.all_names == ("weight", "start", "bias")
    assert Dimension("x", (("y", -1),), -1.0, 1.0, "mm", log=False).texts(0.5) == {"x": "0.0 mm", "y": "0.0 mm"}


def test_a_point_outside_of_the_box_counts_as_its_edge(space):
    found = space({"bias": {}})
    assert found.parameters(np.array([1.7])) == found.parameters(np.array([1.0]))


@given(st.lists(coordinates, min_size=2, max_size=2, unique=True))
def test_different_coordinates_are_different_values(points):
    low, high = (Dimension("x", (), 0.001, 0.1, "ms", log=False).value(point) for point in sorted(points))
    assert low < high or high - low < 1e-12
