"""The contract of a search algorithm: ask for a generation of candidates, tell their scores, keep the state.

Candidates are points of the unit cube; what a coordinate means (bounds, a logarithmic scale) is not the algorithm's
business. Greater scores are better. An algorithm is deterministic: settings, dimension, seed, start and the scores told
fix every candidate, and a state that was stored and restored goes on with the same bits.
"""

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from typing import Any, ClassVar, get_args

import numpy as np
from numpy.random import Generator, SeedSequence
from numpy.typing import NDArray

from neuromech.components.base import SpecModel
from neuromech.study.score import Score

Floats = NDArray[np.float64]
State = dict[str, Any]


class Settings(SpecModel):
    """What a document says about an algorithm. A concrete class has a `kind` field with one literal value."""


class Algorithm(ABC):
    """A search in the unit cube, one generation after the other.

    Args:
        settings: what the document says, an object of `settings_type`.
        dimension: number of parameters, at least 1.
        seed: of all random numbers.
        start: the document's own values as a point of the cube, (dimension,); None where there is none.
    """

    settings_type: ClassVar[type[Settings]]

    def __init__(self, settings: Settings, dimension: int, seed: int, start: Floats | None) -> None:
        self.settings = settings
        self.dimension = dimension
        self.seed = seed
        self.start = start

    @classmethod
    def kind_name(cls) -> str:
        """Return the word that a document uses for this algorithm."""
        return str(get_args(cls.settings_type.model_fields["kind"].annotation)[0])

    @abstractmethod
    def ask(self) -> Floats:
        """Return the candidates of this generation, (population, dimension), all in [0, 1]; the same until `tell`.

        The population may differ from one generation to the next.
        """

    @abstractmethod
    def tell(self, scores: Sequence[Score | None]) -> None:
        """Take the score of each candidate, None for a failed one, and go on to the next generation.

        Raises:
            ValueError: there are more or fewer scores than candidates.
        """

    def centers(self) -> Floats:
        """Return where the search stands apart from its candidates, (points, dimension), all in [0, 1]; may be none.

        A study that confirms its best candidates confirms these with them.
        """
        return np.empty((0, self.dimension))

    @abstractmethod
    def state(self) -> State:
        """Return all that the following generations depend on, in types of JSON; floats keep their bits."""

    @abstractmethod
    def restore(self, state: Mapping[str, Any]) -> None:
        """Go on from a state of an algorithm with the same settings, dimension, seed and start."""


class Generational(Algorithm):
    """What the algorithms of this package share: the current candidates, and random numbers of each generation.

    The random numbers of a generation are a stream of their own, fixed by seed and generation. So the generation's
    number is the whole state of the generator.
    """

    def __init__(self, settings: Settings, dimension: int, seed: int, start: Floats | None) -> None:
        """Draw the first generation."""
        super().__init__(settings, dimension, seed, start)
        self._generation = 0
        self._points = self.first(self._stream())

    def ask(self) -> Floats:
        """Return a copy of the current candidates."""
        return self._points.copy()

    def tell(self, scores: Sequence[Score | None]) -> None:
        """Make the next generation.

        Raises:
            ValueError: there are more or fewer scores than candidates.
        """
        if len(scores) != len(self._points):
            raise ValueError(f"{len(self._points)} candidates were asked for, {len(scores)} scores are told")
        self._generation += 1
        self._points = self.advance(self._points, tuple(scores), self._stream())

    def state(self) -> State:
        """Return generation, candidates, and what the algorithm remembers."""
        return {"generation": self._generation, "points": self._points.tolist(), "memory": self.memory()}

    def restore(self, state: Mapping[str, Any]) -> None:
        """Take generation, candidates and memory from a state."""
        self._generation = int(state["generation"])
        self._points = np.array(state["points"], dtype=np.float64)
        self.remember(state["memory"])

    @abstractmethod
    def first(self, random: Generator) -> Floats:
        """Return the candidates of the first generation; sets up what is remembered."""

    @abstractmethod
    def advance(self, points: Floats, scores: tuple[Score | None, ...], random: Generator) -> Floats:
        """Return the candidates that follow these points with these scores."""

    def memory(self) -> State:
        """Return what is remembered beside the candidates, in types of JSON."""
        return {}

    def remember(self, memory: Mapping[str, Any]) -> None:
        """Take what `memory` returned; to be overridden together with it."""

    def _stream(self) -> Generator:
        return np.random.default_rng(SeedSequence(self.seed, spawn_key=(self._generation,)))
