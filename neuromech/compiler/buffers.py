"""Flat buffers that are filled section by section, and the header that says where each section starts."""

from collections.abc import Sequence

import numpy as np

from neuromech.compiler.numerics import Floats, Integers


class Buffer:
    """Numbers appended in named sections; the header gets the offset of each."""

    def __init__(self, header: dict[str, int], values: Sequence[float] = ()) -> None:
        self.header = header
        self.values: list[float] = list(values)
        self.sections: set[str] = set()

    def add(self, name: str, values: Sequence[float]) -> int:
        """Append a section and return where it starts."""
        start = len(self.values)
        self.header[name] = start
        self.sections.add(name)
        self.values.extend(values)
        return start

    def floats(self) -> Floats:
        """Return the buffer as floats."""
        return np.array(self.values, dtype=np.float64)

    def integers(self) -> Integers:
        """Return the buffer as integers."""
        return np.array(self.values, dtype=np.int64)


class Reserve:
    """A buffer of which only the size matters before a run."""

    def __init__(self, header: dict[str, int]) -> None:
        self.header = header
        self.size = 0

    def add(self, name: str, count: int) -> int:
        """Reserve a section of `count` numbers and return where it starts."""
        start = self.size
        self.header[name] = start
        self.size += count
        return start
