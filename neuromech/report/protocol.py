"""What the protocol of a recorded document says: how parameters moved, and when something happened."""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

from ruamel.yaml import YAML

from neuromech.compiler.timeline import course
from neuromech.simulate.recording import Recording
from neuromech.spec.model import Protocol
from neuromech.units import quantity

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


def first_change(recording: Recording) -> tuple[str, float] | None:
    """Return name and time (s) of the first event or ramp of the recorded protocol, None where it has none."""
    protocol = _protocol(recording)
    changes = [(float(event.at), name) for name, event in protocol.events.items()]
    changes += [(float(ramp.start), name) for name, ramp in protocol.ramps.items()]
    return next(((name, time) for time, name in sorted(changes)), None)


def _protocol(recording: Recording) -> Protocol:
    document = YAML(typ="safe").load(recording.provenance.specification) or _NOTHING
    written = document.get("protocol", _NOTHING)
    parts = {name: written[name] for name in ("ramps", "events") if name in written}
    return Protocol.model_validate({"duration": f"{max(recording.outcome.time, 1e-9)} s"} | parts)
