"""Real-coded genetic algorithm with BLX-α, as thesis A uses it (Habu 2020, section 2.4).

300 individuals; the 2 best are carried over as they are, the others are made by BLX-α from parents chosen by roulette;
every pair crosses (100 %), each locus with 30 %; the hyper-rectangle is expanded 2.0 times, which is α = 0.5. There is
no mutation: the expansion does its work.

What the thesis leaves open is read so:

- Each child has a pair of parents of its own, two different individuals. A locus that does not cross is the first
  parent's. A pair that crosses, crosses in one locus at least.
- A child is drawn from the part of the hyper-rectangle that lies within the bounds.
- The first individuals are drawn uniformly around the document's own values; `spread` says how far.
- Elites are evaluated again with their new generation.
"""

from typing import Annotated, ClassVar, Literal, Self

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray
from pydantic import Field, model_validator
from pydantic_core import PydanticCustomError

from neuromech.study.algorithms.base import Floats, Generational, Settings
from neuromech.study.score import Score, ranks
from neuromech.units import DIMENSIONLESS, Quantity, quantity

_SHARE = DIMENSIONLESS.within(0.0, 1.0)


class RealCodedGaSettings(Settings):
    """Settings of `real_coded_ga`; the defaults are those of thesis A 2.4, which does not print the `spread`."""

    kind: Literal["real_coded_ga"] = "real_coded_ga"
    population: Annotated[int, Field(ge=2, strict=True, description="individuals of a generation")] = 300
    elites: Annotated[int, Field(ge=0, strict=True, description="best individuals that are carried over")] = 2
    crossover_rate: Annotated[Quantity, _SHARE] = quantity("1.0")
    locus_rate: Annotated[Quantity, _SHARE] = quantity("0.3")
    expansion: Annotated[Quantity, DIMENSIONLESS.within(1.0, 100.0)] = quantity("2.0")
    spread: Annotated[Quantity, _SHARE.positive] = quantity("0.25")

    @model_validator(mode="after")
    def _elites_fit(self) -> Self:
        if self.elites >= self.population:
            message = "must be fewer than the individuals of the population"
            context = {"message": message, "got": str(self.elites), "hint": None, "key": "elites"}
            raise PydanticCustomError("too-many-elites", "{message}", context)
        return self

    @property
    def alpha(self) -> float:
        """Return α: the hyper-rectangle of width d becomes (1 + 2 α) d wide."""
        return (float(self.expansion) - 1.0) / 2.0


class RealCodedGa(Generational):
    """Elites, roulette and BLX-α."""

    settings_type: ClassVar[type[Settings]] = RealCodedGaSettings
    settings: RealCodedGaSettings

    def first(self, random: Generator) -> Floats:
        """Return individuals drawn around the start, or anywhere where there is none."""
        return self._around_start(self.settings.population, random)

    def advance(self, points: Floats, scores: tuple[Score | None, ...], random: Generator) -> Floats:
        """Return the elites, best first, and children of parents chosen by roulette.

        Where fewer than two individuals have a score there is no pair, and new ones are drawn as at the beginning.
        """
        scored = [index for index, score in enumerate(scores) if score is not None]
        order = np.argsort(ranks(scores), kind="stable")
        elites = points[order[: min(self.settings.elites, len(scored))]]
        missing = len(points) - len(elites)
        if len(scored) < 2:
            return np.concatenate([elites, self._around_start(missing, random)])
        pairs = roulette_pairs(roulette_weights(scores), np.array(scored), missing, random)
        return np.concatenate([elites, self._children(points[pairs[:, 0]], points[pairs[:, 1]], random)])

    def centers(self) -> Floats:
        """Return the elites of this generation; the first one has none."""
        return self._points[: self.settings.elites if self._generation else 0].copy()

    def _children(self, first: Floats, second: Floats, random: Generator) -> Floats:
        crossing = random.random(len(first)) < self.settings.crossover_rate
        loci = crossing_loci(first.shape, float(self.settings.locus_rate), random)
        drawn = blend(first, second, self.settings.alpha, random)
        return np.where(loci & crossing[:, None], drawn, first)

    def _around_start(self, count: int, random: Generator) -> Floats:
        drawn = random.random((count, self.dimension))
        if self.start is None:
            return drawn
        low = np.maximum(self.start - self.settings.spread, 0.0)
        high = np.minimum(self.start + self.settings.spread, 1.0)
        return np.clip(low + (high - low) * drawn, low, high)


def roulette_weights(scores: tuple[Score | None, ...]) -> Floats:
    """Return the size of each candidate's pocket of the roulette wheel, (population,).

    A failed candidate has none. The others have the value of their score, as long as all are of one stage and none is
    negative, which is how thesis A rates. Where a stage has negative values, all of the stage are raised until the
    lowest is zero. A higher stage begins where the largest pocket of the stage below ends, so that a better score
    never has a smaller pocket. All pockets are divided by the largest magnitude, which leaves the odds as they are.
    """
    weights = np.zeros(len(scores))
    largest = max((abs(score.value) for score in scores if score is not None), default=0.0) or 1.0
    floor = 0.0
    for stage in sorted({score.stage for score in scores if score is not None}):
        members = {
            index: score.value / largest
            for index, score in enumerate(scores)
            if score is not None and score.stage == stage
        }
        lowest = min(0.0, *members.values())
        for index, value in members.items():
            weights[index] = floor + value - lowest
        floor = max(weights[index] for index in members)
    return weights


def roulette_pairs(weights: Floats, eligible: NDArray[np.int64], count: int, random: Generator) -> NDArray[np.int64]:
    """Return pairs of different parents, (count, 2), each parent drawn in proportion to its weight.

    Where nobody left to draw has a weight, all of them are equally likely.
    """
    shares = weights[eligible] if weights.any() else np.ones(len(eligible))
    edges = np.concatenate([[0.0], np.cumsum(shares)])
    first = _pocket(edges, edges[-1] * random.random(count))
    below, above = edges[first], edges[first + 1]
    ball = (below + (edges[-1] - above)) * random.random(count)
    second = _pocket(edges, np.where(ball < below, ball, ball - below + above))
    # Where the first parent had the whole wheel, the second is any of the others.
    alone = below + (edges[-1] - above) <= 0.0
    second[alone] = (first[alone] + random.integers(1, len(eligible), int(alone.sum()))) % len(eligible)
    return np.stack([eligible[first], eligible[second]], axis=1)


def crossing_loci(shape: tuple[int, ...], rate: float, random: Generator) -> NDArray[np.bool_]:
    """Return which loci of each child cross, (children, loci): each with this rate, one in each child at least."""
    loci = random.random(shape) < rate
    certain = random.integers(shape[1], size=shape[0])
    none = ~loci.any(axis=1)
    loci[none, certain[none]] = True
    return loci


def blend(first: Floats, second: Floats, alpha: float, random: Generator) -> Floats:
    """Return what BLX-α draws: uniform in [low - α d, high + α d], as far as it lies in [0, 1]; d = high - low.

    Source: Eshelman & Schaffer 1993, 10.1016/B978-0-08-094832-4.50018-0; thesis A, figure 2-22.
    """
    low, high = np.minimum(first, second), np.maximum(first, second)
    width = high - low
    least, most = np.maximum(low - alpha * width, 0.0), np.minimum(high + alpha * width, 1.0)
    return np.clip(least + (most - least) * random.random(first.shape), least, most)


def _pocket(edges: Floats, ball: Floats) -> NDArray[np.int64]:
    """Return the pocket in which each ball lies, from the edges of all pockets."""
    found = np.searchsorted(edges, ball, side="right") - 1
    return np.minimum(found, int(np.flatnonzero(np.diff(edges))[-1]))
