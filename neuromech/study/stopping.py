"""When a run is hopeless: its score so far is below the median of earlier generations at the same time of a run."""

import sys
from collections.abc import Iterable
from statistics import median_low

from neuromech.study.evaluation import Evaluation
from neuromech.study.score import Score

LOWEST = Score(0, -sys.float_info.max)
"""No score is lower."""


def thresholds(previous: Iterable[Evaluation]) -> tuple[Score, ...]:
    """Return for each run of a candidate the partial score below which it is ended early; empty where there is none.

    It is the lower median over all candidates of the earlier generations; a run that ended before the time counts as
    worse than all others. Only finished generations are asked, so that it does not matter which candidate of the
    present one is evaluated first, or where.

    Args:
        previous: all evaluations of the generations before.
    """
    rows = [[run.partial or LOWEST for run in one.runs] for one in previous if one.failure is None]
    return tuple(median_low(column) for column in zip(*rows, strict=True))
