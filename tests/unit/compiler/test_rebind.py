"""A program whose parameters were rewritten is the one that lowering the changed document gives."""

from pathlib import Path

import numpy as np
import pytest

from neuromech.compiler.lower import lower
from neuromech.compiler.rebind import Rebinding, fixed_uses, lowered_uses
from neuromech.pipeline import build_graph, load_document
from neuromech.simulate.run import simulate
from neuromech.units import measure

CAT = Path(__file__).parents[3] / "specs" / "cat" / "quadruped_body.yaml"
WEIGHTS = ("contralateral_inhibition", "joint_damping", "activation_gain", "passive_scale", "drive", "fictive_load")

LEG = {
    "parameters": {
        "mass": {"value": "1 kg"},
        "damping": {"value": "0.1 N m s/rad"},
        "start": {"value": "-50 mV"},
        "drive": {"value": 1},
        "gain": {"value": 0.5},
        "rest": {"value": "5 deg"},
    },
    "network": {
        "neurons": {"cell": {"kind": "rybak_interneuron", "initial_potential": "${start}"}},
        "drives": {"go": {"kind": "descending_drive", "strength": "${drive}"}},
        "synapses": {"excitatory": {"go": {"cell": "${gain}"}}},
    },
    "body": {
        "engine": "hinge",
        "segments": {
            "trunk": {"mass": "1 kg", "inertia": ["1 kg m^2"] * 3},
            "leg": {"mass": "${mass}", "inertia": ["1 kg m^2"] * 3},
        },
        "joints": {
            "hip": {
                "parent": "trunk",
                "child": "leg",
                "position": ["0 m"] * 3,
                "axis": [0, 1, 0],
                "damping": "${damping}",
                "rest_angle": "${rest}",
            }
        },
    },
    "protocol": {"duration": "1 s", "events": {"more": {"at": "0.5 s", "set": {"drive": 2}}}},
}


def program(file, values=None):
    overrides = [f"parameters.{name}.value={text}" for name, text in (values or {}).items()]
    return lower(build_graph(load_document(file, overrides)))


@pytest.mark.parametrize("seed", range(3))
def test_rewritten_and_lowered_anew_are_the_same_numbers(seed):
    generator = np.random.default_rng(seed)
    own = load_document(CAT).experiment.parameters
    values = {}
    for name in WEIGHTS:
        least, most = (measure(bound)[0] for bound in (own[name].minimum, own[name].maximum))
        _, _, unit = str(own[name].value).partition(" ")
        values[name] = f"{generator.uniform(least, most)!r} {unit}".strip()
    original, expected = program(CAT), program(CAT, values)
    assert fixed_uses(original, frozenset(values)) == []
    found = Rebinding(original, frozenset(values)).program_with(values)
    assert found.parameters.tobytes() == expected.parameters.tobytes() != original.parameters.tobytes()
    assert found.integers.tobytes() == expected.integers.tobytes()
    assert found.initial.tobytes() == expected.initial.tobytes()
    assert found.source == expected.source


@pytest.mark.parametrize(
    ("name", "where"),
    [
        ("mass", ["body.segments.leg.mass"]),
        ("start", ["network.neurons.cell.initial_potential"]),
        ("drive", ["protocol.events.more"]),
        ("rest", ["body.joints.hip.rest_angle"]),
        ("damping", []),
        ("gain", []),
    ],
)
def test_what_lowering_looks_at_cannot_be_rewritten(document, name, where):
    assert fixed_uses(program(document(LEG)), frozenset({name})) == where


def test_a_value_that_would_not_arrive_is_refused(document):
    lowered = program(document(LEG))
    with pytest.raises(ValueError, match=r"^only lowering can change body\.segments\.leg\.mass$"):
        Rebinding(lowered, frozenset({"mass", "damping"}))
    with pytest.raises(ValueError, match=r"^not among the parameters that can change: \['mass'\]$"):
        Rebinding(lowered, frozenset({"damping"})).program_with({"mass": "2 kg"})


def test_a_ramp_counts_as_well(document):
    ramp = {"ramps": {"up": {"parameter": "gain", "start": "0 s", "end": "1 s", "to": 1}}}
    changed = LEG | {"protocol": LEG["protocol"] | ramp}
    assert fixed_uses(program(document(changed)), frozenset({"gain"})) == ["protocol.ramps.up"]


STARTS = {
    "protocol": {
        "duration": "50 ms",
        "initial": {"hip.angle": "${angle}", "cell.potential": {"uniform": ["-70 mV", "${highest}"]}},
    },
    "parameters": LEG["parameters"] | {"angle": {"value": "5 deg"}, "highest": {"value": "-40 mV"}},
    "record": {"all": {"signals": ["hip.angle", "cell.potential"], "every": "1 ms"}},
}


def test_the_start_of_a_run_is_rewritten_too(document):
    values = {"angle": "-11 deg", "highest": "-60 mV"}
    original, expected = program(document(LEG | STARTS)), program(document(LEG | STARTS), values)
    found = Rebinding(original, frozenset(values)).program_with(values)
    runs = [simulate(one, seed=4) for one in (found, expected, original)]
    for signal in ("hip.angle", "cell.potential"):
        rewritten, lowered, old = (run.signal(signal)[1].tobytes() for run in runs)
        assert rewritten == lowered != old


def test_the_start_of_a_run_cannot_change_during_it(document):
    lowered = program(document(LEG | STARTS))
    paths = ["protocol.initial.hip.angle", "protocol.initial.cell.potential.uniform.1"]
    assert fixed_uses(lowered, frozenset({"angle", "highest"})) == paths
    assert lowered_uses(lowered, frozenset({"angle", "highest"})) == []
