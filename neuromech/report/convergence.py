"""How a study converged: best and median of each generation."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from neuromech.report.layout import BLUE, GREEN, RED, grid
from neuromech.study.evaluation import Evaluation
from neuromech.study.history import Generation, generations
from neuromech.study.score import Score


def convergence_figure(name: str, evaluations: Sequence[Evaluation], stages: Sequence[str] = ()) -> Figure | None:
    """Return best and median score of each generation, and the share of candidates that fell or failed.

    With stages there is a panel for the stage that the best and the median candidate reached, and the values are those
    within this stage; a line is broken where the stage changes. None without a complete evaluation.

    Args:
        name: of the study.
        evaluations: the complete ones.
        stages: names of the stages of the objective, none where it is a plain sum.
    """
    found = generations(evaluations)
    if not found:
        return None
    rows = 3 if stages else 2
    figure, axes = grid(rows, 1, 5.5, 1.7, sharex=True)
    panels = [row[0] for row in axes]
    panels[0].set_title(name, loc="left")
    _values(panels[0], found)
    if stages:
        _stages(panels[1], found, stages)
    _losses(panels[-1], found)
    panels[-1].set_xlabel("generation")
    return figure


def _values(axes: Axes, found: Sequence[Generation]) -> None:
    axes.plot(*_broken(found, [one.best_so_far for one in found]), color=BLUE, label="best so far")
    axes.plot(*_broken(found, [one.best for one in found]), ".", color=BLUE, label="best of the generation")
    axes.plot(*_broken(found, [one.median for one in found]), color=GREEN, label="median")
    axes.set_ylabel("score")
    axes.legend()


def _broken(found: Sequence[Generation], scores: Sequence[Score | None]) -> tuple[list[float], list[float]]:
    """Return numbers of generations and values, with NaN where a score is missing and between two stages."""
    numbers: list[float] = []
    values: list[float] = []
    before: Score | None = None
    for generation, score in zip(found, scores, strict=True):
        if score is not None and before is not None and score.stage != before.stage:
            numbers.append(generation.number)
            values.append(np.nan)
        numbers.append(generation.number)
        values.append(np.nan if score is None else score.value)
        before = score
    return numbers, values


def _stages(axes: Axes, found: Sequence[Generation], stages: Sequence[str]) -> None:
    numbers = [one.number for one in found]
    for scores, color in (([one.best_so_far for one in found], BLUE), ([one.median for one in found], GREEN)):
        reached = [np.nan if score is None else score.stage for score in scores]
        axes.step(numbers, reached, where="mid", color=color)
    axes.set_yticks(range(len(stages)), stages)
    axes.set_ylim(-0.5, len(stages) - 0.5)
    axes.set_ylabel("stage")


def _losses(axes: Axes, found: Sequence[Generation]) -> None:
    numbers = [one.number for one in found]
    failed = np.array([one.failed / one.evaluations for one in found])
    fell = np.array([one.fell / one.evaluations for one in found])
    axes.plot(numbers, 100.0 * fell, color=GREEN, label="fell")
    axes.plot(numbers, 100.0 * failed, color=RED, label="crashed or diverged")
    axes.set_ylim(-5.0, 105.0)
    axes.set_ylabel("candidates (%)")
    axes.legend()
