"""The vertical force on each foot over one cycle, in body weights."""

import numpy as np
from matplotlib.figure import Figure

from neuromech.analyse.forces import filtered
from neuromech.analyse.windows import View
from neuromech.report.layout import BLUE, NotDrawableError, panels
from neuromech.report.steps import feet, last_cycles, strides_of
from neuromech.simulate.recording import Recording
from neuromech.spec.measure import Measure

AVERAGED_CYCLES = 10


def vertical_force_figure(recording: Recording) -> Figure:
    """Return the filtered vertical force on each foot from touchdown to touchdown: mean and one sd of the last ten.

    The filter is that of the measure `ground_reaction_peak`. Two humps are a walk, one is a run (Dzeladini 2013,
    figures 3.3 and 3.7).

    Raises:
        NotDrawableError: the body weighs nothing, no foot was recorded, or none makes strides.
    """
    weight = recording.provenance.anatomy.weight
    if weight <= 0.0:
        raise NotDrawableError("the weight of the body is not known")
    strides = {leg: (foot, strides_of(foot)) for leg, foot in feet(recording).items()}
    stepping = {leg: (foot, found) for leg, (foot, found) in strides.items() if found is not None}
    if not stepping:
        raise NotDrawableError("no foot makes strides")
    view = View(recording, Measure(kind="duty_factor"))
    figure, axes = panels(list(stepping), 3.2, 2.0, sharex=True, sharey=True)
    percent = np.linspace(0.0, 100.0, 101)
    for panel, (foot, found) in zip(axes, stepping.values(), strict=True):
        time, load = view.load(foot.name)
        curves = last_cycles(found.cycles, AVERAGED_CYCLES).normalised(time, filtered(time, load) / weight)
        mean, deviation = curves.mean(axis=0), curves.std(axis=0)
        panel.fill_between(percent, mean - deviation, mean + deviation, color=BLUE, alpha=0.25, linewidth=0.0)
        panel.plot(percent, mean, color=BLUE)
        panel.axhline(1.0, color="black", linewidth=0.5)
        panel.set_xlim(0.0, 100.0)
        panel.set_xlabel("% of cycle from touchdown")
        panel.set_ylabel("force / body weight")
    return figure
