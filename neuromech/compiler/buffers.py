"""Flat buffers that are filled section by section, and the header that says where each section starts."""

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from neuromech.compiler.numerics import Integers


class Buffer:
    """Numbers of one type, appended in named sections; the header gets the offset of each."""

    def __init__(self, header: dict[str, int], dtype: type[np.float64] | type[np.int64]) -> None:
        self.header = header
        self.sections: set[str] = set()
        self.size = 0
        self._dtype = dtype
        self._parts: list[NDArray[Any]] = []

    def add(self, name: str, values: ArrayLike) -> int:
        """Append a section and return where it starts."""
        start = self.size
        self.header[name] = start
        self.sections.add(name)
        self._parts.append(np.asarray(values, dtype=self._dtype))
        self.size += len(self._parts[-1])
        return start

    def array(self, front: int = 0) -> NDArray[Any]:
        """Return the whole buffer behind `front` zeros."""
        return np.concatenate([np.zeros(front, dtype=self._dtype), *self._parts])


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


def halves(values: NDArray[np.int32]) -> Integers:
    """Return 32-bit integers as a section of an integer buffer, two in each number."""
    padded = np.zeros(len(values) + len(values) % 2, dtype=np.int32)
    padded[: len(values)] = values
    return padded.view(np.int64)
