"""What a recorded document says: how parameters moved, when something happened, which sensors there are."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

import numpy as np
from ruamel.yaml import YAML

from neuromech.analyse.windows import Array
from neuromech.compiler.timeline import course
from neuromech.simulate.recording import Recording
from neuromech.spec.model import Protocol
from neuromech.spec.pushes import PushSeries
from neuromech.units import quantity

_PARTS = ("ramps", "events", "pushes", "push_series")
_NOTHING: Mapping[str, Any] = MappingProxyType({})


@dataclass(frozen=True, slots=True)
class Course:
    """How a parameter moved: straight lines between breakpoints.

    Args:
        times: of the breakpoints (s), from the start of the run.
        values: at the breakpoints, in `unit`.
        unit: as the document writes the parameter, empty for a number.
    """

    times: tuple[float, ...]
    values: tuple[float, ...]
    unit: str


def moving_parameters(recording: Recording) -> dict[str, Course]:
    """Return the parameters that ramps and events of the recorded document move, by name."""
    protocol, written = _protocol(recording), recording.provenance.parameters
    found = {}
    for name, points in course(protocol, written).items():
        unit = str(written[name]).partition(" ")[2]
        factor = float(quantity(f"1 {unit}"))
        times, values = zip(*points, strict=True)
        found[name] = Course(times, tuple(value / factor for value in values), unit)
    return found


def first_disturbance(recording: Recording) -> tuple[str, float] | None:
    """Return name and time (s) of what first disturbs a run, None where its protocol has nothing of the kind.

    That is a push (from when its recorded force acts, else from its `start`), an event or a ramp.
    """
    protocol = _protocol(recording)
    found = [(float(event.at), name) for name, event in protocol.events.items()]
    found += [(float(ramp.start), name) for name, ramp in protocol.ramps.items()]
    starts = {name: float(push.start) for name, push in protocol.pushes.items()}
    starts |= {name: float(series.start) for name, series in protocol.push_series.items()}
    found += [(_first_force(recording, name, start), name) for name, start in starts.items()]
    return next(((name, time) for time, name in sorted(found)), None)


def push_names(recording: Recording) -> set[str]:
    """Return the names of the pushes of the recorded document."""
    protocol = _protocol(recording)
    return {*protocol.pushes, *protocol.push_series}


def push_series(recording: Recording) -> dict[str, PushSeries]:
    """Return the series of pushes of the recorded document, by name."""
    return dict(_protocol(recording).push_series)


def sensor_names(recording: Recording) -> set[str]:
    """Return the names of the sensors of the recorded document."""
    return set(_sensors(YAML(typ="safe").load(recording.provenance.specification) or _NOTHING, ""))


def _sensors(values: Mapping[str, Any], scope: str) -> Iterator[str]:
    yield from (f"{scope}{name}" for name in values.get("sensors") or ())
    for name, instance in (values.get("instances") or {}).items():
        yield from _sensors(instance, f"{scope}{name}.")


def _first_force(recording: Recording, push: str, start: float) -> float:
    """Return when the recorded force of a push begins to act (s), `start` where it was not recorded or never acts."""
    names = [name for name in recording.match(f"{push}.force_*") if recording.signal(name)[1].any()]
    return min((_time_of_first(*recording.signal(name)) for name in names), default=start)


def _time_of_first(time: Array, values: Array) -> float:
    return float(time[np.flatnonzero(values)[0]])


def _protocol(recording: Recording) -> Protocol:
    document = YAML(typ="safe").load(recording.provenance.specification) or _NOTHING
    written = document.get("protocol", _NOTHING)
    parts = {name: written[name] for name in _PARTS if name in written}
    return Protocol.model_validate({"duration": f"{max(recording.outcome.time, 1e-9)} s"} | parts)
