"""The `sweeps` section: parameters that are varied systematically, and what is measured."""

from typing import Annotated, Literal

from pydantic import Field

from neuromech.components.base import SpecModel
from neuromech.spec.measure import Measure
from neuromech.spec.scalars import Name, PositiveTime, Written
from neuromech.units import TIME, Quantity, quantity

PositiveCount = Annotated[int, Field(ge=1, strict=True)]


class Varied(SpecModel):
    """The values of one parameter: either `values`, or `count` of them over a `range`, both ends included.

    On the scale `log` equal steps are equal ratios.
    """

    values: Annotated[tuple[Written, ...], Field(description="in the order in which they are tried")] = ()
    range: tuple[Written, Written] | None = None
    count: Annotated[int | None, Field(ge=2, le=10_000, strict=True)] = None
    scale: Literal["linear", "log"] | None = None


class WithinOneRun(SpecModel):
    """Parameters change within a run: each point is held for `every`, and what is measured begins after `settle`.

    The first point is held longer, by `lead_in`.
    """

    every: PositiveTime
    settle: Annotated[Quantity, TIME.non_negative]
    lead_in: Annotated[Quantity, TIME.non_negative] = quantity("0 s")


class Sweep(SpecModel):
    """Runs of the document with changed parameters.

    The `design` says which values are combined: `grid` all with all, `one_at_a_time` each parameter alone, `pairs` all
    values of each two parameters; what is not varied has its own value. All of it is repeated with every combination of
    the values `for_each`, and for as many `seeds`, which count up from the protocol's. `set` changes the document.
    """

    vary: Annotated[dict[str, Varied], Field(min_length=1)]
    design: Literal["grid", "one_at_a_time", "pairs"] = "grid"
    for_each: dict[str, Varied] = {}
    within_one_run: WithinOneRun | None = None
    set: dict[str, Written | bool] = {}
    seeds: PositiveCount = 1
    duration: Annotated[PositiveTime | None, Field(description="of each run; that of the protocol by default")] = None
    measures: Annotated[dict[Name, Measure], Field(min_length=1)]
