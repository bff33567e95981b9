"""A program with other values of named parameters, without lowering the document again."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Final

from neuromech.compiler.program import Program
from neuromech.components.base import Component
from neuromech.spec.follow import followers
from neuromech.spec.model import Uniform
from neuromech.spec.scalars import Written
from neuromech.units import BoundText, measure

_START: Final = "protocol.initial."


def lowered_uses(program: Program, names: frozenset[str]) -> list[str]:
    """Return the paths of a document that follow one of the parameters and that `Rebinding` cannot change.

    Those are values that lowering itself or a rule about values looks at, such as a mass, a component's initial state
    or the rest angle of a joint, and the breakpoints of a parameter that the protocol moves.
    """
    return [path for path in fixed_uses(program, names) if not path.startswith(_START)]


def fixed_uses(program: Program, names: frozenset[str]) -> list[str]:
    """Return the paths of a document that follow one of the parameters and that cannot change during a run.

    Those of `lowered_uses`, and what `protocol.initial` says.
    """
    experiment, followed = program.graph.document.experiment, program.layout.followed - set(_looked_at(program))
    driven = [f"protocol.ramps.{name}" for name, ramp in experiment.protocol.ramps.items() if ramp.parameter in names]
    driven += [
        f"protocol.events.{name}" for name, event in experiment.protocol.events.items() if names & event.set.keys()
    ]
    return driven + [use.path for use in followers(experiment) if use.parameter in names and use.path not in followed]


@dataclass(frozen=True)
class Rebinding:
    """A program in which some parameters can have other values without lowering the document again.

    Args:
        program: from `lower`.
        names: of the parameters.

    Raises:
        ValueError: `lowered_uses` finds something for these parameters, which would keep its value.
    """

    program: Program
    names: frozenset[str]

    def __post_init__(self) -> None:
        uses = lowered_uses(self.program, self.names)
        if uses:
            raise ValueError(f"only lowering can change {', '.join(uses)}")

    def program_with(self, values: Mapping[str, str]) -> Program:
        """Return the program that lowering would give if parameters had other values.

        Args:
            values: name -> value as written. Of the document in the graph only `protocol.initial` takes them over.

        Raises:
            ValueError: a value is of none of the parameters `names`.
        """
        if not values.keys() <= self.names:
            raise ValueError(f"not among the parameters that can change: {sorted(values.keys() - self.names)}")
        parameters = self.program.parameters.copy()
        for name, value in values.items():
            parameters[self.program.layout.bound_to(name)] = measure(value)[0]
        return _started(replace(self.program, parameters=parameters), values)


def _started(program: Program, values: Mapping[str, str]) -> Program:
    """Return a program whose `protocol.initial` has the values of the parameters that it follows."""
    document = program.graph.document
    protocol = document.experiment.protocol
    initial = {name: _start(value, values) for name, value in protocol.initial.items()}
    if initial == protocol.initial:
        return program
    begun = document.experiment.model_copy(update={"protocol": protocol.model_copy(update={"initial": initial})})
    return replace(program, graph=replace(program.graph, document=replace(document, experiment=begun)))


def _start(value: Written | Uniform, values: Mapping[str, str]) -> Written | Uniform:
    if isinstance(value, Uniform):
        low, high = (_followed(end, values) for end in value.uniform)
        return Uniform.model_construct(uniform=(low, high))
    return _followed(value, values)


def _followed(value: Written, values: Mapping[str, str]) -> Written:
    if isinstance(value, BoundText) and value.parameter in values:
        return BoundText(values[value.parameter], value.parameter)
    return value


def _looked_at(program: Program) -> Iterator[str]:
    """Yield the paths of values at time zero, and of rest angles, which must lie in the range of their joint."""
    for element in program.graph.elements():
        if isinstance(element.spec, Component):
            yield from (f"{element.spec_path}.{state.initial}" for state in element.spec.states)
        elif element.family == "joint":
            yield f"{element.path}.rest_angle"
