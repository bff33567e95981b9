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
    Each state has one random number, drawn in the order of names, so that nothing depends on how a document is
    arranged.
    """
    values = program.initial.copy()
    places = program.layout.states
    share = dict(zip(sorted(places), np.random.default_rng(seed).random(len(places)), strict=True))
    for pattern, wanted in program.graph.document.experiment.protocol.initial.items():
        for name in matching(pattern, places):
            if isinstance(wanted, Uniform):
                low, high = (quantity(str(end)) for end in wanted.uniform)
                values[places[name]] = low + share[name] * (high - low)
            else:
                values[places[name]] = quantity(str(wanted))
    return values
