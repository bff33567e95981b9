"""Where every named number of a model lives: the only place of the compiled side that knows names."""

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np

from neuromech.compiler.numerics import Integers
from neuromech.graph.signals import matching, split


@dataclass
class Layout:
    """Names to positions: states in x, signals in s, inputs in u, parameters in p.

    A recording slot counts through states, signals, inputs, and then the means over populations.

    Args:
        states: `<element>.<state>` -> position in x.
        signals: `<element>.<output>` -> position in s, body and path signals included.
        inputs: `<element>.<port>` -> position in u.
        state_blocks: `<population>.<state>` -> positions in x of all its neurons.
        signal_blocks: `<population>.<output>` -> positions in s.
        input_blocks: `<population>.<port>` -> positions in u.
        bound: name of a parameter of the document -> positions in p that follow it.
        followed: document paths of the values in `bound`.
        state_count: length of x.
        signal_count: length of s.
        input_count: length of u.
    """

    states: dict[str, int] = field(default_factory=dict)
    signals: dict[str, int] = field(default_factory=dict)
    inputs: dict[str, int] = field(default_factory=dict)
    state_blocks: dict[str, range] = field(default_factory=dict)
    signal_blocks: dict[str, range] = field(default_factory=dict)
    input_blocks: dict[str, range] = field(default_factory=dict)
    bound: dict[str, list[range]] = field(default_factory=dict)
    followed: set[str] = field(default_factory=set)
    state_count: int = 0
    signal_count: int = 0
    input_count: int = 0

    def slot(self, name: str) -> int:
        """Return the recording slot of a state, signal or input, or of its mean over a population.

        Raises:
            KeyError: there is no such name.
        """
        element, index, quantity = split(name)
        if index is not None:
            return self._slots()[f"{element}.{quantity}"][index]
        if name in self.states:
            return self.states[name]
        if name in self.signals:
            return self.state_count + self.signals[name]
        if name in self.inputs:
            return self.state_count + self.signal_count + self.inputs[name]
        means = {mean: position for position, mean in enumerate(self._slots())}
        return self.state_count + self.signal_count + self.input_count + means[name]

    def means(self) -> list[range]:
        """Return the slots that each mean is taken over, in the order of the means' own slots."""
        return list(self._slots().values())

    def bound_to(self, parameter: str) -> Integers:
        """Return the positions in p that follow a parameter."""
        pieces = (np.arange(piece.start, piece.stop) for piece in self.bound.get(parameter, ()))
        return np.unique(np.concatenate([np.zeros(0, dtype=np.int64), *pieces]))

    def state_places(self, pattern: str) -> Iterator[range]:
        """Yield the positions in x of what a pattern of `protocol.initial` matches."""
        sizes = {name.rpartition(".")[0]: len(block) for name, block in self.state_blocks.items()}
        for name in matching(pattern, [*self.states, *self.state_blocks], sizes):
            element, index, quantity = split(name)
            if name in self.states:
                yield range(self.states[name], self.states[name] + 1)
            else:
                block = self.state_blocks[f"{element}.{quantity}"]
                yield block if index is None else block[index : index + 1]

    def state_name(self, position: int) -> str:
        """Return the name of the state at a position in x."""
        for name, block in self.state_blocks.items():
            if position in block:
                element, _, quantity = name.rpartition(".")
                return f"{element}[{block.index(position)}].{quantity}"
        return next(name for name, place in self.states.items() if place == position)

    def _slots(self) -> dict[str, range]:
        """Return the slots of all neurons of a population by `<population>.<quantity>`; states go before signals."""
        found: dict[str, range] = {}
        for blocks, shift in (
            (self.state_blocks, 0),
            (self.signal_blocks, self.state_count),
            (self.input_blocks, self.state_count + self.signal_count),
        ):
            for name, block in blocks.items():
                found.setdefault(name, range(block.start + shift, block.stop + shift))
        return found
