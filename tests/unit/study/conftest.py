"""Recordings whose measures are known, and documents with a study."""

import json
from collections.abc import Iterator

import numpy as np
import pytest
from postgresql import postgresql

from neuromech.simulate.recording import GroupData, Outcome, Provenance, Recording

RELAXING = {
    "neuromech": 1,
    "name": "relaxing",
    "parameters": {
        "bias": {"value": 1, "minimum": -2, "maximum": 3},
        "weight": {"value": 0.5, "minimum": 0.01, "maximum": 2},
        "time_constant": {"value": "20 ms", "minimum": "0.1 ms", "maximum": "100 ms"},
        "start": {"value": 0.3, "minimum": 0, "maximum": 1},
    },
    "network": {
        "neurons": {
            "first": {
                "kind": "rate_neuron",
                "time_constant": "${time_constant}",
                "bias": "${bias}",
                "initial_rate": "${start}",
            },
            "second": {"kind": "rate_neuron", "time_constant": "10 ms"},
        },
        "synapses": {"excitatory": {"first": {"second": "${weight}"}}},
    },
    "solver": {"method": "rk4", "step": "1 ms"},
    "protocol": {"duration": "200 ms"},
    "record": {"all": {"signals": ["*"], "every": "1 ms"}},
    "study": {
        "tune": {"bias": {}, "weight": {"scale": "log"}},
        "algorithm": {"kind": "pso", "population": 4},
        "evaluations": 8,
        "objective": {
            "terms": {
                "level": {
                    "measure": {"kind": "final", "signal": "second.activity"},
                    "target": 0.6,
                    "scale": 0.1,
                }
            }
        },
    },
}
"""Two neurons that relax, and the search for a level of the second."""


@pytest.fixture
def relaxing(tmp_path):
    """A function that writes the relaxing network with other keys of its study, and returns its file."""

    def write(study=None, **sections):
        file = tmp_path / f"relaxing{len(list(tmp_path.iterdir()))}.yaml"
        merged = {key: value for key, value in (RELAXING["study"] | (study or {})).items() if value is not None}
        file.write_text(json.dumps(RELAXING | sections | {"study": merged}), encoding="utf-8")
        return file

    return write


@pytest.fixture
def record():
    """A function that makes a recording from {name: (value, unit)}: constant signals until the end of a run."""

    def make(signals, outcome=None):
        ended = outcome or Outcome("finished", 10.0)
        time = np.arange(0.0, ended.time, 0.01)
        values = np.column_stack([np.full(len(time), float(value)) for value, _ in signals.values()])
        origin = Provenance("synthetic", "", "0", {}, "none", "any", 0, {}, ended, ended.time, 1.0)
        data = GroupData(time, tuple(signals), values, tuple(unit for _, unit in signals.values()))
        return Recording.from_groups({"all": data}, origin)

    return make


@pytest.fixture(scope="session")
def server() -> Iterator[str]:
    """The URL of a database on a PostgreSQL server of our own."""
    with postgresql() as url:
        yield url
