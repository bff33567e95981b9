"""What figures must know about the feet of a recording: their loads, contacts and strides."""

from collections.abc import Iterable

from matplotlib.axes import Axes

from neuromech.analyse.contacts import Footfalls, Strides, footfalls
from neuromech.analyse.cycles import Cycles
from neuromech.analyse.windows import NotMeasurableError, View
from neuromech.errors import MeasureError
from neuromech.report.layout import NotDrawableError, by_scope
from neuromech.report.protocol import push_names
from neuromech.simulate.recording import Recording
from neuromech.spec.measure import Measure

HILDEBRAND_ORDER = ("LH", "LF", "RF", "RH")
"""Order of feet in the gait diagrams of Hildebrand 1965, doi:10.1126/science.150.3697.701."""


def feet(recording: Recording) -> dict[str, Footfalls]:
    """Return the contacts of each foot over the whole run, in Hildebrand's order, by leg.

    All contacts of one leg make up its foot; of a contact outside of legs, itself.

    Raises:
        NotDrawableError: no vertical force was recorded, it is not finite, or no foot ever touches the ground.
    """
    patterns = foot_patterns(recording)
    if not patterns:
        raise NotDrawableError("the vertical force of no foot is recorded")
    legs = sorted(patterns, key=_rank)
    measure = Measure(kind="duty_factor", feet=tuple(patterns[leg] for leg in legs))
    try:
        found = dict(zip(legs, footfalls(View(recording, measure)), strict=True))
    except (NotMeasurableError, MeasureError) as reason:
        raise NotDrawableError(str(reason)) from reason
    if not any(len(foot.contacts) for foot in found.values()):
        raise NotDrawableError("no foot touches the ground")
    return found


def feet_if_any(recording: Recording) -> dict[str, Footfalls]:
    """Return the footfalls of all feet, none where nothing is known of them."""
    try:
        return feet(recording)
    except NotDrawableError:
        return {}


def foot_patterns(recording: Recording) -> dict[str, str]:
    """Return {leg: pattern of the contacts of its foot}; a contact in no scope is a foot of its own."""
    found: dict[str, str] = {}
    pushes = push_names(recording)
    for scope, names in by_scope(recording, "force_z").items():
        contacts = [name.removesuffix(".force_z") for name in names]
        found |= {scope: f"{scope}.*"} if scope else {name: name for name in contacts if name not in pushes}
    return found


def strides_of(foot: Footfalls) -> Strides | None:
    """Return the strides of a foot, None where it makes too few."""
    try:
        return foot.strides()
    except NotMeasurableError:
        return None


def last_cycles(cycles: Cycles, number: int) -> Cycles:
    """Return the last cycles, at most so many."""
    return Cycles(cycles.onsets[-(number + 1) :])


def draw_contacts(axes: Axes, found: Iterable[tuple[str, Footfalls]], color: str) -> None:
    """Draw the contacts of feet as bars, one row per foot from top to bottom."""
    labels = []
    for row, (leg, foot) in enumerate(found):
        spans = [(start, end - start) for start, end in foot.contacts.tolist()]
        axes.broken_barh(spans, (-row - 0.35, 0.7), color=color, linewidth=0.0)
        labels.append(leg)
    axes.set_yticks([-row for row in range(len(labels))], labels)
    axes.tick_params(axis="y", length=0.0)
    axes.set_ylim(-len(labels) + 0.4, 0.6)


def _rank(leg: str) -> int:
    return HILDEBRAND_ORDER.index(leg) if leg in HILDEBRAND_ORDER else len(HILDEBRAND_ORDER)
