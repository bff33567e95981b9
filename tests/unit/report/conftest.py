"""A synthetic cat: what its four legs would have recorded in twelve seconds of stepping in the air."""

import numpy as np
import pytest

from neuromech.simulate.anatomy import NO_BODY, Anatomy
from neuromech.simulate.recording import GroupData, Outcome, Provenance, Recording

PERIOD = 0.457
LEGS = {"LF": 0.0, "RF": 0.5, "LH": 0.5, "RH": 0.0}
BURSTS = {
    "RG-F": (0.0, 0.27, 0.33),
    "RG-E": (0.29, 0.7, 0.23),
    "PFsw": (0.12, 0.25, 0.2),
    "PFtd": (0.3, 0.2, 0.16),
    "PFst": (0.5, 0.5, 0.23),
    "PFlo": (0.95, 0.2, 0.18),
    "InPFsw": (0.1, 0.2, 0.4),
    "Mn1": (0.0, 0.35, 0.8),
    "Mn2": (0.4, 0.5, 0.6),
    "Mn3": (0.9, 0.3, 0.4),
    "Mn4": (0.25, 0.6, 0.9),
    "Mn5": (0.95, 0.3, 0.5),
    "Mn6": (0.3, 0.3, 0.7),
}
JOINTS = {"hip": (70.0, 18.0, 0.0), "knee": (110.0, 25.0, 0.15), "ankle": (120.0, 20.0, 0.3)}


def bump(phase, onset, duty, height):
    inside = (phase - onset) % 1.0
    return np.where(inside < duty, height * np.abs(np.sin(np.pi * inside / duty)) ** 0.7, 0.0)


def network(time):
    found = {}
    for leg, shift in LEGS.items():
        phase = time / PERIOD - shift
        found |= {f"{leg}.{name}.activity": ("", bump(phase, *burst)) for name, burst in BURSTS.items()}
    return found


def body(time, load):
    found = {"trunk.x": ("m", 0.1 + 0.0 * time), "trunk.z": ("m", 0.5 + 0.0 * time)}
    for leg, shift in LEGS.items():
        phase = time / PERIOD - shift
        for joint, (center, span, lag) in JOINTS.items():
            turn = 2 * np.pi * (phase - lag)
            angle = center + 30.0 * np.exp(-time / 0.8) + span * (np.sin(turn) + 0.3 * np.sin(2 * turn))
            found[f"{leg}.{joint}.angle"] = ("rad", np.deg2rad(angle))
            found[f"{leg}.{joint}.velocity"] = ("rad/s", np.gradient(np.deg2rad(angle), time))
        for number in range(1, 7):
            force = 5.0 + 40.0 * bump(phase, *BURSTS[f"Mn{number}"])
            found[f"{leg}.M{number}.force"] = ("N", force)
            found[f"{leg}.M{number}.velocity"] = ("m/s", 0.0 * time)
        turn = 2 * np.pi * phase
        found[f"{leg}.foot.x"] = ("m", 0.1 - 0.05 * np.cos(turn))
        found[f"{leg}.foot.z"] = ("m", 0.3 + np.maximum(0.0, 0.03 * np.sin(turn + 0.3)))
        found[f"{leg}.foot.force_z"] = ("N", load * bump(phase, 0.45, 0.55, 20.0))
    return found


def group(time, signals):
    values = np.column_stack([values for _, values in signals.values()])
    return GroupData(time, tuple(signals), values, tuple(unit for unit, _ in signals.values()))


def origin(outcome, anatomy=NO_BODY, specification="", parameters=None):
    parameters, end = parameters or {}, outcome.time
    return Provenance(
        "suspended cat", specification, "0", {}, "pybullet", "any", 0, parameters, outcome, end, 24.0, anatomy
    )


@pytest.fixture
def cat():
    """Make the recording of a cat whose feet carry `load` times their usual force."""

    def make(load=0.0, seconds=12.0, outcome=None):
        fine, coarse = np.arange(0.0, seconds, 0.001), np.arange(0.0, seconds, 0.005)
        groups = {"network": group(fine, network(fine)), "body": group(coarse, body(coarse, load))}
        return Recording.from_groups(
            groups, origin(outcome or Outcome("finished", seconds), Anatomy(6.0, 9.81, {}), "body: {}")
        )

    return make


@pytest.fixture
def record():
    """Make a recording from {name: (unit, values)} sampled at 1 kHz."""

    def make(signals, outcome=None, mass=0.0, specification="", parameters=None):
        time = np.arange(len(next(iter(signals.values()))[1])) * 0.001
        source = origin(outcome or Outcome("finished", 1.0), Anatomy(mass, 9.81, {}), specification, parameters)
        return Recording.from_groups({"all": group(time, signals)}, source)

    return make
