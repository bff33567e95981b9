"""How compiled code deals with memory: it allocates none, and no thread writes beside what another one uses."""

from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

# Compiled code allocates nothing, so that references to arrays need not be counted. Each count is an atomic operation,
# and a body step would make some four hundred of them.
NOTHING_COUNTED: Final[dict[str, Any]] = {"_nrt": False}

# Processors fetch cache lines of 64 bytes in pairs.
_LINES: Final = 128


def apart(values: NDArray[Any]) -> NDArray[Any]:
    """Return a copy of an array of 8-byte numbers that shares no cache line with other memory."""
    margin = _LINES // values.itemsize
    room = np.zeros(values.size + 2 * margin, dtype=values.dtype)
    start = -(room.ctypes.data // values.itemsize) % margin
    place = room[start : start + values.size].reshape(values.shape)
    place[...] = values
    return place
