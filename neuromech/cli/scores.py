"""Scores in words."""

from collections.abc import Sequence

from neuromech.study.score import Score


def score_text(score: Score | None, stages: Sequence[str]) -> str:
    """Return a score as `0.8123`, with stages as `walk 0.8123`; a failed candidate has none."""
    if score is None:
        return "none"
    return f"{stages[score.stage]} {score.value:.5g}" if stages else f"{score.value:.5g}"
