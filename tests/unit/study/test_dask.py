"""Jobs on a Dask cluster: the same results, also when a worker is killed in the middle of a job."""

import os
import signal
import threading
from collections.abc import Iterator
from pathlib import Path

import pytest
from distributed import LocalCluster
from searches import Paraboloid, contents, plan_in, searched
from test_executors import Square, by_job, wait_for

from neuromech.study.dask_executor import DaskExecutor
from neuromech.study.database import Database

pytestmark = pytest.mark.filterwarnings("ignore::DeprecationWarning", "ignore::ResourceWarning")


@pytest.fixture(scope="module")
def address() -> Iterator[str]:
    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None, silence_logs=50) as cluster:
        yield cluster.scheduler_address


def kill_when_noted(task: Square, job: str) -> threading.Thread:
    """Kill the process that works at a job as soon as it has begun."""

    def wait_and_kill() -> None:
        wait_for(lambda: bool(task.pids(job)))
        for pid in task.pids(job):
            os.kill(pid, signal.SIGKILL)

    thread = threading.Thread(target=wait_and_kill)
    thread.start()
    return thread


def test_a_worker_killed_in_the_middle_of_a_job_costs_only_time(address: str, tmp_path: Path):
    task = Square(tmp_path / "notes")
    killer = kill_when_noted(task, "hangs once")
    with DaskExecutor(address) as executor:
        assert executor.workers == 2
        found = by_job(executor, task, [1, "hangs once", 2, 3, 4])
    killer.join()
    assert {job: done.result for job, done in found.items()} == {1: 1, "hangs once": 0, 2: 4, 3: 9, 4: 16}
    assert all(done.crash is None for done in found.values())
    assert task.count("hangs once") == 2


def test_a_study_on_a_cluster_is_the_same_study(address: str, tmp_path: Path):
    plan = plan_in(tmp_path, "study.evaluations=8")
    own = Database(str(tmp_path / "own.db")).create("study", plan.header)
    there = Database(str(tmp_path / "there.db")).create("study", plan.header)
    searched(plan, own, Paraboloid(plan.space, tmp_path / "a", crashing=(2,)))
    with DaskExecutor(address) as executor:
        assert searched(plan, there, Paraboloid(plan.space, tmp_path / "b", crashing=(2,)), executor) == "complete"
    assert contents(there) == contents(own)
