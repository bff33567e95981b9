"""When a body counts as fallen."""

from dataclasses import dataclass
from math import acos, cos, degrees, inf, pi
from typing import Self

from neuromech.compiler.body_state import BodyState
from neuromech.compiler.ground import Surface
from neuromech.compiler.numerics import Floats
from neuromech.spec.model import Fall


@dataclass(frozen=True)
class FallRule:
    """Limits of the root: lowest height above the ground (m), largest tilt of its z axis from the vertical (rad)."""

    height: float
    tilt: float
    layout: BodyState
    surface: Surface

    @classmethod
    def of(cls, fall: Fall | None, layout: BodyState, surface: Surface) -> Self:
        """Return the rule of a protocol; without one nothing counts as a fall."""
        height = -inf if fall is None or fall.height is None else float(fall.height)
        tilt = inf if fall is None or fall.tilt is None else float(fall.tilt)
        return cls(height, tilt, layout, surface)

    @property
    def least_cosine(self) -> float:
        """Cosine of the largest tilt; below −1 where any tilt will do."""
        return cos(self.tilt) if self.tilt < pi else -2.0

    def broken(self, state: Floats) -> str:
        """Return in words what of the rule the body state breaks, or nothing."""
        start = self.layout.root_pose.start
        height = state[start + 2] - self.surface.height(state[start], state[start + 1])
        if height < self.height:
            return f"the root is {height:.3f} m high, below {self.height:g} m"
        if self.tilt < inf:
            x, y = state[start + 3], state[start + 4]
            tilt = acos(max(-1.0, min(1.0, 1.0 - 2.0 * (x * x + y * y))))
            if tilt > self.tilt:
                return f"the root is tilted by {degrees(tilt):.0f}°, more than {degrees(self.tilt):g}°"
        return ""
