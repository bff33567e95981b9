"""How good a candidate is: a number that orders candidates."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, order=True)
class Score:
    """Greater is better; a later stage is better than any value in an earlier one.

    A candidate whose run crashed or diverged has no score (None), which is worse than every score.

    Args:
        stage: index of the stage that was reached, 0 where there are no stages.
        value: finite.
    """

    stage: int
    value: float
