"""Points for measured values: shapes, units, and what cannot be measured."""

import math
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from ruamel.yaml import YAML

from neuromech.analyse.measures import MeasuredValue
from neuromech.spec.study import Term
from neuromech.study.terms import JudgedTerm

ANY = {"kind": "final", "signal": "a.b"}
FORMS = (
    {"target": 2, "scale": 0.5},
    {"target": 2, "within": 0.5, "scale": 0.5, "shape": "linear", "worst": -4},
    {"at_least": 1, "at_most": 3, "scale": 2},
    {"at_least": 1, "scale": 2, "shape": "linear", "worst": -3},
    {"goal": "maximize", "scale": 2, "worst": 0, "up_to": 5},
    {"goal": "minimize", "scale": 2, "worst": -7},
    {"goal": "maximize", "scale": 1e-300, "worst": -1e308, "weight": 1e300},
    {"at_most": -1e308, "scale": 1e-300},
    {"goal": "maximize", "shape": "logistic", "center": 1, "scale": 0.1},
    {"goal": "minimize", "shape": "logistic", "center": 1, "scale": 0.1, "weight": 55},
)


def judged(**keys):
    return JudgedTerm.of(Term.model_validate({"measure": ANY, **keys}))


def points(value, **keys):
    return judged(**keys).weighted(value)


@pytest.mark.parametrize(
    ("value", "expected"), [(2.0, 0.0), (2.5, -0.5), (1.5, -0.5), (3.5, -0.75), (1e300, -1.0), ("no rhythm", -1.0)]
)
def test_a_target_counts_a_half_point_less_at_one_scale_and_never_less_than_one(value, expected):
    assert points(value, target=2, scale=0.5) == pytest.approx(expected)


@pytest.mark.parametrize(("value", "expected"), [(2.4, 0.0), (2.5, 0.0), (3.0, -1.0), (9.0, -4.0), ("fell", -4.0)])
def test_a_linear_target_has_a_dead_zone_and_a_floor(value, expected):
    assert points(value, target=2, within=0.5, scale=0.5, shape="linear", worst=-4) == pytest.approx(expected)


@pytest.mark.parametrize(("value", "expected"), [(0.0, -0.5), (1.0, 0.0), (2.0, 0.0), (3.0, 0.0), (5.0, -0.5)])
def test_between_its_bounds_a_term_counts_nothing(value, expected):
    assert points(value, at_least=1, at_most=3, scale="100 %" if value < 1 else 2) == pytest.approx(expected)


@pytest.mark.parametrize(("value", "expected"), [(-3.0, 0.0), (3.0, 1.5), (9.0, 2.5), ("fell", 0.0)])
def test_what_is_to_be_large_counts_up_to_a_cap(value, expected):
    assert points(value, goal="maximize", scale=2, worst=0, up_to=5) == pytest.approx(expected)


def test_what_is_to_be_small_counts_against():
    assert points(6.0, goal="minimize", scale=2, worst=-7, weight=2) == pytest.approx(-6.0)
    assert points("no step", goal="minimize", scale=2, worst=-7, weight=2) == -14.0


def test_units_are_those_of_the_document():
    assert points(math.radians(45.0), target="40 deg", scale="5 deg") == pytest.approx(-0.5)
    assert points(0.467, target="457 ms", within="2 ms", scale="8 ms") == pytest.approx(-0.5)


def test_a_word_is_right_or_wrong():
    assert points("trot", equals="trot", weight=3) == 0.0
    assert points("pace", equals="trot", weight=3) == -3.0


@pytest.mark.parametrize("form", FORMS)
@given(value=st.one_of(st.floats(-1e308, 1e308), st.sampled_from(["no rhythm", "the run ended in a fall at 2 s"])))
def test_every_value_and_every_lack_of_one_has_finite_points_not_below_the_worst(form, value):
    term = judged(**form)
    assert math.isfinite(term.weighted(value))
    assert term.weighted(value) >= term.weighted("could not be taken")


@pytest.mark.parametrize("form", FORMS)
@given(values=st.tuples(st.floats(-100, 100), st.floats(-100, 100)))
def test_closer_to_the_goal_is_never_worse(form, values):
    term = judged(**form)
    if form.get("goal"):
        order = sorted(values, reverse=form["goal"] == "minimize")
    else:
        low = form.get("at_least", form.get("target", -math.inf))
        high = form.get("at_most", form.get("target", math.inf))
        order = sorted(values, key=lambda x: max(low - x, x - high, 0.0), reverse=True)
    assert term.weighted(order[0]) <= term.weighted(order[1]) + 1e-12


def terms_of_page(beginning):
    """Return the terms that stand in docs/studies.md in the block that begins with a comment."""
    page = (Path(__file__).parents[3] / "docs" / "studies.md").read_text("utf-8")
    block = page.partition(f"```yaml\n# {beginning}")[2].partition("\n")[2].partition("```")[0]
    content = YAML(typ="safe").load(block)
    return {name: JudgedTerm.of(Term.model_validate(keys)) for name, keys in content.items()}


def test_fitness_of_habu_2020_equation_15():
    """F = min(t, 50) + 55 (1 - 1 / (1 + exp(-(pitch - 2) / 0.8))), t in s and pitch in deg."""
    terms = terms_of_page("Habu 2020, equation 15")
    for t, degrees in ((3.0, 1.0), (49.0, 2.0), (80.0, 7.5)):
        printed = min(t, 50.0) + 55.0 * (1.0 - 1.0 / (1.0 + math.exp(-(degrees - 2.0) / 0.8)))
        found = terms["time"].weighted(t) + terms["level"].weighted(math.radians(degrees))
        assert found == pytest.approx(printed)


def test_criterion_of_dzeladini_2013_equation_2_58():
    """C = d / E · d."""
    term = terms_of_page("Dzeladini 2013, equation 2.58")["economy"]
    measured = {"measure": MeasuredValue(12.0, "m"), "times": MeasuredValue(12.0, "m")}
    assert term.weighted(term.value(measured | {"per": MeasuredValue(360.0, "J")})) == pytest.approx(
        12.0 / 360.0 * 12.0
    )
    assert term.value(measured | {"per": MeasuredValue(0.0, "J")}) == "divided by zero"
    assert term.value(measured | {"per": MeasuredValue("the run diverged", "J")}) == "the run diverged"
    assert term.value({key: MeasuredValue(1e200, "m") for key in ("measure", "times")}) == "not a finite number"
