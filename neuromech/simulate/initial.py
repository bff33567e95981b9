"""States at time zero."""

import numpy as np

from neuromech.compiler.lower_body import muscles
from neuromech.compiler.numerics import Floats
from neuromech.compiler.program import Memory, Program
from neuromech.compiler.wiring import generator
from neuromech.components.base import Muscle
from neuromech.errors import DocumentError
from neuromech.spec.model import Uniform
from neuromech.units import quantity


def initial_states(program: Program, seed: int) -> Floats:
    """Return the states at time zero, shape (states,), SI units.

    Components give their own; `protocol.initial` replaces them by name pattern, a later pattern an earlier one.
    Each state has one random number, drawn in the order of names, and each population draws its own, so that nothing
    depends on how a document is arranged.
    """
    values = program.initial.copy()
    layout = program.layout
    share = np.zeros(len(values))
    names = sorted(layout.states)
    share[[layout.states[name] for name in names]] = np.random.default_rng(seed).random(len(names))
    for name, block in layout.state_blocks.items():
        share[block.start : block.stop] = generator(seed, name).random(len(block))
    for pattern, wanted in program.graph.document.experiment.protocol.initial.items():
        ends = wanted.uniform if isinstance(wanted, Uniform) else (wanted, wanted)
        low, high = (quantity(str(end)) for end in ends)
        for places in layout.state_places(pattern):
            values[places.start : places.stop] = low + share[places.start : places.stop] * (high - low)
    return values


def rest_muscles(program: Program, memory: Memory) -> None:
    """Give muscles the states that depend on their length at time zero, where `protocol.initial` does not set them.

    The state of the body stands in `memory.s` already.

    Raises:
        DocumentError: a muscle cannot be at rest at that length.
    """
    graph, layout = program.graph, program.layout
    program.module.lengths_now(memory.s, memory.p, memory.F, memory.I, memory.T, memory.D)
    initial = graph.document.experiment.protocol.initial
    given = {position for pattern in initial for places in layout.state_places(pattern) for position in places}
    problems = []
    for element in muscles(graph):
        assert isinstance(element.spec, Muscle)
        try:
            found = element.spec.states_at_rest(float(memory.s[layout.signals[f"{element.name}.length"]]))
        except ValueError as error:
            problems.append(graph.document.problem("no-equilibrium", f"{element.path}.tendon_slack_length", str(error)))
            continue
        for state, value in found.items():
            position = layout.states[f"{element.name}.{state}"]
            if position not in given:
                memory.x[position] = value
    if problems:
        raise DocumentError(problems)
