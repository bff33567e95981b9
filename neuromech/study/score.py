"""How good one candidate of a study is."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import isfinite


@dataclass(frozen=True, slots=True, order=True)
class Score:
    """What an algorithm sees of a candidate: greater is better, the stage first, then the value.

    A candidate whose runs crashed or diverged has no score (`None`) and counts as worse than every score.

    Args:
        stage: index of the stage that the candidate reached; 0 where the objective has no stages.
        value: the objective's value in this stage; a finite number without unit.

    Raises:
        ValueError: the stage is negative, or the value is not finite.
    """

    stage: int
    value: float

    def __post_init__(self) -> None:
        if self.stage < 0:
            raise ValueError(f"a stage counts from 0, not {self.stage}")
        if not isfinite(self.value):
            raise ValueError(f"a score is a finite number, not {self.value}")


def ranks(scores: Sequence[Score | None]) -> list[int]:
    """Return the rank of each candidate: 0 for the best, equal for equals, the failed ones together at the end."""
    order = sorted({score for score in scores if score is not None}, reverse=True)
    places: dict[Score | None, int] = {score: rank for rank, score in enumerate(order)}
    places[None] = len(order)
    return [places[score] for score in scores]
