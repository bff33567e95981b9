"""Forces on segments for some time, as compiled loops apply them."""

from dataclasses import dataclass

import numpy as np

from neuromech.compiler.numerics import Floats, Integers, exactly

# Columns of `Pushes.numbers`: start, end, force and place; of `Pushes.places`: segment and first signal.
_START, _END, _FORCE, _POINT, _CENTER = 0, 1, 2, 5, 8
COLUMNS = 11
ACTING = 9


@dataclass(frozen=True)
class Pushes:
    """Constant forces on segments, each for a time.

    Args:
        numbers: (pushes, 11) start and end in s, force in N along world axes, the point where it acts and the centre
            of mass of the segment, both in m in the frame of the segment.
        places: (pushes, 2) row of the segment in the tree, and the signal that shows the x component of the force.
    """

    numbers: Floats
    places: Integers


NO_PUSHES = Pushes(np.zeros((0, COLUMNS)), np.zeros((0, 2), dtype=np.int64))


@exactly
def show_pushes(number: int, dt: float, numbers: Floats, places: Integers, s: Floats) -> None:
    """Write the forces of body step `number`, a mean over the step, into their signals."""
    for k in range(places.shape[0]):
        for c in range(3):
            s[places[k, 1] + c] = 0.0
    for k in range(places.shape[0]):
        share = share_of_step(number, dt, numbers[k])
        for c in range(3):
            s[places[k, 1] + c] += share * numbers[k, _FORCE + c]


@exactly
def share_of_step(number: int, dt: float, push: Floats) -> float:
    """Return during which share of body step `number` a push acts, so that its impulse is exact."""
    share: float = max(0.0, min(push[_END], (number + 1) * dt) - max(push[_START], number * dt)) / dt
    return share


@exactly
def acting(share: float, push: Floats, segment: int, rotation: Floats, position: Floats, into: Floats) -> None:
    """Fill what an engine wants to know of a push.

    Args:
        share: of the force that acts.
        push: row of `Pushes.numbers`.
        segment: row of the segment.
        rotation: of all segments; (segments, 3, 3).
        position: of all segments in m; (segments, 3).
        into: filled; (9,) force in N, the point where it acts and the centre of mass of the segment in m, world axes.
    """
    for c in range(3):
        into[c] = share * push[_FORCE + c]
        into[3 + c] = position[segment, c]
        into[6 + c] = position[segment, c]
        for axis in range(3):
            into[3 + c] += rotation[segment, c, axis] * push[_POINT + axis]
            into[6 + c] += rotation[segment, c, axis] * push[_CENTER + axis]
