"""What the shipped study of the suspended cat found keeps its claims, and the study judges it as it did."""

from pathlib import Path

import pytest

from neuromech.pipeline import load_document
from neuromech.study.evaluate import Evaluator
from neuromech.study.evaluation import Job

CAT = Path(__file__).parents[3] / "specs" / "cat"


@pytest.mark.slow
def test_the_tuned_cat_swings_its_hip_over_40_degrees_at_the_free_running_period():
    evaluator = Evaluator(CAT / "suspended_tuning.yaml")
    own = evaluator.space.point(evaluator.document)
    tuned = evaluator.space.point(load_document(CAT / "suspended_tuned.yaml"))
    before, after = (
        evaluator(Job(n, 0, n, evaluator.space.parameters(point), evaluator.scenarios.seeds(0)))
        for n, point in enumerate((own, tuned))
    )
    assert before.runs[0].measures["hip_range"] == pytest.approx(0.191, abs=0.005)
    assert after.runs[0].measures["hip_range"] == pytest.approx(0.698, rel=0.02)
    assert after.runs[0].measures["period"] == pytest.approx(0.457, rel=0.01)
    assert after.score > before.score
    assert after.score.value > -0.1
