"""Muscles whose force follows from activity, length and velocity of the whole muscle."""

from math import exp, log
from typing import Annotated, ClassVar, Literal

from neuromech.components.base import Muscle, Port, Reference
from neuromech.components.paths import MusclePath
from neuromech.units import DIMENSIONLESS, FORCE, LENGTH, Quantity, quantity


class BrownMuscle(Muscle):
    """Force of a whole muscle from activity, length and velocity, with a passive element of switched stiffness.

    The passive stiffness has one value while the rhythm generator's flexor half is the more active one and another
    while the extensor half is.
    """

    kind: Literal["brown_muscle"] = "brown_muscle"
    source: ClassVar[str] = "Habu 2020 eq. 1–4; Brown, Scott & Loeb 1996, doi:10.1007/BF00115474"
    inputs: ClassVar[tuple[Port, ...]] = (
        Port("activation", ""),
        Port("flexor_activity", ""),
        Port("extensor_activity", ""),
        Port("length", "mm"),
        Port("velocity", "mm/s"),
    )
    outputs: ClassVar[tuple[Port, ...]] = (
        Port("force", "N"),
        Port("stiffness", "N/m"),
        Port("damping", "N s/m"),
        Port("active_force", "N"),
        Port("passive_force", "N"),
    )

    motoneuron: Annotated[str, Reference("neuron", (("activity", "activation"),))]
    flexor: Annotated[str, Reference("neuron", (("activity", "flexor_activity"),))]
    extensor: Annotated[str, Reference("neuron", (("activity", "extensor_activity"),))]
    path: MusclePath

    maximal_force: Annotated[Quantity, FORCE.positive]
    optimal_length: Annotated[Quantity, LENGTH.positive]
    standing_length: Annotated[Quantity, LENGTH.positive]
    passive_stiffness_in_flexion: Annotated[Quantity, DIMENSIONLESS.non_negative]
    passive_stiffness_in_extension: Annotated[Quantity, DIMENSIONLESS.non_negative]
    passive_stiffness_scale: Annotated[Quantity, DIMENSIONLESS.non_negative] = quantity("1")
    passive_scale: Annotated[Quantity, DIMENSIONLESS.within(0.0, 1.0)] = quantity("1")
    activation_gain: Annotated[Quantity, DIMENSIONLESS.non_negative] = quantity("1")

    @staticmethod
    def output(
        activation: float,
        flexor_activity: float,
        extensor_activity: float,
        length: float,
        velocity: float,
        maximal_force: float,
        optimal_length: float,
        standing_length: float,
        passive_stiffness_in_flexion: float,
        passive_stiffness_in_extension: float,
        passive_stiffness_scale: float,
        passive_scale: float,
        activation_gain: float,
    ) -> tuple[float, float, float, float, float]:
        """Return force (N), dF/dl (N/m), dF/dv (N s/m), active and passive force (N).

        Habu 2020 eq. 1–4. Length is normalised by the optimal length, velocity by the standing length, negative
        when the muscle shortens. F_v is cut at zero, which it reaches at about four lengths per second.
        """
        relative = length / optimal_length
        power = exp(2.3 * log(relative))
        deviation = (power - 1.0) / 1.26
        f_length = exp(-deviation * deviation)
        f_length_slope = -2.0 * deviation * f_length * 2.3 * power / (relative * 1.26)
        speed = velocity / standing_length
        if speed < 0.0:
            f_velocity = (-0.69 - 0.17 * speed) / (speed - 0.69)
            f_velocity_slope = (0.17 * 0.69 + 0.69) / ((speed - 0.69) * (speed - 0.69))
            f_velocity_by_length = 0.0
            if f_velocity < 0.0:
                f_velocity = 0.0
                f_velocity_slope = 0.0
        else:
            shape = (-5.34 * relative + 8.41) * relative - 4.7
            f_velocity = (0.18 - shape * speed) / (speed + 0.18)
            f_velocity_slope = -0.18 * (shape + 1.0) / ((speed + 0.18) * (speed + 0.18))
            f_velocity_by_length = -(-10.68 * relative + 8.41) * speed / (speed + 0.18)
        stiffness = passive_stiffness_in_extension
        if flexor_activity > extensor_activity:
            stiffness = passive_stiffness_in_flexion
        stiffness *= passive_stiffness_scale
        exponent = (relative - 1.4) / 0.05
        decay = exp(-abs(exponent))
        wall = max(exponent, 0.0) + log(1.0 + decay)
        wall_slope = (1.0 if exponent > 0.0 else decay) / (1.0 + decay) / 0.05
        compression = 0.02 * exp(-18.7 * (relative - 0.3))
        passive = passive_scale * maximal_force * (stiffness * wall - compression + 0.02)
        passive_slope = passive_scale * maximal_force * (stiffness * wall_slope + 18.7 * compression) / optimal_length
        amplitude = maximal_force * activation_gain * activation
        active = amplitude * f_length * f_velocity
        active_by_length = amplitude * (f_length_slope * f_velocity + f_length * f_velocity_by_length) / optimal_length
        active_by_velocity = amplitude * f_length * f_velocity_slope / standing_length
        return active + passive, active_by_length + passive_slope, active_by_velocity, active, passive
