"""Memory for samples that later runs use again.

The first use of fresh memory costs more than writing samples into it: every page has to come from the system, and on a
virtual machine from its host. A search makes thousands of runs of one size in a process, which so pay for it once.
"""

import weakref
from typing import Any, Final

import numpy as np

from neuromech.compiler.numerics import Floats

LARGEST_UNUSED: Final = 256 * 2**20
"""Bytes of unused memory that a process keeps at most."""

_unused: dict[int, list[Floats]] = {}


class _Loan:
    """Lives as long as an array looks at the memory."""

    def __init__(self, memory: Floats) -> None:
        self.__array_interface__: dict[str, Any] = memory.__array_interface__


def borrowed(count: int) -> Floats:
    """Return room for `count` numbers, whatever they are; it goes back when no array looks at it any more."""
    try:
        memory = _unused[count].pop()
    except (KeyError, IndexError):
        memory = np.empty(count)
    loan = _Loan(memory)
    weakref.finalize(loan, _give_back, memory).atexit = False
    return np.asarray(loan)


def _give_back(memory: Floats) -> None:
    # May be called at any point of any thread, so that each line leaves a state that all others can work with.
    unused = sum(len(some) * count for count, some in list(_unused.items()))
    if 8 * (unused + len(memory)) > LARGEST_UNUSED:
        _unused.clear()
    if 8 * len(memory) <= LARGEST_UNUSED:
        _unused.setdefault(len(memory), []).append(memory)
