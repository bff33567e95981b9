"""Scores in words."""

from collections.abc import Sequence

from neuromech.study.evaluation import CENTER, Evaluation
from neuromech.study.score import Score


def evaluation_text(found: Evaluation, stages: Sequence[str]) -> str:
    """Return an evaluation as `evaluation 12, score 0.8123`, and which one it confirms where it confirms one."""
    confirmed = "the center of the search" if found.confirms == CENTER else f"evaluation {found.confirms}"
    words = "" if found.confirms is None else f" (confirms {confirmed})"
    return f"evaluation {found.number}{words}, score {score_text(found.score, stages)}"


def score_text(score: Score | None, stages: Sequence[str]) -> str:
    """Return a score as `0.8123`, with stages as `walk 0.8123`; a failed candidate has none."""
    if score is None:
        return "none"
    return f"{stages[score.stage]} {score.value:.5g}" if stages else f"{score.value:.5g}"
