"""The height of the ground below a point, for compiled code."""

from dataclasses import dataclass
from typing import Self

import numpy as np

from neuromech.compiler.numerics import Floats, compiled
from neuromech.graph.terrain import ground_height, terrain
from neuromech.spec.world import Ground

height_below = compiled(ground_height)
"""`ground_height`, compiled: height in m from x, y and the two arrays of a `Surface`."""


@dataclass(frozen=True)
class Surface:
    """The surface of a ground as arrays.

    Args:
        corners: (corners, 2), see `Terrain`.
        steps: (steps, 8), see `Terrain`.
    """

    corners: Floats
    steps: Floats

    @classmethod
    def of(cls, ground: Ground | None) -> Self:
        """Return the surface of a ground; without one, the level from which heights are counted."""
        if ground is None:
            return cls(np.zeros((1, 2)), np.zeros((0, 8)))
        below = terrain(ground)
        return cls(np.array(below.corners), np.array(below.steps).reshape(-1, 8))

    def height(self, x: float, y: float) -> float:
        """Return the height of the ground in m below a point."""
        return float(height_below(x, y, self.corners, self.steps))
