"""What is measured of a run, and what a measured value must satisfy: words that claims and studies share."""

from typing import Annotated, Literal

from pydantic import Field

from neuromech.components.base import SpecModel
from neuromech.spec.scalars import PositiveTime, Written
from neuromech.units import TIME, Quantity, quantity


class Expected(SpecModel):
    """What a measured value must satisfy: `value` with `within`, or bounds. Text keeps the unit of the measure."""

    value: Written | None = None
    within: Written | None = None
    at_least: Written | None = None
    at_most: Written | None = None
    equals: str | None = None


class Measure(SpecModel):
    """A measure of `neuromech.analyse` and its arguments.

    `after` and `until` bound the part of the run that is looked at. `level`, `least_amplitude` and `tolerance` are in
    units of the signal; `event` says which instant of a cycle a phase is about. Each of `feet` is a pattern of contacts
    that make up one foot, `segment` the segment whose way is measured, along `axis` of the world. Contacts and gaps
    between contacts that are shorter than `least_duration` do not count.
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
