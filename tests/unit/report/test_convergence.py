"""The figure of a study's convergence shows what its generations say."""

import numpy as np

from neuromech.report.convergence import convergence_figure
from neuromech.study.evaluation import Evaluation
from neuromech.study.score import Score


def evaluation(number: int, score: Score | None) -> Evaluation:
    return Evaluation(number, number // 2, number % 2, {}, (), score, None if score else "crash", 1.0, 1.0)


def test_best_so_far_never_falls_and_median_is_drawn():
    values = [1.0, 2.0, 0.5, 0.25, 3.0, 2.5]
    figure = convergence_figure("hop", [evaluation(n, Score(0, value)) for n, value in enumerate(values)])
    assert figure is not None
    scores, losses = figure.axes
    assert scores.get_title(loc="left") == "hop"
    so_far, best, median = (line.get_ydata() for line in scores.lines)
    assert list(so_far) == [2.0, 2.0, 3.0]
    assert list(best) == [2.0, 0.5, 3.0]
    assert list(median) == [1.0, 0.25, 2.5]
    assert losses.get_xlabel() == "generation"


def test_lines_break_between_stages_and_failures_are_a_share():
    scores = [Score(0, 5.0), None, Score(1, -9.0), Score(0, 6.0)]
    figure = convergence_figure("hop", [evaluation(n, score) for n, score in enumerate(scores)], ("stand", "walk"))
    assert figure is not None
    values, stages, losses = figure.axes
    np.testing.assert_array_equal(values.lines[0].get_ydata(), [5.0, np.nan, -9.0])
    assert [label.get_text() for label in stages.get_yticklabels()] == ["stand", "walk"]
    assert list(stages.lines[0].get_ydata()) == [0.0, 1.0]
    assert list(losses.lines[1].get_ydata()) == [50.0, 0.0]


def test_there_is_no_figure_without_evaluations():
    assert convergence_figure("hop", []) is None
