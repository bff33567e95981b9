"""From recordings to scores: sums, stages, runs that fell, mean and worst."""

import math

import pytest

from neuromech.simulate.recording import Outcome
from neuromech.spec.study import Study
from neuromech.study.objective import Objective
from neuromech.study.score import Score

FELL = Outcome("fell", 2.0, "the root is too low")


def study(**keys):
    fixed = {"tune": {"x": {}}, "algorithm": {"kind": "pso"}, "evaluations": 1}
    return Study.model_validate(fixed | keys)


def final(signal):
    return {"kind": "final", "signal": signal}


# Stages 0, 2 and 4 of Dzeladini 2013, table 2.8, and the step that lets a gait in.
TABLE_2_8 = {
    "stages": {
        "distance": {
            "terms": {"distance": {"measure": final("trunk.x"), "goal": "maximize", "scale": "1 m", "worst": 0}}
        },
        "speed": {
            "enter": {"far": {"measure": final("trunk.x"), "expected": {"at_least": "34.65 m"}}},
            "terms": {
                "speed": {
                    "measure": final("trunk.v"),
                    "target": "1.3 m/s",
                    "scale": "1 m/s",
                    "shape": "linear",
                    "worst": -10,
                }
            },
        },
        "energy": {
            "enter": {"fast": {"measure": final("trunk.v"), "expected": {"value": "1.3 m/s", "within": "0.05 m/s"}}},
            "terms": {"energy": {"measure": final("trunk.e"), "goal": "minimize", "scale": "1 J", "worst": -1e6}},
        },
    }
}


@pytest.fixture
def walk(record):
    def make(distance, speed, energy, outcome=None):
        signals = {"trunk.x": (distance, "m"), "trunk.v": (speed, "m/s"), "trunk.e": (energy, "J")}
        return record(signals, outcome)

    return make


def about(stage, value):
    return pytest.approx((stage, value))


def pair(found):
    return found.stage, found.value


def score(recordings, combine="mean", weights=None, objective=TABLE_2_8):
    judge = Objective.of(study(objective=objective, combine=combine))
    grades = [judge.grade(recording) for recording in recordings]
    return judge.score(grades, weights or [1 / len(grades)] * len(grades))


def test_stages_of_dzeladini_2013_table_2_8(walk):
    assert score([walk(12, 1.3, 5000)]) == Score(0, 12.0)
    assert pair(score([walk(35, 1.0, 5000)])) == about(1, -0.3)
    assert score([walk(35, 1.32, 5000)]) == Score(2, -5000.0)


def test_a_later_stage_is_better_than_any_value_of_an_earlier_one(walk):
    assert score([walk(35, 9.0, 9e5)]) > score([walk(34.6, 1.3, 1)])


def test_a_stage_is_reached_only_by_way_of_those_before(walk):
    """What satisfies the condition of the last stage alone stays in the first."""
    assert score([walk(1, 1.3, 5000)]).stage == 0


def test_every_run_must_satisfy_the_conditions(walk):
    assert pair(score([walk(35, 1.3, 1000), walk(35, 1.1, 1000)])) == about(1, -0.1)


def test_a_run_that_fell_gets_the_worst_points_of_what_it_cannot_show(walk):
    judge = Objective.of(study(objective=TABLE_2_8))
    grade = judge.grade(walk(35, 1.3, 100, FELL))
    assert grade.measures["speed.speed"] == "the run ended in a fall at 2 s"
    assert grade.points == {"distance.distance": 0.0, "speed.speed": -10.0, "energy.energy": -1e6}
    assert grade.entered == (True, False, False)


def test_runs_that_fell_are_told_apart_by_the_time_they_lived(record):
    terms = {
        "alive": {"measure": {"kind": "time_alive"}, "goal": "maximize", "scale": "1 s", "worst": 0},
        "level": {"measure": final("a.b"), "target": 1, "scale": 1},
    }
    runs = [record({"a.b": (1, "")}, Outcome(kind, time)) for kind, time in (("fell", 1.0), ("fell", 2.0))]
    values = [score([run], objective={"terms": terms}) for run in runs]
    assert values == [Score(0, 0.0), Score(0, 1.0)]
    assert score([record({"a.b": (1, "")})], objective={"terms": terms}) == Score(0, 10.0)


def test_mean_and_worst_of_runs(walk):
    runs = [walk(10, 1, 1), walk(20, 1, 1), walk(30, 1, 1)]
    assert pair(score(runs)) == about(0, 20.0)
    assert score(runs, "worst") == Score(0, 10.0)
    assert pair(score(runs, weights=[0.5, 0.25, 0.25])) == about(0, 17.5)


def test_a_condition_can_ask_for_a_word(record):
    stages = {
        "any": {"terms": {"alive": {"measure": {"kind": "time_alive"}, "at_least": "10 s", "scale": "1 s"}}},
        "whole": {
            "enter": {"finished": {"measure": {"kind": "outcome"}, "expected": {"equals": "finished"}}},
            "terms": {"level": {"measure": final("a.b"), "target": 2, "scale": 1}},
        },
    }
    whole, fallen = record({"a.b": (1, "")}), record({"a.b": (1, "")}, FELL)
    assert score([whole], objective={"stages": stages}) == Score(1, -0.5)
    assert pair(score([whole, fallen], objective={"stages": stages})) == about(0, -4 / 9)


def test_terms_add_up_with_their_weights(record):
    terms = {
        "first": {"measure": final("a.b"), "target": 1, "scale": 1, "weight": 4},
        "second": {"measure": final("a.c"), "at_most": "1 rad", "scale": "1 rad"},
    }
    found = score([record({"a.b": (2, ""), "a.c": (4, "rad")})], objective={"terms": terms})
    assert pair(found) == about(0, 4 * -0.5 - 0.75)


def test_names_of_conditions_do_not_hide_those_of_terms(walk):
    stages = TABLE_2_8["stages"]
    same = {"speed": {"measure": final("trunk.x"), "expected": {"at_least": "34.65 m"}}}
    judge = Objective.of(study(objective={"stages": stages | {"speed": stages["speed"] | {"enter": same}}}))
    measures = judge.grade(walk(35, 1.3, 1)).measures
    assert measures["speed.enter.speed"] == 35.0
    assert measures["speed.speed"] == 1.3


def test_a_staged_score_is_finite_whatever_is_measured(walk):
    assert math.isfinite(score([walk(1e308, 1e308, 1e308)]).value)
