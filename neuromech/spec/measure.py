"""What is measured of a run, and what a measured value must satisfy: words that claims and studies share."""

from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import Field

from neuromech.components.base import SpecModel
from neuromech.spec.scalars import PositiveTime, Written
from neuromech.units import LENGTH, TIME, VELOCITY, Quantity, quantity

MUSCLE_SIGNALS = ("stimulation", "activation", "fibre_length", "fibre_velocity", "active_force", "force")
"""What a muscle must have recorded of it for its energy to be known."""

_OF_PLACES = frozenset({"step_length", "stride_length", "step_length_snr", "step_length_similarity"})
"""Kinds that look at the places of feet."""

_OF_SEGMENTS = {"travel_direction": ("x", "y"), "heading_drift": ("yaw",)}
"""Quantities that kinds look at of a segment, where it is not the one along `axis`."""


class Expected(SpecModel):
    """What a measured value must satisfy: `value` with `within`, or bounds. Text keeps the unit of the measure."""

    value: Written | None = None
    within: Written | None = None
    at_least: Written | None = None
    at_most: Written | None = None
    equals: str | None = None


class ReferenceCurve(SpecModel):
    """Curves over one cycle that signals are compared with, from a table in a file.

    The file is a CSV table with comment lines that start with `#`, a line of column names, and one line per phase. Its
    first column is the phase in percent of the cycle. `columns` are compared with the measure's `signals`, in that
    order; a minus before the name of a column turns it round, where its positive direction is the opposite of the
    signal's. The cycle of the table begins where the foot touches down or lifts off. In the resolved document `phases`
    and `values` (one list for each column) take the place of `file`; an author may write them, too.
    """

    file: str | None = None
    columns: Annotated[tuple[str, ...], Field(min_length=1)]
    begins_at: Literal["touchdown", "liftoff"] = "touchdown"
    phases: tuple[float, ...] = ()
    values: tuple[tuple[float, ...], ...] = ()


class Measure(SpecModel):
    """A measure of `neuromech.analyse` and its arguments.

    `after` and `until` bound the part of the run that is looked at. `level`, `least_amplitude` and `tolerance` are in
    units of the signal; `event` says which instant of a cycle a phase is about. Each of `feet` is a pattern of contacts
    that make up one foot, `segment` the segment whose way is measured, along `axis` of the world. Contacts and gaps
    between contacts that are shorter than `least_duration` do not count. `perturbed_at` is when a run was disturbed.
    `average_over` is how long the stretches are over which something is averaged, `least_speed` how fast a segment must
    be in each of them.
    `muscles` are patterns of muscles whose energy counts, `maintenance` says whose maintenance heat.
    """

    kind: str
    signal: str | None = None
    signals: tuple[str, ...] | None = None
    reference: str | None = None
    after: Annotated[Quantity, TIME.non_negative] = quantity("0 s")
    until: PositiveTime | None = None
    level: Written | None = None
    least_amplitude: Written | None = None
    tolerance: Written | None = None
    event: Literal["onset", "center"] = "onset"
    feet: Annotated[tuple[str, ...] | None, Field(min_length=1)] = None
    segment: str | None = None
    axis: Literal["x", "y", "z"] = "x"
    least_duration: PositiveTime | None = None
    leg_length: Annotated[Quantity, LENGTH.positive] | None = None
    perturbed_at: PositiveTime | None = None
    average_over: PositiveTime | None = None
    least_speed: Annotated[Quantity, VELOCITY.positive] | None = None
    muscles: Annotated[tuple[str, ...] | None, Field(min_length=1)] = None
    maintenance: Literal["wang_2012", "dzeladini_2013"] = "wang_2012"
    curve: ReferenceCurve | None = None

    def patterns(self) -> Iterator[tuple[str, str]]:
        """Yield (key, pattern) of the recorded signals that the measure looks at."""
        for key in ("signal", "reference"):
            if getattr(self, key) is not None:
                yield key, getattr(self, key)
        for index, pattern in enumerate(self.signals or ()):
            yield f"signals.{index}", pattern
        place = (self.axis,) if self.kind in _OF_PLACES else ()
        for index, foot in enumerate(self.feet or ()):
            yield from ((f"feet.{index}", f"{foot}.{quantity}") for quantity in ("force_z", *place))
        if self.segment is not None:
            for quantity in _OF_SEGMENTS.get(self.kind, (self.axis,)):
                yield "segment", f"{self.segment}.{quantity}"
        for index, muscle in enumerate(self.muscles or ()):
            yield from ((f"muscles.{index}", f"{muscle}.{quantity}") for quantity in MUSCLE_SIGNALS)
