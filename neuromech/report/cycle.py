"""Angles, torques and activations over a cycle: mean and standard deviation over cycles, as in Habu 2020 Fig. 3-5."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from neuromech.analyse.contacts import Footfalls
from neuromech.analyse.cycles import Cycles
from neuromech.report.joints import joint_angles
from neuromech.report.layout import BLUE, RED, NotDrawableError, axis_label, by_scope, grid, rhythm_of, title, trace
from neuromech.report.references import Reference, references
from neuromech.report.steps import feet_if_any, last_cycles, strides_of
from neuromech.simulate.recording import Recording

AVERAGED_CYCLES = 10

_REFERENCE = "reference, shifted to the same mean"


def cycle_figure(recording: Recording) -> Figure:
    """Return the joint angles of each leg over 0 to 100 % of its cycle: the mean of the last ten, and one sd around it.

    A cycle begins at touchdown; of a leg that makes no strides, at the onset of its first rhythmic neuron, or of the
    joint itself. Bars show, mean over cycles, when the foot is loaded; whiskers one standard deviation of their end.
    Curves that a claim compares an angle with are drawn beside it, shifted to the same mean.

    Raises:
        NotDrawableError: no joint angle was recorded, or none is rhythmic.
    """
    return _over_cycle(recording, joint_angles(recording), "no joint angle is recorded")


def torque_figure(recording: Recording) -> Figure:
    """Return the torques at the joints of each leg over its cycle, as `cycle_figure` (Dzeladini 2013 Fig. 3.4).

    Raises:
        NotDrawableError: no torque was recorded, or no leg moves rhythmically.
    """
    return _over_cycle(recording, by_scope(recording, "torque"), "no joint torque is recorded")


def activation_figure(recording: Recording) -> Figure:
    """Return the activations of each leg's muscles over its cycle, as `cycle_figure` (Dzeladini 2013 Fig. 3.5).

    Raises:
        NotDrawableError: no activation was recorded, or no leg moves rhythmically.
    """
    return _over_cycle(recording, by_scope(recording, "activation"), "no activation of a muscle is recorded")


def _over_cycle(recording: Recording, scopes: dict[str, list[str]], lacking: str) -> Figure:
    if not scopes:
        raise NotDrawableError(lacking)
    contacts = feet_if_any(recording)
    found = {scope: _cycles(recording, scope, contacts.get(scope)) for scope in scopes}
    legs = {scope: cycles for scope, cycles in found.items() if cycles is not None}
    if not legs:
        raise NotDrawableError("no leg moves rhythmically")
    rows = max(len(scopes[scope]) for scope in legs)
    compared = references(recording)
    figure, axes = grid(rows, len(legs), 2.1 if len(legs) > 2 else 3.2 if len(legs) > 1 else 4.0, 1.5, sharex=True)
    for column, (scope, (cycles, start)) in enumerate(legs.items()):
        for row in range(rows):
            if row < len(scopes[scope]):
                _panel(axes[row][column], recording, scopes[scope][row], cycles)
                _bar(axes[row][column], contacts.get(scope), cycles)
                _compare(axes[row][column], compared.get(scopes[scope][row]), contacts.get(scope), cycles)
            else:
                axes[row][column].remove()
        axes[0][column].set_title(title(recording, scope), loc="left")
        axes[len(scopes[scope]) - 1][column].set_xlabel(f"% of cycle from\n{start}")
    _legend(figure)
    return figure


def _cycles(recording: Recording, scope: str, foot: Footfalls | None) -> tuple[Cycles, str] | None:
    """Return the last cycles of a leg and the name of their beginning, None where nothing is rhythmic."""
    strides = None if foot is None else strides_of(foot)
    if strides is not None:
        return last_cycles(strides.cycles, AVERAGED_CYCLES), "touchdown"
    names = [name for kind in ("activity", "angle") for name in by_scope(recording, kind).get(scope, [])]
    for name in names:
        cycles = rhythm_of(recording, name)
        if cycles is not None:
            return last_cycles(cycles, AVERAGED_CYCLES), f"onset of {name.split('.')[-2]}"
    return None


def _panel(axes: Axes, recording: Recording, name: str, cycles: Cycles) -> None:
    drawn = trace(recording, name)
    curves = cycles.normalised(drawn.time, drawn.values)
    mean, deviation = curves.mean(axis=0), curves.std(axis=0)
    percent = np.linspace(0.0, 100.0, curves.shape[1])
    axes.fill_between(percent, mean - deviation, mean + deviation, color=BLUE, alpha=0.25, linewidth=0.0)
    axes.plot(percent, mean, color=BLUE)
    axes.set_xlim(0.0, 100.0)
    axes.set_xticks([0, 25, 50, 75, 100])
    axes.set_ylabel(axis_label(drawn.element, drawn.unit))
    axes.margins(y=0.15)


def _compare(axes: Axes, reference: Reference | None, foot: Footfalls | None, cycles: Cycles) -> None:
    strides = None if foot is None else strides_of(foot)
    if reference is None or strides is None:
        return
    percent = np.linspace(0.0, 100.0, 101)
    duty = float(strides.duty_factors[-len(cycles.durations) :].mean())
    angle = reference.at(percent, duty)
    (mean,) = axes.get_lines()[:1]
    shift = float(np.asarray(mean.get_ydata(), dtype=np.float64).mean() - angle.mean())
    axes.plot(percent, angle + shift, color=RED, linestyle="--", linewidth=1.0, label=_REFERENCE)


def _legend(figure: Figure) -> None:
    lines = [line for axes in figure.axes for line in axes.get_lines() if line.get_label() == _REFERENCE]
    if lines:
        figure.legend(handles=lines[:1], loc="outside lower center", frameon=False)


def _bar(axes: Axes, foot: Footfalls | None, cycles: Cycles) -> None:
    strides = None if foot is None else strides_of(foot)
    if strides is None:
        return
    duty = 100.0 * strides.duty_factors[-len(cycles.durations) :]
    transform = axes.get_xaxis_transform()
    mean = float(duty.mean())
    axes.plot([0.0, mean], [0.03, 0.03], color="black", linewidth=3.0, solid_capstyle="butt", transform=transform)
    axes.errorbar(mean, 0.03, xerr=float(duty.std()), color="0.5", capsize=2.0, linewidth=0.8, transform=transform)
