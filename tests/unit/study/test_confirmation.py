"""After a search its best candidates are evaluated again, with seeds that decide about nobody's luck."""

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from searches import Inline, Paraboloid, begun, contents, goes_on_after_a_kill, plan_in, reopened, searched

from neuromech.cli.scores import evaluation_text
from neuromech.study.algorithms.catalogue import AlgorithmCatalogue
from neuromech.study.confirmation import contenders
from neuromech.study.database import Database
from neuromech.study.driver import Search
from neuromech.study.evaluate import Evaluator
from neuromech.study.evaluation import CENTER, Evaluation, Job, RunResult
from neuromech.study.executors import ProcessExecutor
from neuromech.study.export import table
from neuromech.study.history import best_of, confirmed, generations
from neuromech.study.plan import Plan
from neuromech.study.progress import Standing
from neuromech.study.score import Score

CONFIRM = ("study.confirm.candidates=3", "study.confirm.seeds=5")
SEARCHED = 14


@pytest.fixture(scope="module")
def plan(tmp_path_factory: pytest.TempPathFactory) -> Plan:
    return plan_in(tmp_path_factory.mktemp("document"), *CONFIRM)


@pytest.fixture
def task(plan: Plan, tmp_path: Path) -> Paraboloid:
    return Paraboloid(plan.space, tmp_path / "evaluated", crashing=(5,))


@pytest.fixture(scope="module")
def expected(plan: Plan, tmp_path_factory: pytest.TempPathFactory) -> list[dict[str, Any]]:
    folder = tmp_path_factory.mktemp("uninterrupted")
    stored = begun(plan, folder, "uninterrupted")
    assert searched(plan, stored, Paraboloid(plan.space, folder / "evaluated", crashing=(5,))) == "complete"
    return contents(stored)


def test_the_search_is_the_same_and_the_best_follow_with_fresh_seeds(expected: list[dict[str, Any]], tmp_path: Path):
    without = plan_in(tmp_path)
    stored = begun(without, tmp_path, "without")
    searched(without, stored, Paraboloid(without.space, tmp_path / "evaluated", crashing=(5,)))
    assert expected[:SEARCHED] == contents(stored)
    again = expected[SEARCHED:]
    ranked = sorted((one for one in expected[:SEARCHED] if one["score"]), key=lambda one: -one["score"]["value"])
    assert [one["confirms"] for one in again[:3]] == [one["number"] for one in ranked[:3]]
    for one in again:
        if one["confirms"] != CENTER:
            assert one["parameters"] == expected[one["confirms"]]["parameters"]
    seeds = {tuple(run["seed"] for run in one["runs"]) for one in again}
    (fresh,) = seeds
    assert len(set(fresh)) == 5
    assert not set(fresh) & {run["seed"] for one in expected[:SEARCHED] for run in one["runs"]}
    assert {one["generation"] for one in again} == {4}


@pytest.mark.parametrize("after", [14, 15, 16])
def test_a_confirmation_that_was_stopped_goes_on(
    after: int, plan: Plan, task: Paraboloid, expected: list[dict[str, Any]], tmp_path: Path
):
    stored = begun(plan, tmp_path, "stopped")
    assert searched(plan, stored, task, stop=lambda: len(task.numbers()) >= after) == "stopped"
    assert len(task.numbers()) == after
    search = Search(plan, reopened(tmp_path, "stopped"), lambda standing: None)
    assert not search.is_complete
    assert search.run(Inline(), task, lambda: False) == "complete"
    assert search.is_complete
    assert Search(plan, reopened(tmp_path, "stopped"), lambda standing: None).is_complete
    assert contents(reopened(tmp_path, "stopped")) == expected
    assert task.numbers() == list(range(len(expected)))


@pytest.mark.parametrize("until", [19, 20, 21, 22, 23])
def test_a_confirmation_killed_between_any_two_writes_goes_on(
    until: int, plan: Plan, task: Paraboloid, expected: list[dict[str, Any]], tmp_path: Path
):
    goes_on_after_a_kill(plan, tmp_path, task, until, expected)


def test_executors_do_not_matter(plan: Plan, task: Paraboloid, expected: list[dict[str, Any]], tmp_path: Path):
    several = begun(plan, tmp_path, "several")
    assert searched(plan, several, task, Inline(8)) == "complete"
    assert contents(several) == expected
    processes = begun(plan, tmp_path, "processes")
    with ProcessExecutor(2) as executor:
        assert searched(plan, processes, task, executor) == "complete"
    assert contents(processes) == expected


def placed(evaluations: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Return evaluations without their numbers, which a confirmation in between moves."""
    return [
        {key: value for key, value in one.items() if key not in ("number", "confirms", "failure", "score", "runs")}
        for one in evaluations
        if one["confirms"] is None
    ]


def test_a_confirmed_search_may_go_on_and_evaluates_nothing_twice(
    expected: list[dict[str, Any]], plan: Plan, tmp_path: Path
):
    few = plan_in(tmp_path, "study.evaluations=6", *CONFIRM)
    assert few.header.changes(plan.header) == []
    task = Paraboloid(plan.space, tmp_path / "evaluated")
    assert searched(few, begun(few, tmp_path, "grown"), task) == "complete"
    early = contents(reopened(tmp_path, "grown"))
    assert searched(plan, reopened(tmp_path, "grown"), task) == "complete"
    found = contents(reopened(tmp_path, "grown"))
    assert found[: len(early)] == early
    assert task.numbers() == list(range(len(found)))
    assert len(placed(found)) == SEARCHED
    places = [(tuple(one["parameters"].items()), len(one["runs"])) for one in found]
    assert len(set(places)) == len(places)
    assert [one["generation"] for one in placed(found)] == [one["generation"] for one in placed(expected)]


def test_a_study_may_be_confirmed_later(plan: Plan, expected: list[dict[str, Any]], tmp_path: Path):
    without = plan_in(tmp_path)
    assert without.header.changes(plan.header) == []
    task = Paraboloid(plan.space, tmp_path / "evaluated", crashing=(5,))
    searched(without, begun(without, tmp_path, "later"), task)
    assert searched(plan, reopened(tmp_path, "later"), task) == "complete"
    assert contents(reopened(tmp_path, "later")) == expected


def test_the_standing_tells_the_confirmation_apart(plan: Plan, task: Paraboloid, tmp_path: Path):
    seen: list[Standing] = []
    Search(plan, begun(plan, tmp_path, "told"), seen.append).run(Inline(), task, lambda: False)
    during = [one for one in seen if one.is_confirming]
    assert [one.done for one in during] == list(range(SEARCHED + 1, SEARCHED + 1 + len(during)))
    assert {one.total for one in during} == {SEARCHED + len(during)}
    assert {one.total for one in seen if not one.is_confirming} == {SEARCHED}
    assert during[-1].remaining == 0.0


def evaluation(number: int, score: float | None, confirms: Any = None, seeds: tuple[int, ...] = (1,)) -> Evaluation:
    runs = tuple(RunResult("", seed, "finished", 1.0, "", {}, {}) for seed in seeds)
    parameters = {"gain": repr(0.5 + 0.1 * (number if confirms is None else 0)), "delay": "20.0 ms"}
    judged = None if score is None else Score(0, score)
    failure = "it broke" if score is None else None
    return Evaluation(number, 0, number, parameters, runs, judged, failure, 0.1, 1.0, confirms)


LUCKY = [
    evaluation(0, 5.0),
    evaluation(1, 9.0),
    evaluation(2, 7.0),
    evaluation(3, 3.0, confirms=1, seeds=(8, 9)),
    evaluation(4, 6.0, confirms=2, seeds=(8, 9)),
    evaluation(5, None, confirms=CENTER, seeds=(8,)),
]


def test_who_was_lucky_in_the_search_does_not_win():
    assert best_of(LUCKY[:3]) == LUCKY[1]
    assert best_of(LUCKY) == LUCKY[4]
    assert [(one.evaluation.number, one.searched) for one in confirmed(LUCKY)] == [
        (4, Score(0, 7.0)),
        (3, Score(0, 9.0)),
        (5, None),
    ]
    assert [one.best for one in generations(LUCKY)] == [Score(0, 9.0)]
    assert evaluation_text(LUCKY[4], ()) == "evaluation 4 (confirms evaluation 2), score 6"
    assert evaluation_text(replace(LUCKY[4], confirms=CENTER), ("walk",)) == (
        "evaluation 4 (confirms the center of the search), score walk 6"
    )


def test_scores_with_other_seeds_are_not_compared():
    more = [*LUCKY, evaluation(6, 4.0, confirms=1, seeds=(8, 9, 10))]
    assert best_of(more) == more[6]
    assert [one.evaluation.number for one in confirmed(more)] == [6, 5]


def test_a_confirmation_in_which_all_fail_has_no_winner():
    assert best_of([*LUCKY[:3], LUCKY[5]]) is None


def test_a_table_says_what_confirms_what(plan: Plan):
    assert list(table(plan.header, LUCKY)["confirms"]) == ["", "", "", "1", "2", "center"]


@pytest.fixture
def own(plan: Plan) -> Iterator[np.ndarray]:
    yield plan.space.point(plan.document)[None, :]


def test_contenders_are_the_best_and_the_center_each_once(plan: Plan, own: np.ndarray):
    twin = replace(evaluation(7, 9.5), parameters=plan.space.parameters(own[0]))
    searched_ones = [evaluation(3, None), replace(twin, number=8, score=Score(0, 9.2)), twin, *LUCKY[:3]]
    found = contenders(searched_ones, own, plan.space, 2)
    assert [origin for origin, _ in found] == [7, 1]
    assert found[0][1] == twin.parameters
    assert [origin for origin, _ in contenders(searched_ones, own + 0.1, plan.space, 2)] == [7, 1, CENTER]
    assert [origin for origin, _ in contenders(searched_ones, own, plan.space, 99)] == [7, 1, 2, 0]
    assert contenders([evaluation(3, None)], own, plan.space, 2) == []


def test_each_algorithm_has_its_center():
    def after(generations: int, **written: Any) -> Any:
        catalogue = AlgorithmCatalogue.installed()
        search = catalogue.create(catalogue.settings(written), 3, 1, np.full(3, 0.2))
        for _ in range(generations):
            search.tell([Score(0, -float(np.sum((point - 0.7) ** 2))) for point in search.ask()])
        return search

    for covariance in ("full", "separable"):
        mean = after(60, kind="cma_es", covariance=covariance)
        assert mean.centers() == pytest.approx(np.full((1, 3), 0.7), abs=0.05)
        assert after(0, kind="cma_es", covariance=covariance).centers().tolist() == [[0.2] * 3]
    elites = after(2, kind="real_coded_ga", population=10, elites=3)
    assert np.array_equal(elites.centers(), elites.ask()[:3])
    assert len(after(0, kind="real_coded_ga", population=10).centers()) == 0
    swarm = after(1, kind="pso", population=10)
    first = after(0, kind="pso", population=10)
    assert len(first.centers()) == 0
    assert swarm.centers().tolist() == [min(first.ask().tolist(), key=lambda point: sum((x - 0.7) ** 2 for x in point))]


def test_every_scenario_runs_with_every_fresh_seed(relaxing):
    scenarios = {
        "low": {"set": {"network.neurons.second.bias": -3}, "fixed_seeds": [1, 2], "weight": 3},
        "own": {"seeds": 1},
    }
    evaluator = Evaluator(relaxing({"scenarios": scenarios, "confirm": {"seeds": 4}, "stop_early": {"at": "100 ms"}}))
    assert evaluator.confirmation is not None
    assert evaluator.confirmation.candidates == 8
    plan = evaluator.confirmation.scenarios
    seeds = plan.seeds(7)
    job = Job(9, 3, 0, evaluator.space.parameters(evaluator.space.point(evaluator.document)), seeds, confirms=2)
    found = evaluator(job)
    assert [(one.scenario, one.seed) for one in found.runs] == [("low", s) for s in seeds[:4]] + [
        ("own", s) for s in seeds[:4]
    ]
    assert sum(plan.weights) == pytest.approx(1.0)
    assert plan.weights[0] == 3 * plan.weights[-1]
    assert found.confirms == 2
    assert {one.kind for one in found.runs} == {"finished"}


def test_a_study_that_confirms_nothing_refuses_such_a_job(relaxing):
    evaluator = Evaluator(relaxing())
    own = evaluator.space.parameters(evaluator.space.point(evaluator.document))
    with pytest.raises(ValueError, match="without 'confirm'"):
        evaluator(Job(9, 3, 0, own, (1,), confirms=CENTER))


def test_what_confirms_is_read_back_from_storage(plan: Plan, expected: list[dict[str, Any]], tmp_path: Path):
    stored = begun(plan, tmp_path, "stored")
    searched(plan, stored, Paraboloid(plan.space, tmp_path / "evaluated", crashing=(5,)))
    trials = Database(str(tmp_path / "stored.db"), create=False).open("study").trials()
    assert [trial.confirms for trial in trials] == [one["confirms"] for one in expected]
    assert {len(trial.seeds) for trial in trials[SEARCHED:]} == {5}
