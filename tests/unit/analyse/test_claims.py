"""Verdicts: what meets an expectation, what does not, and what is no sensible expectation."""

import json
from pathlib import Path

import pytest

from neuromech.analyse.checks import claim_problems
from neuromech.analyse.claims import judge
from neuromech.analyse.measures import MeasuredValue
from neuromech.errors import Mark, MeasureError
from neuromech.spec.document import Document
from neuromech.spec.model import Claim, Experiment


def claim(expected, kind="period", **more):
    fields = {"claim": "c", "source": "s", "measure": {"kind": kind, "signal": "F.activity"}, "expected": expected}
    return Claim.model_validate(fields | more)


def seconds(*values):
    return [MeasuredValue(value, "s") for value in values]


def texts(*values):
    return [MeasuredValue(value, None) for value in values]


def test_a_verdict_has_exactly_the_published_fields():
    verdict = judge("cat", "period", claim({"value": "0.457 s", "within": "1 %"}, published="0.46 s"), [seconds(0.458)])
    assert json.loads(json.dumps(verdict.as_dict())) == {
        "spec": "cat",
        "id": "period",
        "claim": "c",
        "source": "s",
        "published": "0.46 s",
        "expected": "0.457 s ± 1 %",
        "measured": {"median": 0.458, "min": 0.458, "max": 0.458, "n": 1},
        "verdict": "met",
    }


@pytest.mark.parametrize(
    ("expected", "met", "not_met"),
    [
        ({"value": "0.5 s", "within": "10 %"}, 0.5499, 0.5501),
        ({"value": "0.5 s", "within": "20 ms"}, 0.4801, 0.4799),
        ({"at_least": "300 ms"}, 0.3, 0.2999),
        ({"at_most": "300 ms"}, 0.3, 0.3001),
        ({"at_least": "300 ms", "at_most": "400 ms"}, 0.4, 0.41),
    ],
)
def test_bounds_of_numbers(expected, met, not_met):
    assert judge("s", "i", claim(expected), [seconds(met)]).verdict == "met"
    assert judge("s", "i", claim(expected), [seconds(not_met)]).verdict == "not met"


def test_a_relative_tolerance_of_a_negative_value_is_an_interval():
    angle = claim({"value": "-10 deg", "within": "10 %"}, "center")
    assert judge("s", "i", angle, [[MeasuredValue(-0.1745, "rad")]]).verdict == "met"


def test_one_seed_that_fails_makes_it_not_met():
    expected = claim({"at_most": "0.5 s"}, seeds=3)
    verdict = judge("s", "i", expected, [seconds(0.4, 0.6, 0.45)])
    assert verdict.verdict == "not met"
    measured = verdict.measured
    assert (measured.median, measured.min, measured.max, measured.n) == (0.45, 0.4, 0.6, 3)


def test_measured_values_are_shown_in_the_unit_of_the_expectation():
    verdict = judge("s", "i", claim({"at_least": "115 deg"}, "center"), [[MeasuredValue(2.0943951023931953, "rad")]])
    assert verdict.measured.median == pytest.approx(120.0)
    assert verdict.expected == "at least 115 deg"


def test_texts_must_all_be_equal_and_the_most_frequent_is_shown():
    trot = claim({"equals": "trot"}, "gait", seeds=3)
    assert judge("s", "i", trot, [texts("trot", "trot", "trot")]).verdict == "met"
    verdict = judge("s", "i", trot, [texts("trot", "pace", "trot")])
    assert verdict.verdict == "not met"
    assert (verdict.measured.median, verdict.measured.min, verdict.measured.n) == ("trot in 2 of 3", "pace", 3)


@pytest.mark.parametrize("expected", [{"at_most": "1000 s"}, {"at_least": "-1000 s"}])
def test_a_run_that_could_not_be_measured_is_not_met_and_says_why(expected):
    assert judge("s", "i", claim(expected), [seconds("no rhythm")]).measured.median == "no rhythm"
    verdict = judge("s", "i", claim(expected), [seconds(0.4, "no rhythm", 0.5)])
    assert verdict.verdict == "not met"
    assert verdict.measured.median == "no rhythm in 1 of 3"
    assert (verdict.measured.min, verdict.measured.max) == (0.4, 0.5)
    several = judge("s", "i", claim(expected), [seconds("fell at 2 s", 0.4, "fell at 1 s")])
    assert several.measured.median == "no value in 2 of 3, first: fell at 2 s"


def test_a_number_is_never_met_by_a_text_that_looks_equal():
    with pytest.raises(MeasureError, match=r"claims.i.expected  this measure gives a number"):
        judge("s", "i", claim({"equals": "no rhythm"}), [seconds("no rhythm")])


def test_sweeps_judge_successive_differences():
    falling = claim({"at_most": "-1 ms"}, sweep={"parameters.d": [1.5, 2.0, 2.5]})
    verdict = judge("s", "i", falling, [seconds(0.6), seconds(0.5), seconds(0.45)])
    assert verdict.verdict == "met"
    assert verdict.expected == "each step at most -1 ms"
    assert (verdict.measured.min, verdict.measured.max) == (pytest.approx(-100.0), pytest.approx(-50.0))
    assert judge("s", "i", falling, [seconds(0.6), seconds(0.5), seconds(0.51)]).verdict == "not met"
    assert judge("s", "i", falling, [seconds(0.6), seconds("no rhythm"), seconds(0.4)]).verdict == "not met"


def test_a_sweep_over_one_value_shows_nothing():
    with pytest.raises(MeasureError, match="at least two values"):
        judge("s", "i", claim({"at_most": "0 s"}, sweep={"parameters.d": [1.5]}), [seconds(0.6)])


def test_a_swept_text_must_hold_at_every_value():
    trot = claim({"equals": "trot"}, "gait", sweep={"parameters.d": [1.5, 2.0]})
    assert judge("s", "i", trot, [texts("trot"), texts("trot")]).verdict == "met"
    assert judge("s", "i", trot, [texts("trot"), texts("pace")]).verdict == "not met"


def test_comparison_judges_the_ratio_to_the_compared_run():
    faster = claim({"at_most": 0.5}, "settling_time", compare={"parameters.passive": 0})
    verdict = judge("s", "i", faster, [seconds(1.0), seconds(4.0)])
    assert (verdict.verdict, verdict.measured.median, verdict.expected) == ("met", 0.25, "ratio at most 0.5")
    assert judge("s", "i", faster, [seconds(4.0), seconds(1.0)]).verdict == "not met"
    assert judge("s", "i", faster, [seconds(1.0), seconds("not settled")]).verdict == "not met"
    assert judge("s", "i", faster, [seconds(1.0), seconds(0.0)]).measured.median == "the compared value is zero"


@pytest.mark.parametrize(
    ("expected", "message"),
    [
        ({"value": "0.4 N", "within": "1 %"}, r"'value' must be a value in units like s \(got 0.4 N\)"),
        ({"value": 0.4, "within": "1 %"}, r"'value' unit is missing"),
        ({"value": "0.4 s", "within": 0.1}, r"'within' unit is missing"),
        ({"value": "0.4 s"}, "'value' and 'within' go together"),
        ({"within": "1 %", "at_most": "3 s"}, "'value' and 'within' go together"),
        ({}, "must have either"),
        ({"value": "0.4 s", "within": "1 %", "at_most": "1 s"}, "must have either"),
        ({"equals": "fast"}, "gives a number"),
    ],
)
def test_expectations_that_do_not_fit_are_refused(expected, message):
    with pytest.raises(MeasureError, match=message):
        judge("s", "i", claim(expected), [seconds(0.4)])


def test_a_number_cannot_be_expected_of_a_text():
    with pytest.raises(MeasureError, match="gives a text"):
        judge("s", "i", claim({"at_most": 3}, "gait"), [texts("trot")])


def document(claims):
    experiment = Experiment(neuromech=1, name="n", protocol={"duration": "1 s"}, claims=claims)
    marks = {f"claims.{name}": Mark("n.yaml", 3, 5) for name in claims}
    return Document(Path("n.yaml"), experiment, marks, "", (Path("n.yaml"),))


def test_claims_are_checked_before_a_run():
    found = claim_problems(
        document(
            {
                "good": claim({"value": "3 deg", "within": "1 deg"}, "center"),
                "kind": claim({"at_most": "1 s"}, "perod"),
                "argument": claim({"at_most": "1 s"}, "settling_time"),
                "unit": claim({"at_most": "1 N"}),
                "clash": claim({"value": "3 deg", "within": "1 s"}, "center"),
                "text": claim({"at_most": "1"}, "gait", measure={"kind": "gait", "signals": ["A.b"]}),
                "ratio": claim({"at_most": 1}, "rhythm", compare={"a": 1}),
            }
        )
    )
    assert [str(problem) for problem in found] == [
        "n.yaml:3:5  claims.kind.measure  'perod' is not a measure. Hint: did you mean 'period'?",
        "n.yaml:3:5  claims.argument.measure  measure 'settling_time' needs 'tolerance'.",
        "n.yaml:3:5  claims.unit.expected  'at_most' must be a value in units like s (got 1 N).",
        "n.yaml:3:5  claims.clash.expected  'within' must be a value in units like deg (got 1 s).",
        "n.yaml:3:5  claims.text.expected  this measure gives a text. Hint: use 'equals'",
        "n.yaml:3:5  claims.ratio.expected  a measure that gives a text cannot be compared.",
    ]


def test_a_share_of_the_runs_is_enough_where_the_claim_says_so():
    nine, eight = texts(*["finished"] * 9, "fell"), texts(*["finished"] * 8, "fell", "fell")
    lenient = claim({"equals": "finished"}, kind="outcome", share=0.9)
    verdict = judge("cat", "walks", lenient, [nine])
    assert (verdict.verdict, verdict.measured.median) == ("met", "finished in 9 of 10")
    assert verdict.expected == "finished, in 90 % of the runs"
    assert judge("cat", "walks", lenient, [eight]).verdict == "not met"
    assert judge("cat", "walks", claim({"equals": "finished"}, kind="outcome"), [nine]).verdict == "not met"
