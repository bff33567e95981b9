"""Rules between the sections of one document: parameters, protocol, clocks and claims."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, fields
from typing import Self

from neuromech.errors import Problem, did_you_mean
from neuromech.spec.bounds import Bounds, check_parameter, check_value
from neuromech.spec.clocks import time_text, whole_multiple
from neuromech.spec.model import Claim, Experiment, Parameter, Protocol, RecordGroup, Solver
from neuromech.spec.node import join
from neuromech.spec.objective_rules import check_expected, check_objective
from neuromech.spec.study import Study
from neuromech.spec.study_rules import check_study
from neuromech.spec.sweep import Sweep
from neuromech.spec.sweep_rules import check_sweep, sweep_clocks
from neuromech.units import Quantity


@dataclass(frozen=True)
class Sections:
    """The sections that rules look at; None where a section is absent or broken."""

    parameters: Mapping[str, Parameter] | None = None
    protocol: Protocol | None = None
    solver: Solver | None = None
    record: Mapping[str, RecordGroup] | None = None
    study: Study | None = None
    sweeps: Mapping[str, Sweep] | None = None
    claims: Mapping[str, Claim] | None = None
    has_body: bool = False

    @classmethod
    def of(cls, experiment: Experiment) -> Self:
        """Return the sections of a valid document."""
        found = {name: getattr(experiment, name) for name in cls.names()}
        return cls(**found, has_body=experiment.body is not None)

    @classmethod
    def names(cls) -> tuple[str, ...]:
        """Return the keys of the sections in a document."""
        return tuple(field.name for field in fields(cls) if field.name != "has_body")


def check(sections: Sections, asked: frozenset[str]) -> Iterator[Problem]:
    """Yield what is wrong between sections; `asked` are the names that stood in `${…}`."""
    parameters = sections.parameters or {}
    for name, parameter in parameters.items():
        yield from check_parameter(parameter, join("parameters", name))
    if sections.protocol is not None:
        yield from _ramps(sections.protocol, sections.parameters)
        yield from _events(sections.protocol, sections.parameters)
    if sections.protocol is not None and sections.claims is not None and sections.parameters is not None:
        yield from _unused(sections.parameters, asked | _mentioned(sections.protocol, sections.claims))
    yield from _clocks(sections)
    if sections.study is not None:
        yield from check_study(sections.study, sections.parameters)
        yield from _stop_in_time(sections.study, sections.protocol)
        yield from check_objective(sections.study.objective)
    for name, sweep in (sections.sweeps or {}).items():
        yield from check_sweep(name, sweep, sections.parameters, sections.protocol)
    for name, claim in (sections.claims or {}).items():
        yield from check_expected(claim.expected, f"claims.{name}.expected")


def _unused(parameters: Mapping[str, Parameter], used: frozenset[str]) -> Iterator[Problem]:
    for name in parameters:
        if name not in used:
            hint = f"write ${{{name}}} where it acts, or remove it"
            yield Problem("unused-parameter", join("parameters", name), "nothing follows this parameter", None, hint)


def _mentioned(protocol: Protocol, claims: Mapping[str, Claim]) -> frozenset[str]:
    names = {ramp.parameter for ramp in protocol.ramps.values()}
    names |= {name for event in protocol.events.values() for name in event.set}
    paths = [path for claim in claims.values() for path in (*claim.set, *claim.sweep, *claim.compare)]
    names |= {path.split(".")[1] for path in paths if path.startswith("parameters.")}
    return frozenset(names)


def _ramps(protocol: Protocol, parameters: Mapping[str, Parameter] | None) -> Iterator[Problem]:
    for name, ramp in protocol.ramps.items():
        path = f"protocol.ramps.{name}"
        if ramp.end <= ramp.start:
            message = f"must be later than the start, {time_text(ramp.start)}"
            yield Problem("protocol-time", join(path, "end"), message, time_text(ramp.end))
        yield from _in_time(ramp.end, protocol, join(path, "end"))
        if parameters is not None:
            yield from _target(ramp.parameter, ramp.to, parameters, join(path, "parameter"), join(path, "to"))


def _events(protocol: Protocol, parameters: Mapping[str, Parameter] | None) -> Iterator[Problem]:
    for name, event in protocol.events.items():
        path = f"protocol.events.{name}"
        yield from _in_time(event.at, protocol, join(path, "at"))
        if parameters is None:
            continue
        for parameter, value in event.set.items():
            place = f"{path}.set.{parameter}"
            yield from _target(parameter, value, parameters, place, place)


def _in_time(time: float, protocol: Protocol, path: str) -> Iterator[Problem]:
    if time > protocol.duration:
        message = f"is later than the end of the protocol, {time_text(protocol.duration)}"
        yield Problem("protocol-time", path, message, time_text(time))


def _target(
    name: str, value: str | int | float, parameters: Mapping[str, Parameter], name_path: str, value_path: str
) -> Iterator[Problem]:
    if name not in parameters:
        yield Problem("unknown-parameter", name_path, "is no parameter", repr(name), did_you_mean(name, parameters))
        return
    bounds = Bounds.of(parameters[name])
    if bounds is not None:
        yield from check_value(value, bounds, name, value_path)


def _clocks(sections: Sections) -> Iterator[Problem]:
    solver = sections.solver or Solver()
    tick, name = (solver.body_step, "solver.body_step") if sections.has_body else (solver.step, "solver.step")
    found = [
        whole_multiple(solver.body_step, solver.step, "solver.body_step", "solver.step") if sections.has_body else None
    ]
    found += [
        whole_multiple(group.every, tick, f"record.{key}.every", name) for key, group in (sections.record or {}).items()
    ]
    if sections.protocol is not None:
        found.append(whole_multiple(sections.protocol.duration, tick, "protocol.duration", name))
    if sections.study is not None:
        found += _study_clocks(sections.study, tick, name)
    for key, sweep in (sections.sweeps or {}).items():
        found += sweep_clocks(key, sweep, tick, name)
    yield from (problem for problem in found if problem is not None)


def _stop_in_time(study: Study, protocol: Protocol | None) -> Iterator[Problem]:
    end = study.duration or (protocol.duration if protocol else None)
    if study.stop_early is not None and end is not None and study.stop_early.at >= end:
        message = f"must be before the end of a run, {time_text(end)}"
        yield Problem("protocol-time", "study.stop_early.at", message, time_text(study.stop_early.at))


def _study_clocks(study: Study, tick: Quantity, name: str) -> Iterator[Problem | None]:
    if study.duration is not None:
        yield whole_multiple(study.duration, tick, "study.duration", name)
    if study.stop_early is not None:
        yield whole_multiple(study.stop_early.at, tick, "study.stop_early.at", name)
