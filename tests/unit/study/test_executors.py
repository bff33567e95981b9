"""Jobs side by side: all of them, once, whatever happens to the processes that carry them out."""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from neuromech.errors import StudyError
from neuromech.study.dask_executor import DaskExecutor
from neuromech.study.executors import Done, Executor, ProcessExecutor
from neuromech.study.tasks import Packed, call

PROC = Path("/proc")


class Square:
    """Squares numbers; some jobs are bad."""

    def __init__(self, notes: Path) -> None:
        self.notes = notes

    def __call__(self, job: int | str) -> int:
        with self.notes.open("a") as stream:
            stream.write(f"{job} {os.getpid()}\n")
        if job == "dies":
            os._exit(1)
        if job == "dies once" and self.count("dies once") == 1:
            os._exit(1)
        if job == "hangs once" and self.count("hangs once") == 1:
            time.sleep(600)
        if job == "no file":
            raise FileNotFoundError(2, "there is no such file", "cat.yaml")
        return 0 if isinstance(job, str) else job * job

    def count(self, job: str) -> int:
        return sum(line.startswith(job) for line in self.notes.read_text().splitlines())

    def pids(self, job: str = "") -> set[int]:
        if not self.notes.exists():
            return set()
        return {int(line.split()[-1]) for line in self.notes.read_text().splitlines() if line.startswith(job)}


def never() -> bool:
    return False


def is_alive(pid: int) -> bool:
    """Tell whether a process runs; one that has ended and is not yet waited for does not."""
    try:
        os.kill(pid, 0)
        return (PROC / str(pid) / "stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except (ProcessLookupError, FileNotFoundError):
        return False


def wait_for(condition: Callable[[], bool], seconds: float = 120.0) -> None:
    until = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < until, "waited in vain"
        time.sleep(0.05)


@pytest.fixture(scope="module")
def processes() -> Iterator[ProcessExecutor]:
    with ProcessExecutor(2) as executor:
        yield executor


@pytest.fixture
def task(tmp_path: Path) -> Square:
    return Square(tmp_path / "notes")


def by_job(executor: Executor, task: Square, jobs: list[int | str]) -> dict[int | str, Done[int | str, int]]:
    return {done.job: done for done in executor.run(task, jobs, never)}


def test_every_job_is_done_once_by_two_processes_that_are_kept(processes: ProcessExecutor, task: Square):
    found = by_job(processes, task, list(range(8)))
    assert {job: done.result for job, done in found.items()} == {number: number**2 for number in range(8)}
    assert len(task.notes.read_text().splitlines()) == 8
    assert len(task.pids()) <= 2
    assert os.getpid() not in task.pids()


def test_a_process_that_dies_is_replaced_and_its_job_tried_once_more(processes: ProcessExecutor, task: Square):
    found = by_job(processes, task, ["dies once", 1, "dies", 2, 3])
    assert (found["dies once"].result, found["dies once"].crash) == (0, None)
    assert found["dies"].result is None
    assert "ended abruptly" in str(found["dies"].crash)
    assert task.count("dies") == 4
    assert [found[number].result for number in (1, 2, 3)] == [1, 4, 9]


def test_what_is_not_about_one_job_ends_all(processes: ProcessExecutor, task: Square):
    with pytest.raises(FileNotFoundError, match=r"cat\.yaml"):
        by_job(processes, task, ["no file"])
    assert by_job(processes, task, [3])[3].result == 9


def test_after_a_stop_no_job_begins_and_those_under_way_are_done(processes: ProcessExecutor, task: Square):
    taken: list[int] = []

    def jobs() -> Iterator[int]:
        for number in range(100):
            taken.append(number)
            yield number

    done = list(processes.run(task, jobs(), lambda: len(taken) >= 5))
    assert sorted(one.job for one in done) == taken == [0, 1, 2, 3, 4]


@pytest.mark.skipif(not PROC.is_dir(), reason="there is no /proc to look at")
def test_closing_ends_processes_that_work(task: Square):
    executor = ProcessExecutor(1)
    running = executor.run(task, ["waits", "hangs once"], never)
    assert next(running).job == "waits"
    wait_for(lambda: bool(task.pids("hangs once")))
    executor.close()
    wait_for(lambda: not any(map(is_alive, task.pids("hangs once"))))


ORPHANS = """
import sys, time
from pathlib import Path
sys.path.insert(0, {folder!r})
from test_executors import Square, never
from neuromech.study.executors import ProcessExecutor

if __name__ == "__main__":
    for _ in ProcessExecutor(1).run(Square(Path({notes!r})), ["hangs once"], never):
        pass
"""


@pytest.mark.skipif(not PROC.is_dir(), reason="there is no /proc to look at")
def test_processes_do_not_outlive_a_killed_parent(tmp_path: Path):
    notes, script = tmp_path / "notes", tmp_path / "parent.py"
    script.write_text(ORPHANS.format(folder=str(Path(__file__).parent), notes=str(notes)))
    with subprocess.Popen([sys.executable, str(script)]) as parent:
        wait_for(notes.exists)
        parent.send_signal(signal.SIGKILL)
    wait_for(lambda: not any(map(is_alive, Square(notes).pids())))


def test_a_worker_with_other_packages_is_refused():
    packed = Packed.of(abs)
    assert call(packed, -3) == 3
    with pytest.raises(StudyError, match=r"the worker on .* has neuromech .*; the search has neuromech 0\.0"):
        call(replace(packed, versions=("neuromech 0.0",)), -3)


def test_a_scheduler_that_is_not_there_is_named():
    with pytest.raises(StudyError, match=r"no Dask scheduler answers at tcp://127\.0\.0\.1:1\..*dask scheduler"):
        DaskExecutor("tcp://127.0.0.1:1", patience=0.5)
