"""CMA-ES by the library `cmaes`, with ranks for values, and a state that can be stored.

The library's update of a full matrix is active: it also learns from the worse half. It keeps bounds by drawing anew,
and by cutting what is still outside after 100 draws. It sees ranks instead of scores, which is all that CMA-ES uses of
them; so stages and failures need no numbers. Equal scores have equal ranks, and all failed candidates are the last.
Only where it restarts does it look at the scores themselves, to see that they have become the same (`TolFun`).

The separable kind keeps the diagonal of the covariance matrix alone. It has n numbers to learn instead of n² / 2 and
learns them (n + 2) / 3 times as fast, but cannot see that parameters depend on each other. Its update is not active.

Source: Hansen 2016, arXiv:1604.00772. Separable: Ros & Hansen 2008, 10.1007/978-3-540-87700-4_30. Restarts with a
growing population: Auger & Hansen 2005, 10.1109/CEC.2005.1554902.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from importlib import import_module
from typing import Annotated, Any, ClassVar, Final, Literal

import numpy as np
from numpy.random import Generator
from pydantic import Field

from neuromech.errors import MissingExtraError
from neuromech.study.algorithms.base import Floats, Generational, Settings, State
from neuromech.study.score import Score, ranks
from neuromech.units import DIMENSIONLESS, Quantity, quantity

_CHANGING: Final = ("_g", "_mean", "_sigma", "_p_sigma", "_pc", "_funhist_values")
_FULL: Final = "_c_1d"
_DIAGONAL: Final = "_C"
_SAME: Final = 1e-12
"""Scores of a stage that differ less are the same."""


@dataclass(frozen=True, slots=True)
class _Plateau:
    """Lowest and highest score of the latest generations, as long as nothing failed and all were in one stage."""

    stage: int | None = None
    ends: tuple[tuple[float, float], ...] = ()

    def after(self, scores: tuple[Score | None, ...], lookback: int) -> "_Plateau":
        """Return what it is after another generation."""
        values = [score.value for score in scores if score is not None]
        stages = {None if score is None else score.stage for score in scores}
        if None in stages or len(stages) > 1:
            return _Plateau()
        (stage,) = stages
        before = self.ends if stage == self.stage else ()
        return _Plateau(stage, (*before, (min(values), max(values)))[-lookback:])

    def is_flat(self, lookback: int) -> bool:
        """Return whether so many generations had the same scores."""
        lowest, highest = (
            min((low for low, _ in self.ends), default=0.0),
            max((high for _, high in self.ends), default=0.0),
        )
        return len(self.ends) >= lookback and highest - lowest < _SAME


class CmaEsSettings(Settings):
    """Settings of `cma_es`."""

    kind: Literal["cma_es"] = "cma_es"
    population: Annotated[
        int | None, Field(ge=3, strict=True, description="candidates; by default 4 + 3 ln(number of parameters)")
    ] = None
    step: Annotated[Quantity, DIMENSIONLESS.within(0.0, 1.0).positive] = quantity("0.3")
    covariance: Literal["full", "separable"] = "full"
    restarts: Literal["none", "ipop"] = "none"


class CmaEs(Generational):
    """Covariance matrix adaptation; restarts from a random place with twice the population where that is asked for."""

    settings_type: ClassVar[type[Settings]] = CmaEsSettings
    settings: CmaEsSettings
    _plateau: _Plateau

    def first(self, random: Generator) -> Floats:
        """Return the first generation, drawn around the start, or around the middle where there is none.

        Raises:
            MissingExtraError: the library is not installed.
        """
        mean = np.full(self.dimension, 0.5) if self.start is None else self.start
        return self._begin(mean, self.settings.population, random)

    def advance(self, points: Floats, scores: tuple[Score | None, ...], random: Generator) -> Floats:
        """Update the distribution and draw from it.

        Where all candidates failed, or where the search has come to its end and shall not restart, the distribution
        stays as it is.
        """
        if all(score is None for score in scores):
            return self._drawn(random)
        optimizer = self._optimizer()
        optimizer.tell(list(zip(points, map(float, ranks(scores)), strict=True)))
        restarts = self.settings.restarts == "ipop"
        lookback = optimizer.__getstate__()["_funhist_term"]
        self._plateau = self._plateau.after(scores, lookback)
        ended = optimizer.should_stop() or (restarts and self._plateau.is_flat(lookback))
        if ended and restarts:
            return self._begin(random.random(self.dimension), 2 * len(points), random)
        if not ended:
            self._keep(optimizer)
        return self._drawn(random)

    def centers(self) -> Floats:
        """Return the mean of the distribution."""
        mean: Floats = np.clip(np.array([self._known["mean"]]), 0.0, 1.0)
        return mean

    def memory(self) -> State:
        """Return what the library's optimiser knows, without what follows from its settings."""
        return self._known | {"plateau": [self._plateau.stage, [list(pair) for pair in self._plateau.ends]]}

    def remember(self, memory: Mapping[str, Any]) -> None:
        """Take what the library's optimiser knows."""
        self._known = {name: value for name, value in memory.items() if name != "plateau"}
        stage, ends = memory.get("plateau", (None, ()))
        self._plateau = _Plateau(stage, tuple((low, high) for low, high in ends))

    def _begin(self, mean: Floats, population: int | None, random: Generator) -> Floats:
        optimizer = self._new(mean, population)
        # The library allocates its history without values; what memory held by chance must not be stored.
        optimizer.__dict__["_funhist_values"][:] = 0.0
        self._keep(optimizer)
        self._plateau = _Plateau()
        return self._drawn(random)

    @property
    def _is_separable(self) -> bool:
        """Whether the library's separable optimiser searches; with one parameter, where both are one, it has none."""
        return self.settings.covariance == "separable" and self.dimension > 1

    @property
    def _changing(self) -> tuple[str, ...]:
        return (*_CHANGING, _DIAGONAL if self._is_separable else _FULL)

    def _new(self, mean: Floats, population: int | None) -> Any:
        bounds = np.tile([0.0, 1.0], (self.dimension, 1))
        library = load_cmaes()
        kind = library.SepCMA if self._is_separable else library.CMA
        # A copy, because the library moves the mean where it lies.
        return kind(mean.copy(), float(self.settings.step), bounds, population_size=population)

    def _keep(self, optimizer: Any) -> None:
        inside = optimizer.__getstate__()
        self._known = {name.strip("_"): np.asarray(inside[name]).tolist() for name in self._changing}
        self._known["population"] = optimizer.population_size

    def _optimizer(self) -> Any:
        """Return the library's optimiser as it is known: every generation goes on from what could be stored."""
        optimizer = self._new(np.full(self.dimension, 0.5), self._known["population"])
        inside = optimizer.__getstate__()
        for name in self._changing:
            value = self._known[name.strip("_")]
            inside[name] = np.array(value, dtype=np.float64) if isinstance(value, list) else value
        optimizer.__setstate__(inside)
        return optimizer

    def _drawn(self, random: Generator) -> Floats:
        optimizer = self._optimizer()
        optimizer.reseed_rng(int(random.integers(2**32)))
        return np.array([optimizer.ask() for _ in range(optimizer.population_size)])


def load_cmaes() -> Any:
    """Import the package `cmaes`, which is an extra.

    Raises:
        MissingExtraError: it is not installed.
    """
    try:
        return import_module("cmaes")
    except ModuleNotFoundError as error:
        raise MissingExtraError("cmaes", "study") from error
