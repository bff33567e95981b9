"""What a measure says it looks at is all that it looks at, so that a document can be checked before it runs."""

from time import process_time

import numpy as np
import pytest

from neuromech.analyse.measures import measure
from neuromech.analyse.table import MEASURES
from neuromech.simulate.anatomy import Anatomy
from neuromech.spec.measure import Measure

PERIOD = 0.5
MUSCLE = {"optimal_length": 0.05, "mass": 1.0, "slow_fraction": 0.5}
ARGUMENTS = {
    "signal": "A.activity",
    "signals": ["A.activity", "B.activity"],
    "reference": "B.activity",
    "segment": "trunk",
    "muscles": ["L.SOL"],
    "level": "0.1",
    "tolerance": "5",
    "leg_length": "1 m",
    "perturbed_at": "3 s",
    "average_over": "1 s",
    "least_speed": "0.1 m/s",
    "curve": {"columns": ["a", "b"], "phases": [0.0, 30.0, 60.0], "values": [[0.0, 1.0, 0.0], [1.0, 0.0, 0.5]]},
}


def example(kind):
    """Return a measure with just what its kind needs."""
    found = {"kind": kind}
    for need in MEASURES[kind].needs:
        name = need.split(" or ")[-1]
        count = MEASURES[kind].feet or 2
        found[name] = ["LF", "RF", "LH", "RH"][:count] if name == "feet" else ARGUMENTS[name]
    return found


@pytest.fixture
def values(time, burst):
    """Return a signal of any quantity that lets every measure be taken."""

    def make(name):
        element, _, quantity = name.rpartition(".")
        phase = {"LF": 0.0, "RF": 0.5, "LH": 0.75, "RH": 0.25, "B": 0.4}.get(element, 0.1)
        if quantity == "force_z":
            return burst(PERIOD, phase, 0.6, 30.0), "N"
        if quantity in ("x", "y"):
            return 0.4 * time + 0.01 * np.sin(time), "m"
        return burst(PERIOD, phase) + 0.01 * np.sin(7.0 * time), "rad" if quantity == "yaw" else ""

    return make


@pytest.mark.parametrize("kind", MEASURES)
def test_a_recording_of_what_a_measure_names_is_enough(kind, record, values):
    spec = Measure.model_validate(example(kind))
    names = dict.fromkeys(pattern for _, pattern in spec.patterns()) or {"X.activity": None}
    recording = record({name: values(name) for name in names}, anatomy=Anatomy(6.0, 9.81, {"L.SOL": MUSCLE}))
    found = measure(recording, spec)
    words = MEASURES[kind].words
    if MEASURES[kind].result == "text":
        assert found.value in words or not words
    else:
        assert isinstance(found.value, float), found.value
        assert MEASURES[kind].least is None or found.value >= MEASURES[kind].least
        assert MEASURES[kind].most is None or found.value <= MEASURES[kind].most


def test_twenty_measures_of_ten_seconds_cost_less_than_twenty_milliseconds(record, values):
    time = np.arange(0.0, 10.0, 2e-3)
    kinds = [kind for kind in MEASURES if kind not in ("curve_correlation", "recovery_steps")][:20]
    specs = [Measure.model_validate(example(kind)) for kind in kinds]
    names = dict.fromkeys(pattern for spec in specs for _, pattern in spec.patterns())
    resampled = {
        name: (np.interp(time, np.arange(0.0, 5.0, 5e-4), values(name)[0][:10000], period=5.0), values(name)[1])
        for name in names
    }
    recording = record(resampled, time=time, anatomy=Anatomy(6.0, 9.81, {"L.SOL": MUSCLE}))
    costs = []
    for _ in range(5):
        started = process_time()
        for spec in specs:
            measure(recording, spec)
        costs.append(process_time() - started)
    assert min(costs) < 0.02
