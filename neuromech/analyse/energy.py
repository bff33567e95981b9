"""What muscles use: metabolic energy after Bhargava, cost of transport."""

from collections.abc import Callable, Mapping
from types import MappingProxyType

import numpy as np

from neuromech.analyse.locomotion import distance
from neuromech.analyse.windows import Array, NotMeasurableError, View
from neuromech.errors import MeasureError
from neuromech.spec.measure import MUSCLE_SIGNALS


def metabolic_energy(view: View) -> float:
    """Return what the `muscles` use in the window (J), ∫ Σ (A + M + S + W) dt by the trapezoidal rule.

    Heat of activation A, of maintenance M and of shortening S, and work W of a muscle of mass m, slow fibre fraction
    t_I (t_II = 1 − t_I), stimulation s, activation a, fibre length l and velocity v (negative when the fibre shortens),
    active force F and total force F_t; Dzeladini 2013 eq. 2.41–2.44, after Bhargava et al. 2004,
    doi:10.1016/S0021-9290(03)00239-2, and Wang et al. 2012, doi:10.1145/2185520.2185521:

    - A = m (40 t_I sin(π s / 2) + 133 t_II (1 − cos(π s / 2)))
    - M = m g(l / l_opt) (74 t_I sin(π a / 2) + 111 t_II (1 − cos(π a / 2)))
    - S = 0.25 F_t max(0, −v)
    - W = F max(0, −v)

    `maintenance` chooses g between half and whole optimal length: l / l_opt (`wang_2012`), or 1 as Dzeladini 2013
    prints (`dzeladini_2013`). Basal heat is not part of it. Also of a run that ended early, up to its end.
    """
    time, power = _power(view)
    return float(np.trapezoid(power, time))


def metabolic_power(view: View) -> float:
    """Return the mean power that the `muscles` use (W): `metabolic_energy` over the duration of the window."""
    time, power = _power(view)
    return float(np.trapezoid(power, time) / (time[-1] - time[0]))


def energy_per_distance(view: View) -> float:
    """Return `metabolic_energy` over the `distance` of `segment` along `axis` (J/m)."""
    way = distance(view)
    if way <= 0.0:
        raise NotMeasurableError(f"{view.spec.segment} does not go forward")
    return metabolic_energy(view) / way


def cost_of_transport(view: View) -> float:
    """Return E / (m g d): `energy_per_distance` over the weight of the body; a plain number."""
    return energy_per_distance(view) / view.weight()


def _length_factor_of_wang(length: Array) -> Array:
    """Return g (Wang et al. 2012): 0.5 up to half the optimal length, then l, then 3 − 2 l, and 0 from 1.5 on."""
    return np.maximum(0.0, np.minimum(np.maximum(0.5, length), 3.0 - 2.0 * length))


def _length_factor_of_dzeladini(length: Array) -> Array:
    """Return g as Dzeladini 2013 eq. 2.43 prints it, with a step from 0.5 to 1 at half the optimal length."""
    return np.where(length <= 0.5, 0.5, np.clip(3.0 - 2.0 * length, 0.0, 1.0))


_LENGTH_FACTORS: Mapping[str, Callable[[Array], Array]] = MappingProxyType(
    {"wang_2012": _length_factor_of_wang, "dzeladini_2013": _length_factor_of_dzeladini}
)


def _power(view: View) -> tuple[Array, Array]:
    """Return times (s) and the power (W) of all muscles, shape (n,) each."""
    first, *others = view.muscles()
    time, total = _power_of(view, first)
    for name in others:
        own_time, power = _power_of(view, name)
        total = total + np.interp(time, own_time, power)
    return time, total


def _power_of(view: View, name: str) -> tuple[Array, Array]:
    """Return times (s) and the power (W) of one muscle, shape (n,) each."""
    windows = [view.window(f"{name}.{quantity}") for quantity in MUSCLE_SIGNALS]
    time = windows[0].time
    stimulation, activation, length, velocity, active, force = (window.at(time) for window in windows)
    mass, slow = _parameter(view, name, "mass"), _parameter(view, name, "slow_fraction")
    heat = _heat(40.0 * slow, 133.0 * (1.0 - slow), stimulation)
    factor = _LENGTH_FACTORS[view.spec.maintenance](length / _parameter(view, name, "optimal_length"))
    heat += factor * _heat(74.0 * slow, 111.0 * (1.0 - slow), activation)
    return time, mass * heat + (0.25 * force + active) * np.maximum(0.0, -velocity)


def _heat(slow: float, fast: float, drive: Array) -> Array:
    """Return the heat rate (W/kg) of slow and fast fibres that are driven by 0…1."""
    angle = 0.5 * np.pi * drive
    return slow * np.sin(angle) + fast * (1.0 - np.cos(angle))


def _parameter(view: View, name: str, parameter: str) -> float:
    """Return a parameter of a muscle."""
    known = view.recording.provenance.anatomy.muscles.get(name, {})
    if parameter not in known:
        raise MeasureError(f"measure '{view.spec.kind}' needs '{parameter}' of muscle {name}")
    return known[parameter]
