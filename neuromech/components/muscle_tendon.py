"""Muscle and tendon in series, with the length of the muscle fibres as a state.

Forces of the functions below are in units of the maximal isometric force.
"""

from math import exp, log
from typing import Annotated, ClassVar, Literal

from pydantic import Field

from neuromech.components.base import Muscle, Port, Reference, State
from neuromech.components.paths import MusclePath
from neuromech.units import DIMENSIONLESS, FORCE, LENGTH, MASS, RATE, TIME, Quantity, quantity

# Eccentric part of the force–velocity relation: the curvature of the concentric part is multiplied by this.
_ECCENTRIC_CURVATURE = 7.56


def force_length(fibre_length: float, optimal_length: float, width: float, residual_force: float) -> float:
    """Return f_l (Dzeladini 2013 eq. 2.4), with c the logarithm of the force that is left at l_opt (1 ± w)."""
    deviation = abs(fibre_length - optimal_length) / (optimal_length * width)
    return exp(log(residual_force) * deviation * deviation * deviation)


def force_velocity(velocity: float, maximal_velocity: float, curvature: float, eccentric_force: float) -> float:
    """Return f_v (eq. 2.5) of a fibre velocity, negative when the fibre shortens; both velocities in one unit."""
    if velocity < -maximal_velocity:
        return 0.0
    if velocity < 0.0:
        return (maximal_velocity + velocity) / (maximal_velocity - curvature * velocity)
    slope = _ECCENTRIC_CURVATURE * curvature
    share = (velocity - maximal_velocity) / (slope * velocity + maximal_velocity)
    return min(eccentric_force, eccentric_force + (eccentric_force - 1.0) * share)


def velocity_of_force(factor: float, maximal_velocity: float, curvature: float, eccentric_force: float) -> float:
    """Return the fibre velocity (eq. 2.16) at which f_v is `factor`, which is cut to 0 … `eccentric_force` first.

    Beyond `eccentric_force` lies a singularity, at 1.513 for the usual constants.
    """
    f = min(max(factor, 0.0), eccentric_force)
    eccentric = eccentric_force - 1.0 + _ECCENTRIC_CURVATURE * curvature * (eccentric_force - f)
    return maximal_velocity * (f - 1.0) / (1.0 + curvature * f if f < 1.0 else eccentric)


def tendon_force(tendon_length: float, slack_length: float, reference_strain: float) -> float:
    """Return F_se (eq. 2.9): the square of the strain over the reference strain, none while slack."""
    strain = max(0.0, tendon_length / slack_length - 1.0) / reference_strain
    return strain * strain


def buffer_force(fibre_length: float, optimal_length: float, width: float) -> float:
    """Return F_be (eq. 2.11), which keeps a fibre shorter than l_opt (1 − w) from collapsing."""
    shortfall = max(0.0, optimal_length * (1.0 - width) - fibre_length) / (0.5 * optimal_length * width)
    return shortfall * shortfall


def parallel_force(fibre_length: float, optimal_length: float, width: float) -> float:
    """Return F*_pe (eq. 2.12), which a fibre longer than l_opt adds, still to be multiplied by f_v."""
    excess = max(0.0, fibre_length - optimal_length) / (optimal_length * width)
    return excess * excess


def fibre_factor(
    activation: float,
    fibre_length: float,
    length: float,
    optimal_length: float,
    tendon_slack_length: float,
    tendon_reference_strain: float,
    width: float,
    residual_force: float,
    eccentric_force: float,
) -> float:
    """Return f_v at which fibre and tendon balance (eq. 2.15), cut to 0 … `eccentric_force`."""
    pull = tendon_force(length - fibre_length, tendon_slack_length, tendon_reference_strain)
    pull += buffer_force(fibre_length, optimal_length, width)
    able = activation * force_length(fibre_length, optimal_length, width, residual_force)
    able += parallel_force(fibre_length, optimal_length, width)
    if pull >= eccentric_force * able:
        return eccentric_force if pull > 0.0 else 1.0
    return pull / able


class MuscleTendonUnit(Muscle):
    """Contractile element with buffer and parallel elasticity, in series with a tendon.

    The fibre is as fast as the force of the tendon lets it be. Its length and its activation are integrated over each
    body step by themselves: activation exactly with the stimulation held, the fibre by steps of Runge–Kutta of fourth
    order while the path goes on changing its length at the speed it has. The force that acts on the joints is the mean
    over the step. A run starts in equilibrium, no fibre moving.
    """

    kind: Literal["muscle_tendon_unit"] = "muscle_tendon_unit"
    source: ClassVar[str] = "Dzeladini 2013 eq. 2.1–2.30; Geyer, Seyfarth & Blickhan 2003, doi:10.1098/rspb.2003.2454"
    states: ClassVar[tuple[State, ...]] = (
        State("activation", "", "initial_activation"),
        State("fibre_length", "mm", "optimal_length"),
    )
    inputs: ClassVar[tuple[Port, ...]] = (Port("stimulation", ""), Port("length", "mm"), Port("velocity", "mm/s"))
    outputs: ClassVar[tuple[Port, ...]] = (
        Port("force", "N"),
        Port("stiffness", "N/m"),
        Port("damping", "N s/m"),
        Port("active_force", "N"),
        Port("relative_force", ""),
        Port("relative_fibre_length", ""),
        Port("fibre_velocity", "mm/s"),
        Port("mean_force", "N"),
    )
    applied_force: ClassVar[str] = "mean_force"
    advanced_outputs: ClassVar[int] = 1

    motoneuron: Annotated[str, Reference("neuron", (("activity", "stimulation"),))]
    path: MusclePath

    maximal_force: Annotated[Quantity, FORCE.positive]
    optimal_length: Annotated[Quantity, LENGTH.positive]
    tendon_slack_length: Annotated[Quantity, LENGTH.positive]
    maximal_velocity: Annotated[Quantity, RATE.positive]
    width: Annotated[Quantity, DIMENSIONLESS.within(0.05, 1.0)] = quantity("0.56")
    residual_force: Annotated[Quantity, DIMENSIONLESS.within(1e-6, 0.99)] = quantity("0.05")
    velocity_curvature: Annotated[Quantity, DIMENSIONLESS.positive] = quantity("5")
    eccentric_force: Annotated[Quantity, DIMENSIONLESS.within(1.01, 3.0)] = quantity("1.5")
    tendon_reference_strain: Annotated[Quantity, DIMENSIONLESS.positive] = quantity("0.04")
    activation_time_constant: Annotated[Quantity, TIME.positive] = quantity("10 ms")
    initial_activation: Annotated[Quantity, DIMENSIONLESS.within(0.0, 1.0)] = quantity("0.01")
    mass: Annotated[Quantity, MASS.positive, Field(description="of the muscle, for its metabolic energy")] | None = None
    slow_fraction: (
        Annotated[
            Quantity,
            DIMENSIONLESS.within(0.0, 1.0),
            Field(description="part of its fibres that is slow (type I), for its metabolic energy"),
        ]
        | None
    ) = None

    @staticmethod
    def output(
        activation: float,
        fibre_length: float,
        length: float,
        maximal_force: float,
        optimal_length: float,
        tendon_slack_length: float,
        maximal_velocity: float,
        width: float,
        residual_force: float,
        velocity_curvature: float,
        eccentric_force: float,
        tendon_reference_strain: float,
    ) -> tuple[float, float, float, float, float, float, float]:
        """Return force (N), dF/dl (N/m), dF/dv (N s/m), active force (N), force over F_max, fibre length over l_opt,
        and fibre velocity (m/s), negative when the fibre shortens.

        The force is that of the tendon (eq. 2.1), which does not depend on the velocity of the path; its stiffness is
        that with the fibre held. The active force is F_ce of eq. 2.2.
        """  # noqa: D205
        relative = tendon_force(length - fibre_length, tendon_slack_length, tendon_reference_strain)
        strain = max(0.0, (length - fibre_length) / tendon_slack_length - 1.0)
        stiffness = 2.0 * strain * maximal_force / (tendon_reference_strain * tendon_reference_strain)
        sizes = (optimal_length, tendon_slack_length, tendon_reference_strain, width, residual_force, eccentric_force)
        factor = fibre_factor(activation, fibre_length, length, *sizes)
        active = relative + buffer_force(fibre_length, optimal_length, width)
        active -= factor * parallel_force(fibre_length, optimal_length, width)
        velocity = velocity_of_force(factor, maximal_velocity, velocity_curvature, eccentric_force)
        return (
            relative * maximal_force,
            stiffness / tendon_slack_length,
            0.0,
            active * maximal_force,
            relative,
            fibre_length / optimal_length,
            velocity * optimal_length,
        )

    @staticmethod
    def advance(
        activation: float,
        fibre_length: float,
        stimulation: float,
        length: float,
        velocity: float,
        maximal_force: float,
        optimal_length: float,
        tendon_slack_length: float,
        maximal_velocity: float,
        width: float,
        residual_force: float,
        velocity_curvature: float,
        eccentric_force: float,
        tendon_reference_strain: float,
        activation_time_constant: float,
        duration: float,
        elapsed: float,
    ) -> tuple[float, float, float]:
        """Return activation, fibre length (m) and mean force (N, trapezoid rule) of a step; eq. 2.3–2.16, 2.40."""
        half_decay = exp(-0.5 * duration / activation_time_constant)
        middle = stimulation + (activation - stimulation) * half_decay
        end = stimulation + (middle - stimulation) * half_decay
        now = length + elapsed * velocity
        halfway = now + 0.5 * duration * velocity
        then = now + duration * velocity
        sizes = (optimal_length, tendon_slack_length, tendon_reference_strain, width, residual_force, eccentric_force)
        shape = (maximal_velocity, velocity_curvature, eccentric_force)
        k1 = optimal_length * velocity_of_force(fibre_factor(activation, fibre_length, now, *sizes), *shape)
        place = fibre_length + 0.5 * duration * k1
        k2 = optimal_length * velocity_of_force(fibre_factor(middle, place, halfway, *sizes), *shape)
        place = fibre_length + 0.5 * duration * k2
        k3 = optimal_length * velocity_of_force(fibre_factor(middle, place, halfway, *sizes), *shape)
        place = fibre_length + duration * k3
        k4 = optimal_length * velocity_of_force(fibre_factor(end, place, then, *sizes), *shape)
        reached = fibre_length + duration / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
        first = tendon_force(now - fibre_length, tendon_slack_length, tendon_reference_strain)
        last = tendon_force(then - reached, tendon_slack_length, tendon_reference_strain)
        return end, reached, 0.5 * maximal_force * (first + last)

    def states_at_rest(self, length: float) -> dict[str, float]:
        """Return the fibre length (m) at which the fibre, at its first activation, stands still.

        Raises:
            ValueError: the tendon is longer than the path, or the path shorter than the fibre can become.
        """
        slack = float(self.tendon_slack_length)
        if slack >= length:
            raise ValueError(
                f"no equilibrium at the start: the slack tendon alone is longer than the path ({length:g} m)"
            )
        if self._excess(length, length) > 0.0:
            raise ValueError(
                f"no equilibrium at the start: the path ({length:g} m) is shorter than the fibre can become"
            )
        low, high = 0.0, length
        while low < (middle := 0.5 * (low + high)) < high:
            if self._excess(middle, length) > 0.0:
                low = middle
            else:
                high = middle
        return {"fibre_length": high}

    def _excess(self, fibre_length: float, length: float) -> float:
        """Return what pulls the resting fibre longer minus what it holds (eq. 2.2), positive for a short fibre."""
        sizes = float(self.optimal_length), float(self.width)
        held = float(self.initial_activation) * force_length(fibre_length, *sizes, float(self.residual_force))
        held += parallel_force(fibre_length, *sizes)
        slack, strain = float(self.tendon_slack_length), float(self.tendon_reference_strain)
        return tendon_force(length - fibre_length, slack, strain) + buffer_force(fibre_length, *sizes) - held
