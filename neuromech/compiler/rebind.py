"""A program with other values of named parameters, without lowering the document again."""

from collections.abc import Iterator, Mapping
from dataclasses import replace

from neuromech.compiler.program import Program
from neuromech.components.base import Component
from neuromech.spec.follow import followers


def fixed_uses(program: Program, names: frozenset[str]) -> list[str]:
    """Return the paths of a document that follow one of the parameters and that `rebound` cannot change.

    Those are values that lowering itself or a rule about values looks at, such as a mass, an initial state or the rest
    angle of a joint, and the breakpoints of a parameter that the protocol moves.
    """
    experiment, followed = program.graph.document.experiment, program.layout.followed - set(_looked_at(program))
    driven = [f"protocol.ramps.{name}" for name, ramp in experiment.protocol.ramps.items() if ramp.parameter in names]
    driven += [
        f"protocol.events.{name}" for name, event in experiment.protocol.events.items() if names & event.set.keys()
    ]
    return driven + [use.path for use in followers(experiment) if use.parameter in names and use.path not in followed]


def rebound(program: Program, values: Mapping[str, float]) -> Program:
    """Return the program that lowering would give if parameters had other values.

    Args:
        program: from `lower`; `fixed_uses` finds nothing for these parameters.
        values: name -> SI value. The document in the program's graph keeps the old ones.
    """
    parameters = program.parameters.copy()
    for name, value in values.items():
        parameters[program.layout.bound_to(name)] = value
    return replace(program, parameters=parameters)


def _looked_at(program: Program) -> Iterator[str]:
    """Yield the paths of values at time zero, and of rest angles, which must lie in the range of their joint."""
    for element in program.graph.elements():
        if isinstance(element.spec, Component):
            yield from (f"{element.spec_path}.{state.initial}" for state in element.spec.states)
        elif element.family == "joint":
            yield f"{element.path}.rest_angle"
