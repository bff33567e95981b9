"""The ground of a run: waves become slopes, drawn from the run's seed."""

from collections.abc import Iterator

import numpy as np

from neuromech.compiler.wiring import generator
from neuromech.graph.terrain import FARTHEST
from neuromech.simulate.pushes import length_or_angle
from neuromech.spec.pushes import RandomLength
from neuromech.spec.world import Ground, Slope, Waves
from neuromech.units import Quantity


def drawn_ground(ground: Ground | None, seed: int) -> Ground | None:
    """Return the ground of a run with a seed; a ground without waves is as it was.

    Trapezoids that would reach over the end of the ground are left out.
    """
    if ground is None or ground.waves is None:
        return ground
    end = float((ground.x or FARTHEST[0])[1])
    slopes = [slope for slope in _flanks(ground.waves, generator(seed, "world.ground.waves"), end) if slope.angle]
    return ground.model_copy(update={"slopes": tuple(slopes), "waves": None})


def _flanks(waves: Waves, random: np.random.Generator, end: float) -> Iterator[Slope]:
    start = float(waves.start)
    for number in range(1, waves.number + 1):
        start += _positive(waves.space, random)
        length = _positive(waves.length, random)
        if start + length > end:
            return
        flank = 0.5 * length * (1.0 - float(waves.top))
        angle = float(waves.angle) * min(1.0, number / waves.growing_over)
        yield Slope(start=Quantity(start), length=Quantity(flank), angle=Quantity(angle))
        yield Slope(start=Quantity(start + length - flank), length=Quantity(flank), angle=Quantity(-angle))
        start += length


def _positive(value: RandomLength, random: np.random.Generator) -> float:
    while True:
        length = length_or_angle(value, random)
        if length > 0.0:
            return length
