"""Evaluations: the same numbers however they come about, failures apart from poor scores, hopeless runs ended."""

import json
import pickle
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

import numpy as np
import pytest

from neuromech.errors import DocumentError
from neuromech.pipeline import load_document, run
from neuromech.study.evaluate import Evaluator
from neuromech.study.evaluation import Evaluation, Job
from neuromech.study.score import Score
from neuromech.study.stopping import LOWEST, thresholds


def jobs(evaluator, count=6, **keys):
    generator = np.random.default_rng(3)
    dimension = len(evaluator.space.dimensions)
    seeds = evaluator.scenarios.seeds(0)
    points = [generator.random(dimension) for _ in range(count)]
    return [Job(n, 0, n, evaluator.space.parameters(point), seeds, **keys) for n, point in enumerate(points)]


def numbers(evaluations):
    return [replace(evaluation, wall_seconds=0.0) for evaluation in evaluations]


def test_an_evaluation_measures_what_a_run_of_the_written_values_shows(relaxing):
    file = relaxing()
    evaluator = Evaluator(file)
    evaluation = evaluator(jobs(evaluator)[0])
    overrides = [f"parameters.{name}.value={text}" for name, text in evaluation.parameters.items()]
    level = run(file, overrides).signal("second.activity")[1][-1]
    (only,) = evaluation.runs
    assert only.measures == {"level": level}
    assert only.points["level"] == evaluation.score.value
    assert (only.kind, only.time, evaluation.simulated_seconds) == ("finished", pytest.approx(0.2), only.time)


def test_threads_copies_and_repetition_change_nothing(relaxing):
    file = relaxing({"scenarios": {"slow": {"set": {"network.neurons.second.time_constant": "50 ms"}}, "own": {}}})
    evaluator = Evaluator(file)
    asked = jobs(evaluator)
    alone = numbers(map(evaluator, asked))
    copy = pickle.loads(pickle.dumps(evaluator))
    file.write_text("an author writes on while the study goes on")
    with ThreadPoolExecutor(4) as pool:
        assert numbers(pool.map(copy, reversed(asked)))[::-1] == alone


def test_rewritten_parameters_give_the_same_bits_as_a_document_that_is_lowered_anew(relaxing):
    tune = {"bias": {}, "weight": {"scale": "log"}}
    fast, slow = Evaluator(relaxing({"tune": tune})), Evaluator(relaxing({"tune": tune | {"start": {}}}))
    start = slow.space.parameters(slow.space.point(slow.document))["start"]
    for job in jobs(fast):
        other = replace(job, parameters={**job.parameters, "start": start})
        assert fast(job).runs[0].measures == slow(other).runs[0].measures


def test_scenarios_and_seeds_are_run_each(relaxing):
    evaluator = Evaluator(
        relaxing({"scenarios": {"low": {"set": {"network.neurons.second.bias": -3}, "fixed_seeds": [1, 2]}, "own": {}}})
    )
    evaluation = evaluator(jobs(evaluator)[0])
    assert [(one.scenario, one.seed) for one in evaluation.runs] == [("low", 1), ("low", 2), ("own", 0)]
    low, _, own = evaluation.runs
    assert low.measures["level"] < own.measures["level"]
    mean = sum(weight * one.points["level"] for weight, one in zip((0.25, 0.25, 0.5), evaluation.runs, strict=True))
    assert evaluation.score.value == pytest.approx(mean)


def test_the_duration_is_that_of_the_study(relaxing):
    evaluator = Evaluator(relaxing({"duration": "50 ms"}))
    assert evaluator(jobs(evaluator)[0]).simulated_seconds == pytest.approx(0.05)


def test_an_evaluation_travels_through_json(relaxing):
    evaluator = Evaluator(relaxing({"stop_early": {"at": "100 ms"}}))
    evaluation = evaluator(jobs(evaluator)[0])
    assert evaluation.runs[0].partial is not None
    assert Evaluation.from_dict(json.loads(json.dumps(evaluation.to_dict()))) == evaluation


def test_divergence_is_a_failure_with_its_words_and_no_score(relaxing):
    evaluator = Evaluator(relaxing({"tune": {"time_constant": {"range": ["0.1 ms", "0.2 ms"]}}}))
    evaluation = evaluator(jobs(evaluator)[0])
    assert evaluation.score is None
    assert evaluation.failure == "seed 0: state first.rate is not a finite number any more"
    assert [one.kind for one in evaluation.runs] == ["diverged"]
    assert not evaluation.fell


def test_values_that_break_the_document_are_a_failure_of_that_candidate(relaxing):
    """The end of a ramp, which follows a parameter, may come to lie before its start."""
    parameters = {"end": {"value": "150 ms", "minimum": "10 ms", "maximum": "200 ms"}}
    ramps = {"up": {"parameter": "bias", "start": "100 ms", "end": "${end}", "to": 2}}
    document = json.loads(relaxing().read_text())
    evaluator = Evaluator(
        relaxing(
            {"tune": {"end": {}}},
            parameters=document["parameters"] | parameters,
            protocol={"duration": "200 ms", "ramps": ramps},
        )
    )
    early, late = (evaluator.space.parameters(np.array([place])) for place in (0.1, 0.9))
    job = Job(0, 0, 0, early, evaluator.scenarios.seeds(0))
    assert "protocol.ramps.up.end  must be later than the start, 100 ms" in evaluator(job).failure
    assert evaluator(replace(job, parameters=late)).failure is None


@pytest.fixture
def swinging(relaxing):
    """The relaxing network and a leg on a hinge, of which a study tunes the angle at time zero."""
    segment = {"mass": "1 kg", "center_of_mass": ["0 m", "0 m", "-0.2 m"], "inertia": ["1 kg m^2"] * 3}
    hip = {
        "parent": "trunk",
        "child": "leg",
        "position": ["0 m"] * 3,
        "axis": [0, 1, 0],
        "range": ["-40 deg", "40 deg"],
    }
    angle = {"value": "10 deg", "minimum": "-90 deg", "maximum": "90 deg"}
    terms = {
        "swing": {
            "measure": {"kind": "maximum", "signal": "hip.angle"},
            "goal": "maximize",
            "scale": "1 deg",
            "worst": 0,
        }
    }
    return relaxing(
        {"tune": {"angle": {}}, "objective": {"terms": terms}},
        body={"engine": "hinge", "segments": {"trunk": segment, "leg": segment}, "joints": {"hip": hip}},
        parameters=json.loads(relaxing().read_text())["parameters"] | {"angle": angle},
        protocol={"duration": "100 ms", "initial": {"hip.angle": "${angle}"}},
    )


def with_angle(evaluator, angle):
    return Job(0, 0, 0, {"angle": angle}, evaluator.scenarios.seeds(0))


def test_the_start_of_a_run_can_be_tuned(swinging):
    evaluator = Evaluator(swinging)
    low, high = (evaluator(with_angle(evaluator, angle)) for angle in ("0 deg", "30 deg"))
    angles = [run(swinging, [f"parameters.angle.value={one.parameters['angle']}"]) for one in (low, high)]
    expected = [one.signal("hip.angle")[1].max() for one in angles]
    assert [one.runs[0].measures["swing"] for one in (low, high)] == pytest.approx(expected)
    assert expected[1] - expected[0] > 0.3


def test_a_start_that_the_rules_refuse_is_a_failure_of_that_candidate(swinging):
    evaluator = Evaluator(swinging)
    failure = evaluator(with_angle(evaluator, "60 deg")).failure
    assert "protocol.initial.hip.angle  is outside the range of joint 'hip'" in failure


def test_a_hopeless_run_is_ended_and_graded_as_one_that_ended_early(relaxing):
    evaluator = Evaluator(relaxing({"stop_early": {"at": "100 ms"}}))
    asked = jobs(evaluator, 5)
    first = [evaluator(job) for job in asked]
    assert {one.runs[0].kind for one in first} == {"finished"}
    (threshold,) = thresholds(first)
    partial = sorted(one.runs[0].partial for one in first)
    assert threshold == partial[2]
    second = [evaluator(replace(job, generation=1, thresholds=(threshold,))) for job in asked]
    for before, after in zip(first, second, strict=True):
        (run_before,), (run_after,) = before.runs, after.runs
        assert run_after.partial == run_before.partial
        if run_after.partial < threshold:
            assert (run_after.kind, run_after.time) == ("stopped", pytest.approx(0.1))
            assert run_after.message == "below the median of the earlier generations"
            assert after.score == Score(0, -1.0)
        else:
            assert replace(after, generation=0, wall_seconds=0.0) == replace(before, wall_seconds=0.0)
    assert [one.runs[0].kind for one in second].count("stopped") == 2


def test_thresholds_are_lower_medians_without_failures_and_with_early_ends_last(relaxing):
    evaluator = Evaluator(relaxing({"stop_early": {"at": "100 ms"}}))
    evaluation = evaluator(jobs(evaluator)[0])

    def with_partial(partial, failure=None):
        return replace(evaluation, runs=(replace(evaluation.runs[0], partial=partial),), failure=failure)

    scores = [with_partial(Score(0, value)) for value in (3.0, 1.0, 2.0)]
    assert thresholds([]) == ()
    assert thresholds(scores) == (Score(0, 2.0),)
    assert thresholds([*scores, with_partial(None)]) == (Score(0, 1.0),)
    assert thresholds([*scores, with_partial(Score(0, 9.0), "it diverged")]) == (Score(0, 2.0),)
    assert thresholds([with_partial(None)]) == (LOWEST,)


def test_nothing_but_what_is_measured_is_recorded(relaxing):
    evaluator = Evaluator(relaxing())
    evaluator.prepare()
    (program,) = (one.program({"bias": "1", "weight": "1"}) for one in evaluator._programs.values())
    assert [group.signals for group in program.graph.document.experiment.record.values()] == [("second.activity",)]


def test_a_document_without_a_study_is_refused(document):
    file = document({"network": {"neurons": {"a": {"kind": "static_neuron"}}}, "protocol": {"duration": "1 ms"}})
    with pytest.raises(DocumentError, match="has no section 'study'"):
        Evaluator(file)
    assert load_document(file).experiment.study is None
