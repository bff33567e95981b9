"""States at time zero."""

import numpy as np

from neuromech.compiler.numerics import Floats
from neuromech.compiler.program import Program
from neuromech.compiler.wiring import generator
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
        for places in layout.state_places(pattern):
            if isinstance(wanted, Uniform):
                low, high = (quantity(str(end)) for end in wanted.uniform)
                values[places.start : places.stop] = low + share[places.start : places.stop] * (high - low)
            else:
                values[places.start : places.stop] = quantity(str(wanted))
    return values
