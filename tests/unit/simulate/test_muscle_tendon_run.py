"""Muscles with a tendon in a run: energy, equilibrium at the start, and what a document may get wrong."""

import numpy as np
import pytest
from scipy.integrate import cumulative_trapezoid

from neuromech.errors import DocumentError
from neuromech.pipeline import run

MASS, ARM, INERTIA, START_DEGREES = 3.5, 0.2, 0.05 + 3.5 * 0.2**2, -100
FORCE, SLACK, STRAIN = 1500.0, 0.23, 0.04
WEIGHT = MASS * 9.81 * ARM


def shank(step=1, bias=0.01, slack="230 mm", muscle_step=0.25, duration=0.4):
    """A shank that hangs from a fixed thigh, flexed, and a knee extensor with a tendon."""
    arm = {"kind": "cosine", "radius": "60 mm", "angle_of_maximum": "165 deg", "reference_angle": "125 deg"}
    return {
        "network": {"neurons": {"pool": {"kind": "static_neuron", "bias": bias}}},
        "muscles": {
            "VAS": {
                "kind": "muscle_tendon_unit",
                "motoneuron": "pool",
                "path": {
                    "kind": "lever_arms",
                    "reference_length": "310 mm",
                    "arms": {"knee": {**arm, "zero_angle": "180 deg"}},
                },
                "maximal_force": f"{FORCE} N",
                "optimal_length": "80 mm",
                "tendon_slack_length": slack,
                "maximal_velocity": "12 1/s",
            }
        },
        "body": {
            "engine": "hinge",
            "segments": {
                "thigh": {"mass": "1 kg", "inertia": ["1 g m^2", "1 g m^2", "1 g m^2"]},
                "shank": {
                    "mass": f"{MASS} kg",
                    "center_of_mass": ["0 m", "0 m", f"{-ARM} m"],
                    "inertia": ["0.05 kg m^2", "0.05 kg m^2", "0.01 kg m^2"],
                },
            },
            "joints": {
                "knee": {
                    "parent": "thigh",
                    "child": "shank",
                    "position": ["0 m", "0 m", "0 m"],
                    "axis": [0, 1, 0],
                    "initial_angle": f"{START_DEGREES} deg",
                }
            },
        },
        "solver": {"step": f"{step} ms", "body_step": f"{step} ms", "muscle_step": f"{muscle_step} ms"},
        "protocol": {"duration": f"{duration} s"},
        "record": {"all": {"signals": ["knee.*", "VAS.*"], "every": f"{step} ms"}},
    }


@pytest.fixture
def drift(document):
    """A function: how far kinetic, potential and tendon energy plus the work on the fibre strays (J), and their sum."""

    def of(step):
        recording = run(document(shank(step)))
        names = ("knee.angle", "knee.velocity", "VAS.length", "VAS.fibre_length", "VAS.force")
        q, v, length, fibre, force = (recording.signal(name)[1] for name in names)
        strain = np.maximum(0.0, (length - fibre) / SLACK - 1.0)
        tendon = FORCE * SLACK * strain**3 / (3.0 * STRAIN**2)
        on_fibre = cumulative_trapezoid(force, fibre, initial=0.0)
        total = 0.5 * INERTIA * v**2 + WEIGHT * (1.0 - np.cos(q)) + tendon + on_fibre
        assert np.ptp(0.5 * INERTIA * v**2) > 1.0
        assert tendon.max() > 0.2
        return np.abs(total - total[0]).max()

    return of


def test_energy_of_a_passive_release_goes_where_it_should(drift):
    """What gravity, tendon and fibre exchange adds up within two thousandths at 1 ms, to first order."""
    fallen = WEIGHT * (1.0 - np.cos(np.radians(START_DEGREES)))
    coarse, fine = drift(1), drift(0.25)
    assert coarse < 2e-3 * fallen
    assert coarse / fine == pytest.approx(4.0, rel=0.2)


def test_a_run_starts_with_the_fibre_at_rest(document):
    recording = run(document(shank(duration=0.01)))
    assert recording.signal("VAS.force")[1][0] > 1.0
    assert abs(recording.signal("VAS.fibre_velocity")[1][0]) < 1e-9


def test_a_given_fibre_length_stays(document):
    content = shank(duration=0.01)
    content["protocol"]["initial"] = {"VAS.fibre_length": "71 mm"}
    assert run(document(content)).signal("VAS.fibre_length")[1][0] == pytest.approx(0.071, rel=1e-15)


def test_activation_follows_stimulation_exactly(document):
    """dA/dt = (S − A)/τ with S held: at any step the exponential, Dzeladini 2013 eq. 2.40."""
    for step in (0.5, 2.0):
        time, activation = run(document(shank(step=step, bias=0.6, duration=0.05))).signal("VAS.activation")
        assert activation == pytest.approx(0.6 - 0.59 * np.exp(-time / 0.01), rel=1e-12)


def test_longest_step_of_a_fibre_is_kept_whatever_the_body_step(document):
    """A muscle step of more than the body step is one step; of less, the body step is cut into equal ones."""
    coarse, fine = (run(document(shank(muscle_step=s, bias=0.5))).signal("VAS.force")[1] for s in (0.1, 0.03))
    assert 0.0 < np.abs(coarse - fine).max() < 2e-3 * FORCE


def test_a_tendon_longer_than_its_path_is_refused_with_its_place(document):
    file = document(shank(slack="400 mm"))
    with pytest.raises(DocumentError) as caught:
        run(file)
    (problem,) = caught.value.problems
    assert problem.path == "muscles.VAS.tendon_slack_length"
    assert "no equilibrium" in problem.message
    assert str(problem.mark).startswith(str(file))


def test_a_muscle_is_what_it_is_however_many_there_are(document):
    """Nine muscles of a ninth of the force move the shank as one does; they are evaluated eight at a time."""
    one = shank(bias=0.3)
    nine = shank(bias=0.3)
    part = nine["muscles"].pop("VAS") | {"maximal_force": f"{FORCE / 9} N"}
    nine["muscles"] = {f"VAS{number}": part for number in range(9)}
    nine["record"]["all"]["signals"] = ["knee.*", "VAS8.*"]
    whole, parts = run(document(one)), run(document(nine))
    assert np.ptp(whole.signal("knee.angle")[1]) > 0.2
    assert parts.signal("knee.angle")[1] == pytest.approx(whole.signal("knee.angle")[1], abs=1e-9)
    assert parts.signal("VAS8.force")[1] == pytest.approx(whole.signal("VAS.force")[1] / 9, abs=1e-6)
