"""Gait as the feet show it: footfall diagrams, loads of the legs, and flexor activity against contact."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from neuromech.analyse.contacts import Footfalls, Strides
from neuromech.analyse.cycles import Cycles
from neuromech.analyse.measures import measure
from neuromech.analyse.phases import circular_mean
from neuromech.analyse.windows import Array, NotMeasurableError, View
from neuromech.report.gait import QUADRUPED
from neuromech.report.layout import BLUE, RED, NotDrawableError, grid, recent, trace
from neuromech.report.steps import draw_contacts, feet, foot_patterns, last_cycles, strides_of
from neuromech.simulate.recording import Recording
from neuromech.spec.measure import Measure
from neuromech.units import Quantity

FLEXOR = "RG-F"
_AVERAGED = 10
"""Number of strides that a mean stride is made of."""


def footfall_figure(recording: Recording) -> Figure:
    """Return bars where each foot is loaded: over the last few cycles, and in the mean stride of the first foot.

    Raises:
        NotDrawableError: no foot was recorded, or none ever is loaded.
    """
    found = feet(recording)
    start, end = recent(recording)
    options = {"width_ratios": [2.2, 1.0], "sharey": True}
    figure, axes = grid(1, 2, 4.0, 0.8 + 0.28 * len(found), **options)
    over_time, in_stride = axes[0]
    draw_contacts(over_time, found.items(), BLUE)
    over_time.set_xlim(start, end)
    over_time.set_xlabel("time (s)")
    over_time.set_title("loaded feet", loc="left")
    reference = strides_of(next(iter(found.values())))
    if reference is None:
        in_stride.remove()
        return figure
    _mean_stride(in_stride, found, last_cycles(reference.cycles, _AVERAGED))
    in_stride.set_xlabel(f"stride of {next(iter(found))} (%)")
    in_stride.set_title(_gait(recording, start), loc="left")
    return figure


def load_figure(recording: Recording) -> Figure:
    """Return the vertical force on each foot over the last few cycles, as in Habu 2020 Fig. 3-6; contacts are shaded.

    Raises:
        NotDrawableError: no foot was recorded, or none ever is loaded.
    """
    found = feet(recording)
    start, end = recent(recording)
    figure, axes = grid(len(found), 1, 6.5, 1.15, sharex=True, sharey=True)
    view = View(recording, Measure(kind="duty_factor"))
    for (one,), (leg, foot) in zip(axes, found.items(), strict=True):
        time, load = view.load(foot.name)
        chosen = (time >= start) & (time <= end)
        _shade(one, foot)
        one.plot(time[chosen], load[chosen], color=BLUE)
        one.set_title(leg, loc="left")
        one.set_ylabel("load (N)")
    axes[-1][0].set_xlim(start, end)
    axes[-1][0].set_xlabel("time (s), grey: foot loaded")
    return figure


def flexor_contact_figure(recording: Recording) -> Figure:
    """Return the activity of each leg's flexor half-centre, and red bars where its foot is loaded.

    As in Habu 2020 Fig. 3-2. The title of a panel says during which part of the contacts shown it is active.

    Raises:
        NotDrawableError: no foot was recorded, none ever is loaded, or no leg has a recorded flexor half-centre.
    """
    found = {leg: foot for leg, foot in feet(recording).items() if f"{leg}.{FLEXOR}.activity" in recording.names}
    if not found:
        raise NotDrawableError(f"no activity of {FLEXOR} is recorded in a leg with a foot")
    start, end = recent(recording)
    figure, axes = grid(len(found), 1, 6.5, 1.15, sharex=True, sharey=True)
    for (one,), (leg, foot) in zip(axes, found.items(), strict=True):
        flexor = trace(recording, f"{leg}.{FLEXOR}.activity").between(start, end)
        one.plot(flexor.time, flexor.values, color=BLUE)
        spans = [(first, last - first) for first, last in foot.contacts.tolist()]
        one.broken_barh(spans, (0.02, 0.08), color=RED, linewidth=0.0, transform=one.get_xaxis_transform())
        loaded = foot.loaded(flexor.time)
        one.set_title(f"{leg}: {_overlap(flexor.values[loaded])}", loc="left")
        one.set_ylabel(FLEXOR)
    highest = max(float(one.dataLim.y1) for (one,) in axes) or 1.0
    axes[0][0].set_ylim(-0.18 * highest, 1.1 * highest)
    axes[-1][0].set_xlim(start, end)
    axes[-1][0].set_xlabel("time (s), red: foot loaded")
    return figure


def _overlap(while_loaded: Array) -> str:
    """Return the words for a flexor's activity at those samples at which its foot is loaded."""
    if len(while_loaded) == 0:
        return "never loaded"
    return f"{FLEXOR} active during {100.0 * np.mean(while_loaded > 0.0):.0f} % of contact"


def _shade(axes: Axes, foot: Footfalls) -> None:
    for start, end in foot.contacts.tolist():
        axes.axvspan(start, end, color="0.92", linewidth=0.0, zorder=-1)


def _mean_stride(axes: Axes, found: dict[str, Footfalls], reference: Cycles) -> None:
    """Draw where in the reference's stride each foot is loaded, mean over strides."""
    for row, foot in enumerate(found.values()):
        strides = strides_of(foot)
        touchdown = None if strides is None else _touchdown_phase(strides, reference)
        if strides is None or touchdown is None:
            continue
        duty = float(np.mean(strides.duty_factors[-_AVERAGED:]))
        spans = [(100.0 * (touchdown + turn), 100.0 * duty) for turn in (-1.0, 0.0)]
        axes.broken_barh(spans, (-row - 0.35, 0.7), color=BLUE, linewidth=0.0)
    axes.set_xlim(0.0, 100.0)
    axes.set_xticks([0, 25, 50, 75, 100])


def _touchdown_phase(strides: Strides, reference: Cycles) -> float | None:
    """Return where in the reference's cycle a foot touches down, 0…1, None where it keeps no phase."""
    try:
        return circular_mean(reference.phases(strides.cycles.onsets)[1])
    except NotMeasurableError:
        return None


def _gait(recording: Recording, start: float) -> str:
    patterns = foot_patterns(recording)
    if not set(QUADRUPED) <= set(patterns):
        return "mean stride"
    names = tuple(patterns[leg] for leg in QUADRUPED)
    found = measure(recording, Measure(kind="gait", feet=names, after=Quantity(max(0.0, start - 2.0))))
    return str(found.value)
