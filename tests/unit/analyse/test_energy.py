"""Energy of muscles whose signals are constant, so that each term of the energy is known."""

import numpy as np
import pytest

from neuromech.analyse.measures import MeasuredValue, measure
from neuromech.errors import MeasureError
from neuromech.simulate.anatomy import Anatomy
from neuromech.simulate.recording import Outcome
from neuromech.spec.measure import Measure

SOLEUS = {"optimal_length": 0.04, "mass": 1.36, "slow_fraction": 0.81, "maximal_force": 4000.0}
VASTI = {"optimal_length": 0.08, "mass": 2.91, "slow_fraction": 0.5, "maximal_force": 6000.0}
HUMAN = Anatomy(80.0, 9.81, {"L.SOL": SOLEUS, "L.VAS": VASTI})


def take(recording, **spec):
    return measure(recording, Measure.model_validate(spec))


@pytest.fixture
def muscles(record, time):
    """Record muscles with constant signals; lengths in optimal lengths, velocities in m/s."""

    def make(anatomy=HUMAN, outcome=None, speed=1.3, **muscles):
        signals = {"trunk.x": (speed * time, "m")}
        for name, values in muscles.items():
            optimal = anatomy.muscles[f"L.{name}"]["optimal_length"]
            full = {"s": 0.0, "a": 0.0, "l": 1.0, "v": 0.0, "F": 0.0, "Ft": 0.0} | values
            for quantity, value, unit in (
                ("stimulation", full["s"], ""),
                ("activation", full["a"], ""),
                ("fibre_length", full["l"] * optimal, "m"),
                ("fibre_velocity", full["v"], "m/s"),
                ("active_force", full["F"], "N"),
                ("force", full["Ft"], "N"),
            ):
                signals[f"L.{name}.{quantity}"] = (value + 0.0 * time, unit)
        return record(signals, anatomy=anatomy, outcome=outcome)

    return make


def power(recording, **more):
    return take(recording, kind="metabolic_power", muscles=["L.*"], **more)


@pytest.mark.parametrize(
    ("signals", "expected"),
    [
        ({}, 0.0),
        ({"s": 1.0}, 1.36 * (40 * 0.81 + 133 * 0.19)),
        ({"s": 1.0 / 3.0}, 1.36 * (40 * 0.81 * 0.5 + 133 * 0.19 * (1 - np.sqrt(0.75)))),
        ({"a": 1.0}, 1.36 * (74 * 0.81 + 111 * 0.19)),
        ({"a": 1.0, "l": 1.25}, 1.36 * 0.5 * (74 * 0.81 + 111 * 0.19)),
        ({"a": 1.0, "l": 1.6}, 0.0),
        ({"a": 1.0, "l": 0.3}, 1.36 * 0.5 * (74 * 0.81 + 111 * 0.19)),
        ({"a": 1.0, "l": 0.8}, 1.36 * 0.8 * (74 * 0.81 + 111 * 0.19)),
        ({"v": -0.1, "Ft": 900.0}, 0.25 * 900.0 * 0.1),
        ({"v": -0.1, "F": 800.0}, 800.0 * 0.1),
        ({"v": 0.1, "F": 800.0, "Ft": 900.0}, 0.0),
    ],
)
def test_each_term_of_the_power(muscles, signals, expected):
    assert power(muscles(SOL=signals)) == MeasuredValue(pytest.approx(expected, abs=1e-9), "W")


def test_the_printed_maintenance_heat_differs_between_half_and_whole_optimal_length(muscles):
    at = {length: muscles(SOL={"a": 1.0, "l": length}) for length in (0.45, 0.75, 1.0, 1.2)}
    ratios = [power(run).value / power(run, maintenance="dzeladini_2013").value for run in at.values()]
    assert ratios == pytest.approx([1.0, 0.75, 1.0, 1.0])


def test_energy_adds_up_over_muscles_and_time(muscles):
    both = muscles(SOL={"s": 1.0}, VAS={"s": 1.0})
    expected = 1.36 * (40 * 0.81 + 133 * 0.19) + 2.91 * (40 * 0.5 + 133 * 0.5)
    energy = take(both, kind="metabolic_energy", muscles=["*"], after="1 s")
    assert energy == MeasuredValue(pytest.approx(4.0 * expected), "J")
    only = take(both, kind="metabolic_power", muscles=["L.VAS"])
    assert only.value == pytest.approx(2.91 * (40 * 0.5 + 133 * 0.5))


def test_cost_of_transport(muscles):
    walk = {"muscles": ["*"], "segment": "trunk"}
    recording = muscles(SOL={"v": -0.1, "F": 3000.0})
    assert take(recording, kind="energy_per_distance", **walk) == MeasuredValue(pytest.approx(300.0 / 1.3), "J/m")
    found = take(recording, kind="cost_of_transport", **walk)
    assert found == MeasuredValue(pytest.approx(300.0 / 1.3 / (80.0 * 9.81)), "")
    backward = muscles(SOL={"s": 1.0}, speed=-0.1)
    assert take(backward, kind="cost_of_transport", **walk).value == "trunk does not go forward"


def test_energy_until_a_fall(muscles):
    fell = muscles(SOL={"v": -0.1, "F": 3000.0}, outcome=Outcome("fell", 5.0, ""))
    assert take(fell, kind="metabolic_energy", muscles=["*"]).value == pytest.approx(1500.0)
    assert power(fell).value == "the run ended in a fall at 5 s"


def test_a_muscle_without_a_mass_is_named(muscles):
    bare = Anatomy(80.0, 9.81, {"L.SOL": {"optimal_length": 0.04}})
    with pytest.raises(MeasureError, match=r"needs 'mass' of muscle L\.SOL"):
        power(muscles(anatomy=bare, SOL={"s": 1.0}))
