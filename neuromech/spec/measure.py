"""What is measured of a run, and what a measured value must satisfy: words that claims and studies share."""

from typing import Annotated, Literal

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
    units of the signal; `event` says which instant of a cycle a phase is about.
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
