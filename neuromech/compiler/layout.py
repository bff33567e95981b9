"""Where every named number of a model lives: the only place of the compiled side that knows names."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from fnmatch import fnmatchcase


@dataclass
class Layout:
    """Names to positions: states in x, signals in s, inputs in u, parameters in p.

    Args:
        states: `<element>.<state>` -> position in x.
        signals: `<element>.<output>` -> position in s, body and path signals included.
        inputs: `<element>.<port>` -> position in u.
        bound: name of a parameter of the document -> positions in p that follow it.
        followed: document paths of the values in `bound`.
        state_count: length of x.
        signal_count: length of s.
    """

    states: dict[str, int] = field(default_factory=dict)
    signals: dict[str, int] = field(default_factory=dict)
    inputs: dict[str, int] = field(default_factory=dict)
    bound: dict[str, list[int]] = field(default_factory=dict)
    followed: set[str] = field(default_factory=set)
    state_count: int = 0
    signal_count: int = 0

    def slot(self, name: str) -> int:
        """Return the recording slot of a signal, state or input: states first, then signals, then inputs.

        Raises:
            KeyError: there is no such name.
        """
        if name in self.states:
            return self.states[name]
        if name in self.signals:
            return self.state_count + self.signals[name]
        return self.state_count + self.signal_count + self.inputs[name]

    def match(self, pattern: str) -> Iterator[str]:
        """Yield the recordable names that match a pattern with * and ?."""
        seen = set()
        for names in (self.states, self.signals, self.inputs):
            for name in names:
                if name not in seen and fnmatchcase(name, pattern):
                    seen.add(name)
                    yield name
