"""A search gives the same evaluations whatever interrupts it and wherever they run, each evaluated once."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from searches import Inline, Paraboloid, begun, contents, goes_on_after_a_kill, plan_in, reopened, searched

from neuromech.errors import RunError, StudyError
from neuromech.study.driver import Search
from neuromech.study.executors import ProcessExecutor
from neuromech.study.plan import Plan
from neuromech.study.progress import Standing


@pytest.fixture(scope="module")
def plan(tmp_path_factory: pytest.TempPathFactory) -> Plan:
    return plan_in(tmp_path_factory.mktemp("document"))


@pytest.fixture
def task(plan: Plan, tmp_path: Path) -> Paraboloid:
    return Paraboloid(plan.space, tmp_path / "evaluated", crashing=(5,))


@pytest.fixture(scope="module")
def expected(plan: Plan, tmp_path_factory: pytest.TempPathFactory) -> list[dict[str, Any]]:
    folder = tmp_path_factory.mktemp("uninterrupted")
    stored = begun(plan, folder, "uninterrupted")
    task = Paraboloid(plan.space, folder / "evaluated", crashing=(5,))
    assert searched(plan, stored, task) == "complete"
    return contents(stored)


def test_a_study_has_as_many_evaluations_as_it_says_and_common_seeds_in_a_generation(expected: list[dict[str, Any]]):
    assert [one["number"] for one in expected] == list(range(14))
    assert [one["generation"] for one in expected] == [0] * 4 + [1] * 4 + [2] * 4 + [3] * 2
    seeds = {(one["generation"], tuple(run["seed"] for run in one["runs"])) for one in expected if one["runs"]}
    assert len(seeds) == len({generation for generation, _ in seeds}) == 4


def test_a_crash_of_one_candidate_is_kept_with_its_message(expected: list[dict[str, Any]]):
    assert expected[5]["score"] is None
    assert expected[5]["failure"] == "ZeroDivisionError: the cat divided itself"
    assert sum(one["score"] is None for one in expected) == 1


class Stop:
    """Turns true after it was asked some times."""

    def __init__(self, times: int) -> None:
        self.times = times

    def __call__(self) -> bool:
        self.times -= 1
        return self.times < 0


@pytest.mark.parametrize("times", [0, 1, 5, 12])
def test_a_stopped_search_goes_on_as_if_it_had_not_been(
    times: int, plan: Plan, task: Paraboloid, expected: list[dict[str, Any]], tmp_path: Path
):
    assert searched(plan, begun(plan, tmp_path, "stopped"), task, stop=Stop(times)) == "stopped"
    assert 0 <= len(task.numbers()) < 14
    assert searched(plan, reopened(tmp_path, "stopped"), task) == "complete"
    assert contents(reopened(tmp_path, "stopped")) == expected
    assert task.numbers() == list(range(14))


@pytest.mark.parametrize("until", [0, 1, 2, 5, 6, 7, 9, 17, 20])
def test_a_search_killed_between_any_two_writes_goes_on_as_if_it_had_not_been(
    until: int, plan: Plan, task: Paraboloid, expected: list[dict[str, Any]], tmp_path: Path
):
    goes_on_after_a_kill(plan, tmp_path, task, until, expected)


def test_more_evaluations_later_are_the_same_as_at_once(
    task: Paraboloid, expected: list[dict[str, Any]], tmp_path: Path
):
    few, many = plan_in(tmp_path, "study.evaluations=6"), plan_in(tmp_path)
    assert few.header.changes(many.header) == []
    assert searched(few, begun(few, tmp_path, "grown"), task) == "complete"
    assert contents(reopened(tmp_path, "grown")) == expected[:6]
    assert searched(many, reopened(tmp_path, "grown"), task) == "complete"
    assert contents(reopened(tmp_path, "grown")) == expected
    assert task.numbers() == list(range(14))


@pytest.mark.parametrize("workers", [3, 8])
def test_the_number_of_workers_does_not_matter(
    workers: int, plan: Plan, task: Paraboloid, expected: list[dict[str, Any]], tmp_path: Path
):
    stored = begun(plan, tmp_path, "several")
    assert searched(plan, stored, task, Inline(workers)) == "complete"
    assert contents(stored) == expected


def test_processes_give_the_same_and_a_candidate_that_ends_its_process_fails(
    plan: Plan, expected: list[dict[str, Any]], tmp_path: Path
):
    task = Paraboloid(plan.space, tmp_path / "evaluated", crashing=(5,), deadly=(13,))
    stored = begun(plan, tmp_path, "processes")
    with ProcessExecutor(2) as executor:
        assert searched(plan, stored, task, executor) == "complete"
    found = contents(stored)
    assert found[:13] == expected[:13]
    assert found[13]["parameters"] == expected[13]["parameters"]
    assert found[13]["score"] is None
    assert "ended abruptly" in found[13]["failure"]
    assert sorted(task.numbers()) == [*range(14), 13]


def test_two_searches_of_one_study_at_a_time_are_noticed(plan: Plan, task: Paraboloid, tmp_path: Path):
    first = begun(plan, tmp_path, "shared")
    search = Search(plan, first, lambda standing: None)
    assert searched(plan, reopened(tmp_path, "shared"), task) == "complete"
    with pytest.raises(StudyError, match="another process"):
        search.run(Inline(), task, lambda: False)


def test_a_study_without_any_candidate_that_works_ends(plan: Plan, tmp_path: Path):
    hopeless = Paraboloid(plan.space, tmp_path / "hopeless", crashing=tuple(range(99)))
    with pytest.raises(RunError, match=r"generation 0 .* the cat divided itself"):
        searched(plan, begun(plan, tmp_path, "hopeless"), hopeless)
    assert len(reopened(tmp_path, "hopeless").evaluations()) == 4


def test_other_candidates_than_those_stored_are_refused(plan: Plan, task: Paraboloid, tmp_path: Path):
    searched(plan, begun(plan, tmp_path, "other"), task, stop=Stop(3))
    other = plan_in(tmp_path, "study.seed=4")
    with pytest.raises(StudyError, match="other parameters"):
        searched(other, reopened(tmp_path, "other"), task)


def test_the_standing_counts_what_is_done(plan: Plan, task: Paraboloid, tmp_path: Path):
    seen: list[Standing] = []
    Search(plan, begun(plan, tmp_path, "told"), seen.append).run(Inline(), task, lambda: False)
    assert [one.done for one in seen] == [1, 2, 3, 4, 4, 5, 6, 7, 8, 8, 9, 10, 11, 12, 12, 13, 14]
    assert (seen[-1].crashed, seen[-1].fallen, seen[-1].total) == (1, 0, 14)
    assert seen[-1].remaining == 0.0
    assert seen[3].median is None
    assert seen[4].median is not None
    best: Iterator[float] = (one.best.value for one in seen if one.best is not None)
    assert list(best) == sorted(one.best.value for one in seen if one.best is not None)
