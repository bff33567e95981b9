"""The `study` section: what is tuned, by which algorithm, and how a run is judged."""

from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import Field

from neuromech.components.base import SpecModel
from neuromech.spec.measure import Expected, Measure
from neuromech.spec.scalars import Name, PositiveTime, Seed, Written
from neuromech.units import DIMENSIONLESS, Dimensionless, Quantity, quantity

PositiveCount = Annotated[int, Field(ge=1, strict=True)]
Weight = Annotated[Quantity, DIMENSIONLESS.positive]


class Tuned(SpecModel):
    """How one parameter is tuned. Its bounds are those of the parameter, or `range`, which lies within them.

    On the scale `log` equal steps of the search are equal ratios. The parameters in `also` get the same value, as the
    right side of a body that mirrors the left; with a minus before its name a parameter gets the negative of it, as
    where mirroring changes the sign.
    """

    range: tuple[Written, Written] | None = None
    scale: Literal["linear", "log"] = "linear"
    also: tuple[str, ...] = ()

    @property
    def followers(self) -> tuple[tuple[str, int], ...]:
        """Name and sign of each parameter in `also`."""
        return tuple((one.removeprefix("-"), -1 if one.startswith("-") else 1) for one in self.also)


class Scenario(SpecModel):
    """A changed document in which each candidate is run.

    It is run with as many `seeds` as are drawn anew for each generation, the same for all of its candidates, and with
    the `fixed_seeds` in every generation; with the protocol's own seed where neither is given.
    """

    set: dict[str, Written | bool] = {}
    seeds: Annotated[PositiveCount | None, Field(description="how many, drawn for each generation")] = None
    fixed_seeds: Annotated[tuple[Seed, ...], Field(description="which, in every generation")] = ()
    weight: Weight = quantity("1")


class Term(SpecModel):
    """One thing that counts, as a number of points that is multiplied by `weight`.

    What is judged is `measure`, multiplied by `times` and divided by `per` where they are given. It has a goal: a value
    (`target`, a deviation up to `within` counts nothing), bounds (`at_least`, `at_most`), a direction (`goal`), or a
    word (`equals`).

    `scale` is the difference that counts as one point. `saturating` counts a deviation d as -d / (scale + d), `linear`
    as -d / scale; a direction counts ± value / scale, for `maximize` up to `up_to`; `logistic` counts from 0 to 1
    around `center`; a wrong word counts -1. `worst` are the fewest points that count, also where the measure could not
    be taken; -1 for `saturating` and `equals`, 0 for `logistic`.
    """

    measure: Measure
    times: Measure | None = None
    per: Measure | None = None
    weight: Weight = quantity("1")
    target: Written | None = None
    within: Written | None = None
    at_least: Written | None = None
    at_most: Written | None = None
    goal: Literal["maximize", "minimize"] | None = None
    equals: str | None = None
    scale: Written | None = None
    shape: Literal["saturating", "linear", "logistic"] | None = None
    center: Written | None = None
    up_to: Written | None = None
    worst: Dimensionless | None = None

    @property
    def curve(self) -> Literal["saturating", "linear", "logistic"]:
        """The shape, where none is written `linear` for a direction and `saturating` for all else."""
        return self.shape or ("linear" if self.goal else "saturating")

    @property
    def factors(self) -> dict[str, Measure]:
        """The measures that make up what is judged, by the key they stand under."""
        found = {"measure": self.measure, "times": self.times, "per": self.per}
        return {key: measure for key, measure in found.items() if measure is not None}


class Condition(SpecModel):
    """What every run of a candidate must satisfy to enter a stage."""

    measure: Measure
    expected: Expected


class Stage(SpecModel):
    """A part of a staged objective. A candidate enters it when every run satisfies all conditions under `enter`."""

    enter: dict[Name, Condition] = {}
    terms: Annotated[dict[Name, Term], Field(min_length=1)]


class Objective(SpecModel):
    """A weighted sum of terms, or stages with a sum each: a later stage is better than any score of an earlier one."""

    terms: dict[Name, Term] = {}
    stages: dict[Name, Stage] = {}

    def all_terms(self) -> Iterator[tuple[str, Term]]:
        """Yield (path within the objective, term) of every term, in authored order."""
        yield from ((f"terms.{name}", term) for name, term in self.terms.items())
        for stage, one in self.stages.items():
            yield from ((f"stages.{stage}.terms.{name}", term) for name, term in one.terms.items())

    def all_conditions(self) -> Iterator[tuple[str, Condition]]:
        """Yield (path within the objective, condition) of every entrance condition, in authored order."""
        for stage, one in self.stages.items():
            yield from ((f"stages.{stage}.enter.{name}", condition) for name, condition in one.enter.items())

    def all_measures(self) -> Iterator[tuple[str, Measure]]:
        """Yield (path within the objective, measure) of everything that is measured."""
        for path, term in self.all_terms():
            yield from ((f"{path}.{key}", measure) for key, measure in term.factors.items())
        yield from ((f"{path}.measure", condition.measure) for path, condition in self.all_conditions())


class EarlyStop(SpecModel):
    """A run whose score at a time is below the median of the earlier generations at that time is ended there."""

    at: PositiveTime


class Confirm(SpecModel):
    """After the search, its best `candidates` and its center are run again in every scenario, with fresh `seeds`.

    The seeds are new to all candidates and the same for all of them. The best of these evaluations is the result.
    """

    candidates: Annotated[PositiveCount, Field(description="how many of the best, at most")] = 8
    seeds: Annotated[PositiveCount, Field(description="how many runs in each scenario")] = 10


class Study(SpecModel):
    """A search over parameters of the document. `algorithm` has a `kind` and the settings of that algorithm."""

    tune: Annotated[dict[str, Tuned], Field(min_length=1)]
    algorithm: dict[str, Written | bool]
    evaluations: PositiveCount
    seed: Seed = 0
    duration: Annotated[PositiveTime | None, Field(description="of each run; that of the protocol by default")] = None
    scenarios: dict[Name, Scenario] = {}
    combine: Literal["mean", "worst"] = "mean"
    objective: Objective
    stop_early: EarlyStop | None = None
    confirm: Confirm | None = None
