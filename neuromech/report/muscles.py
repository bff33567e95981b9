"""Muscle forces over the last few cycles."""

from matplotlib.figure import Figure

from neuromech.report.layout import NotDrawableError, axis_label, by_scope, panels, recent, title, trace
from neuromech.simulate.recording import Recording


def muscle_force_figure(recording: Recording) -> Figure:
    """Return muscle forces, one panel per leg, over the last few cycles.

    Raises:
        NotDrawableError: no muscle force was recorded.
    """
    scopes = by_scope(recording, "force")
    if not scopes:
        raise NotDrawableError("no muscle force is recorded")
    window = recent(recording)
    figure, axes = panels([title(recording, scope) for scope in scopes], 4.6, 2.3, sharex=True)
    for one, names in zip(axes, scopes.values(), strict=True):
        for name in names:
            force = trace(recording, name).between(*window)
            one.plot(force.time, force.values, label=force.element)
        one.set_ylabel(axis_label("force", recording.unit(names[0])))
        one.set_xlabel("time (s)")
        one.set_xlim(*window)
        one.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    return figure
