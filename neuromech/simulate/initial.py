"""States at time zero."""

import numpy as np

from neuromech.compiler.numerics import Floats
from neuromech.compiler.program import Program
from neuromech.graph.signals import matching
from neuromech.spec.model import Uniform
from neuromech.units import quantity


def initial_states(program: Program, seed: int) -> Floats:
    """Return the states at time zero, shape (states,), SI units.

    Components give their own; `protocol.initial` replaces them by name pattern, a later pattern an earlier one.
    Numbers are drawn state by state in the order of names, so that they do not depend on how a document is arranged.
    """
    random = np.random.default_rng(seed)
    values = program.initial.copy()
    places = program.layout.states
    for pattern, wanted in program.graph.document.experiment.protocol.initial.items():
        for name in matching(pattern, sorted(places)):
            if isinstance(wanted, Uniform):
                low, high = (quantity(str(end)) for end in wanted.uniform)
                values[places[name]] = random.uniform(low, high)
            else:
                values[places[name]] = quantity(str(wanted))
    return values
