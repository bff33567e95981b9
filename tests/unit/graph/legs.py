"""A small leg as a plain dictionary, and the way from such a dictionary to its graph."""

from pathlib import Path
from typing import Any

from neuromech.components.catalogue import Catalogue
from neuromech.errors import Mark
from neuromech.spec.document import Document
from neuromech.spec.model import Experiment

RG = {
    "kind": "rybak_neuron",
    "layer": "rhythm_generator",
    "sodium_conductance": "3.5 nS",
    "maximal_inactivation_time": "300 ms",
}
INTERNEURON = {"kind": "rybak_interneuron", "layer": "interneuron"}
MOTONEURON = {"kind": "rybak_interneuron", "layer": "motoneuron"}
BRICK = {"mass": "1 kg", "inertia": ["2 g m^2", "2 g m^2", "2 g m^2"]}
MUSCLE = {
    "kind": "brown_muscle",
    "flexor": "RG-F",
    "extensor": "RG-E",
    "maximal_force": "50 N",
    "optimal_length": "80 mm",
    "standing_length": "90 mm",
    "passive_stiffness_in_flexion": 0.1,
    "passive_stiffness_in_extension": 0.2,
}


def synapse(kind: str, weight: float = 1.0, **fields: Any) -> dict[str, Any]:
    return {"kind": kind, "weight": weight, **fields}


def muscle(motoneuron: str, joint: str = "hip", arm: str = "10 mm") -> dict[str, Any]:
    way = {
        "kind": "constant_moment_arms",
        "reference_length": "90 mm",
        "reference_angles": {joint: "0 deg"},
        "moment_arms": {joint: arm},
    }
    return {**MUSCLE, "motoneuron": motoneuron, "path": way}


def joint(parent: str, child: str, **fields: Any) -> dict[str, Any]:
    return {"parent": parent, "child": child, "position": ["0 m", "0 m", "-0.1 m"], "axis": [0, 1, 0], **fields}


LEG: dict[str, Any] = {
    "network": {
        "neurons": {"RG-F": RG, "RG-E": RG, "In-F": INTERNEURON, "Mn-F": MOTONEURON},
        "synapses": {
            "excitatory": {
                "brain": {"RG-F": synapse("excitatory", 0.1), "RG-E": synapse("excitatory", 0.1)},
                "RG-F": {"In-F": synapse("excitatory"), "Mn-F": synapse("excitatory", 2.0, delay="2 ms")},
                "stretch": {"Mn-F": synapse("excitatory", 0.2)},
            },
            "inhibitory": {"In-F": {"RG-E": synapse("inhibitory")}, "load": {"RG-F": synapse("inhibitory", 0.05)}},
        },
    },
    "muscles": {"flexor": muscle("Mn-F")},
    "sensors": {
        "load": {"kind": "leg_load_sensor", "contact": "foot", "gain": "0.05 1/N"},
        "stretch": {
            "kind": "ia_stretch_sensor",
            "muscle": "flexor",
            "load_sensor": "load",
            "threshold_length": "80 mm",
        },
    },
    "body": {
        "segments": {"thigh": BRICK, "shank": BRICK},
        "joints": {
            "hip": joint("trunk", "thigh", range=["-60 deg", "60 deg"]),
            "knee": joint("thigh", "shank", range=["-90 deg", "0 deg"]),
        },
        "contacts": {"foot": {"segment": "shank", "position": ["0 m", "0 m", "-0.1 m"], "radius": "10 mm"}},
    },
}

QUADRUPED_HALF: dict[str, Any] = {
    "neuromech": 1,
    "name": "two legs",
    "network": {
        "drives": {"brain": {"kind": "descending_drive", "strength": 2.05}},
        "synapses": {
            "interlimb": {
                "LF.RG-F": {"RF.RG-F": synapse("interlimb", 0.02)},
                "RF.RG-F": {"LF.RG-F": synapse("interlimb", 0.02)},
            }
        },
    },
    "instances": {"LF": LEG, "RF": LEG},
    "body": {"segments": {"trunk": BRICK}, "root": {"kind": "free"}},
    "world": {"ground": {"height": "-1 m"}},
    "protocol": {"duration": "1 s", "initial": {"*.inactivation": {"uniform": [0.3, 0.6]}}},
    "record": {"neurons": {"signals": ["*.activity"], "every": "1 ms"}},
}


def to_document(raw: dict[str, Any]) -> Document:
    experiment = Experiment.model_validate(raw, context={"catalogue": Catalogue.built_in()})
    marks = {path: Mark("leg.yaml", line, 1) for line, path in enumerate(_paths(raw), start=1)}
    return Document(Path("leg.yaml"), experiment, marks, "", (Path("leg.yaml"),))


def _paths(value: Any, path: str = "") -> list[str]:
    pairs = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    found = [path] if path else []
    for name, inner in pairs:
        found += _paths(inner, f"{path}.{name}" if path else str(name))
    return found
