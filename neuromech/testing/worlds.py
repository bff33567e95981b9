"""Laws of the ground that every engine with contacts must keep, in the manner of `neuromech.testing.bodies`."""

from math import atan, cos, sin

import numpy as np

from neuromech.graph.terrain import terrain
from neuromech.spec.world import Ground, Slope, Step
from neuromech.testing.bodies import Floats, Opener, run
from neuromech.testing.body_models import BLOCK_MASS, GRAVITY, block_on
from neuromech.units import Quantity

# A law of contact with which both engines solve the same equation.
STIFF = (2e5, 500.0)


def slope(angle: float, friction: float = 1.0) -> Ground:
    """Return ground with a long slope around the origin; the angle is in rad."""
    return Ground(
        slopes=(
            Slope(start=Quantity(-10.0), length=Quantity(20.0), angle=Quantity(angle), friction=Quantity(friction)),
        )
    )


def slope_holds_below_its_angle_of_friction(opener: Opener, step: float, angle: float, bound: float) -> None:
    """A block on a slope with tan θ < μ stays, and the ground bears its whole weight; `bound` is relative to it."""
    with opener(
        block_on(slope(angle), 0.0, 0.0, friction=1.2 * abs(sin(angle) / cos(angle)), angle=angle), step
    ) as body:
        states = run(body, round(1.0 / step))
        forces = states[-1, body.layout.contact_forces].reshape(-1, 3).sum(axis=0) / (BLOCK_MASS * GRAVITY)
        place = states[round(0.2 / step) :, body.layout.root_pose][:, :3]
    assert np.abs(forces - (0.0, 0.0, 1.0)).max() <= bound, forces
    assert np.ptp(place, axis=0).max() < 1e-3, "it slides"


def slope_lets_slide_above_its_angle_of_friction(
    opener: Opener, step: float, angle: float, friction: float, bound: float
) -> None:
    """Where tan θ > μ, a block gains g (sin θ − μ cos θ) downhill; `bound` is relative to g.

    μ is the product of the frictions of block and slope, of which the slope has 0.8.
    """
    ground = slope(angle, 0.8)
    with opener(block_on(ground, 0.0, 0.0, friction / 0.8, angle, *STIFF), step) as body:
        states = run(body, round(1.2 / step))
        velocity = states[:, body.layout.root_velocity][:, :3] @ (cos(angle), 0.0, sin(angle))
    start = round(0.2 / step)
    gain = (velocity[start] - velocity[-1]) / (step * (len(velocity) - 1 - start)) / GRAVITY
    expected = abs(sin(angle)) - friction * cos(angle)
    assert expected > 0.05
    assert abs(gain - np.copysign(expected, angle)) <= bound, (gain, expected)


def step_bears_at_its_height(opener: Opener, step: float, bound: float) -> None:
    """What falls onto a step of 30 mm comes to rest 30 mm higher than beside it; `bound` in m."""
    block_size = {"start": Quantity(-0.3), "length": Quantity(0.6), "width": Quantity(0.5), "height": Quantity(0.03)}
    ground = Ground(steps={"block": Step.model_validate(block_size)})
    beside = Ground(steps={"block": Step.model_validate(block_size | {"start": Quantity(0.5)})})
    heights = [_resting_height(opener, step, one) for one in (ground, beside)]
    assert abs(heights[0] - heights[1] - 0.03) <= bound, heights
    assert terrain(ground).height(0.0, 0.0) == 0.03


def feet_on_one_side_of_a_step_roll_the_body(opener: Opener, step: float, bound: float) -> None:
    """A block with its left feet on a step of 10 mm comes to rest at roll atan(10/120); `bound` in rad."""
    size = {"start": Quantity(-1.0), "length": Quantity(2.0), "width": Quantity(1.0), "height": Quantity(0.01)}
    ground = Ground(steps={"left": Step.model_validate(size | {"middle": Quantity(0.5)})})
    with opener(block_on(ground, 0.0, 0.005), step) as body:
        states = run(body, round(1.5 / step))
        x, _, _, w = states[-1, body.layout.root_pose][3:]
        forces = states[-1, body.layout.contact_forces].reshape(-1, 3)[:, 2]
    assert (forces > 0.1).all(), forces
    assert abs(abs(2.0 * np.arctan2(x, w)) - atan(10.0 / 120.0)) <= bound, 2.0 * np.arctan2(x, w)


def slopes_join_without_a_gap(opener: Opener, step: float) -> None:
    """What slides from a slope onto level ground and up another slope stays on the ground, its speed without jumps."""
    slopes = ((-2.0, 1.0, -0.3), (0.0, 3.0, 0.1))
    ground = Ground(
        friction=Quantity(0.0),
        slopes=tuple(Slope(start=Quantity(a), length=Quantity(b), angle=Quantity(c)) for a, b, c in slopes),
    )
    with opener(block_on(ground, -1.6, 0.0, 1.0, -0.3, *STIFF), step) as body:
        states = run(body, round(2.0 / step))
        pose = states[:, body.layout.root_pose]
    surface = terrain(ground)
    above = np.array([z - surface.height(x, y) for x, y, z in pose[:, :3]])
    assert pose[-1, 0] > 0.5, "it does not get there"
    assert above.min() > 0.03
    assert above.max() < 0.08


def _resting_height(opener: Opener, step: float, ground: Ground) -> float:
    with opener(block_on(ground, 0.0, 0.05), step) as body:
        states = run(body, round(1.0 / step))
        pose: Floats = states[:, body.layout.root_pose]
        assert np.abs(states[-1, body.layout.root_velocity]).max() < 1e-2
    return float(pose[-1, 2])
