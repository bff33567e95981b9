"""How the root segment of a body tilts."""

from matplotlib.figure import Figure

from neuromech.report.layout import BLUE, RED, NotDrawableError, grid, recent, root_of, trace
from neuromech.report.steps import draw_contacts, feet_if_any
from neuromech.simulate.recording import Recording


def inclination_figure(recording: Recording) -> Figure:
    """Return roll and pitch of the root over the last few cycles, above the contacts of the feet where there are any.

    As in Habu 2020 Fig. 3-7 and 5-1, but pitch is positive nose down, as everywhere here.

    Raises:
        NotDrawableError: roll and pitch of the root were not recorded.
    """
    root = root_of(recording, "roll", "pitch")
    if not root:
        raise NotDrawableError("roll and pitch of the root are not recorded")
    start, end = recent(recording)
    contacts = feet_if_any(recording)
    rows = 2 if contacts else 1
    options = {"height_ratios": [2.2, 1.0]} if contacts else {}
    figure, axes = grid(rows, 1, 6.5, 2.4 / rows + 0.5, sharex=True, **options)
    tilt = axes[0][0]
    for quantity_name, label, color in (("roll", "roll, to the right", BLUE), ("pitch", "pitch, nose down", RED)):
        angle = trace(recording, f"{root}.{quantity_name}").between(start, end)
        tilt.plot(angle.time, angle.values, color=color, label=label)
    tilt.axhline(0.0, color="0.8", linewidth=0.5, zorder=0)
    tilt.set_ylabel(f"{root} (deg)")
    tilt.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=2)
    if contacts:
        draw_contacts(axes[1][0], contacts.items(), BLUE)
        axes[1][0].set_ylabel("loaded feet")
    axes[-1][0].set_xlim(start, end)
    axes[-1][0].set_xlabel("time (s)")
    return figure
