"""Shipped studies can be begun; what that of the suspended cat found keeps its claims, and is judged as it was."""

import re
from pathlib import Path

import pytest

from neuromech.pipeline import load_document
from neuromech.study.evaluate import Evaluator
from neuromech.study.evaluation import Job
from neuromech.study.plan import Plan

SPECS = Path(__file__).parents[3] / "specs"
CAT = SPECS / "cat"
STUDIES = [
    file for file in sorted(SPECS.rglob("*.yaml")) if re.search("^study:", file.read_text("utf-8"), re.MULTILINE)
]


@pytest.mark.parametrize("file", STUDIES, ids=lambda file: file.stem)
def test_every_shipped_study_can_be_begun(file: Path):
    evaluator = Evaluator(file)
    assert evaluator.space.dimensions
    assert len(Plan.of(evaluator.document).algorithm().ask()) > 1


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
