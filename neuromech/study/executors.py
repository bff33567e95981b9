"""Where evaluations run: in processes of this machine. What comes out does not depend on how many there are.

A task is a callable that can be pickled. Each process unpickles it once, however many jobs it gets, so a task may keep
what is costly to make. The processes share what the task keeps on disk, such as compiled kernels.
"""

import contextlib
import itertools
import os
import signal
import threading
import time
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass
from multiprocessing import get_context, parent_process
from types import TracebackType
from typing import Any, Generic, Self, TypeVar

from neuromech.errors import NeuromechError
from neuromech.study.tasks import Packed, call_again, call_and_keep

Job = TypeVar("Job")
Result = TypeVar("Result")
Stop = Callable[[], bool]

ENDED_ABRUPTLY = "each process that ran it ended abruptly: a crash inside an engine, or no memory left"
FATAL = (NeuromechError, ImportError, OSError)
"""Errors that are not about one job but about all of them: the document, the installation, the machine."""


@dataclass(frozen=True, slots=True)
class Done(Generic[Job, Result]):
    """A job that is over: its result, or else what it crashed with; and the seconds from its handing out to its end."""

    job: Job
    result: Result | None
    crash: str | None
    seconds: float


class Executor(ABC):
    """Something that carries out jobs side by side; to be used in a `with` block."""

    @property
    @abstractmethod
    def workers(self) -> int:
        """How many jobs run at the same time."""

    @abstractmethod
    def prepare(self, function: Callable[[], None]) -> None:
        """Call a function once on each machine, before jobs run there; whatever it raises passes on."""

    def run(
        self, task: Callable[[Job], Result] | Packed, jobs: Iterable[Job], stop: Stop
    ) -> Iterator[Done[Job, Result]]:
        """Yield the jobs as they are done, in any order.

        Args:
            task: what to do with each job; it and the jobs can be pickled. One that is used again is packed once.
            jobs: handed out in this order; each is taken when it can begin.
            stop: when it turns true, no other job begins, and those under way are yielded when they are done.

        Raises:
            NeuromechError, ImportError, OSError: what the task raised, where it is not about a single job.
        """
        packed = task if isinstance(task, Packed) else Packed.of(task)
        waiting: Iterator[tuple[Job, int]] = ((job, 0) for job in jobs)
        running: dict[Future[Any], _Try] = {}
        self._fill(running, waiting, packed, stop)
        while running:
            for future in wait(running, return_when=FIRST_COMPLETED).done:
                one = running.pop(future)
                found = self._found(one, future)
                if found is None:
                    waiting = itertools.chain([(one.job, one.number + 1)], waiting)
                # Before the result is looked at, so that nobody waits meanwhile.
                self._fill(running, waiting, packed, stop)
                if found is not None:
                    yield found

    def _fill(
        self, running: dict[Future[Any], "_Try"], waiting: Iterator[tuple[Any, int]], packed: Packed, stop: Stop
    ) -> None:
        while len(running) < self._slots() and not stop():
            job, number = next(waiting, (None, 0))
            if job is None:
                return
            running[self._submit(packed, job)] = _Try(job, number, time.perf_counter())

    def _found(self, one: "_Try", future: Future[Any]) -> Done[Any, Any] | None:
        """Return what became of a job, None where it has to be tried again."""
        if not self._release(future):
            return _done(one, future)
        return Done(one.job, None, ENDED_ABRUPTLY, one.seconds) if one.number else None

    @abstractmethod
    def _slots(self) -> int:
        """Return how many jobs are handed out at a time."""

    @abstractmethod
    def _submit(self, packed: Packed, job: Any) -> Future[Any]:
        """Hand out one job."""

    @abstractmethod
    def _release(self, future: Future[Any]) -> bool:
        """Take note that a job is over; tell whether what carried it out died and the job has to be tried again."""

    @abstractmethod
    def close(self) -> None:
        """Let go of everything; jobs under way are dropped."""

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self.close()


def available_cores() -> int:
    """Return how many cores this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


@dataclass(frozen=True, slots=True)
class _Try:
    """A job under way: how often it was tried before, and when it was handed out (s)."""

    job: Any
    number: int
    started: float

    @property
    def seconds(self) -> float:
        return time.perf_counter() - self.started


def _done(one: _Try, future: Future[Any]) -> Done[Any, Any]:
    """Return what became of a job.

    Raises:
        NeuromechError, ImportError, OSError: what the task raised, where it is not about a single job.
    """
    error = future.exception()
    if error is None:
        return Done(one.job, future.result(), None, one.seconds)
    if isinstance(error, FATAL) or not isinstance(error, Exception):
        raise error
    return Done(one.job, None, f"{type(error).__name__}: {error}".rstrip(": "), one.seconds)


class ProcessExecutor(Executor):
    """Processes of this machine, one job each. A process that dies is replaced, and its job is tried once more.

    Each process is a pool of its own, so that it is known which job a dead process had.
    """

    def __init__(self, workers: int | None = None) -> None:
        """Start the processes.

        Args:
            workers: how many processes; as many as there are cores where None is given.
        """
        self._workers = workers or available_cores()
        self._free = [_Process() for _ in range(self._workers)]
        self._busy: dict[Future[Any], _Process] = {}

    @property
    def workers(self) -> int:
        """How many processes there are."""
        return self._workers

    def prepare(self, function: Callable[[], None]) -> None:
        """Call a function in one of the processes."""
        self._free[-1].pool.submit(function).result()

    def close(self) -> None:
        """End the processes, those that work included."""
        for process in self._busy.values():
            process.kill()
        for process in [*self._free, *self._busy.values()]:
            process.pool.shutdown(wait=True, cancel_futures=True)
        self._free, self._busy = [], {}

    def _slots(self) -> int:
        return self._workers

    def _submit(self, packed: Packed, job: Any) -> Future[Any]:
        process = self._free.pop()
        try:
            future = process.submit(packed, job)
        except BrokenProcessPool:
            # It died while it had nothing to do.
            process = _Process()
            future = process.submit(packed, job)
        self._busy[future] = process
        return future

    def _release(self, future: Future[Any]) -> bool:
        process = self._busy.pop(future)
        broken = isinstance(future.exception(), BrokenProcessPool)
        self._free.append(_Process() if broken else process)
        return broken


class _Process:
    """A pool of one process. It is made afresh and not forked: engines and compiled code have threads of their own."""

    def __init__(self) -> None:
        self.pool = ProcessPoolExecutor(1, mp_context=get_context("spawn"), initializer=_begin)
        self._number = self.pool.submit(os.getpid)
        self._packed: Packed | None = None

    def submit(self, packed: Packed, job: Any) -> Future[Any]:
        """Hand out a job, and the task where it is not the one before."""
        if packed is self._packed:
            return self.pool.submit(call_again, job)
        future = self.pool.submit(call_and_keep, packed, job)
        self._packed = packed
        return future

    def kill(self) -> None:
        """End the process, whatever it does."""
        if self._number.exception() is None:
            with contextlib.suppress(ProcessLookupError):
                os.kill(self._number.result(), signal.SIGTERM)


def _begin() -> None:
    """Leave Ctrl-C to the process that started this one, and do not outlive it."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    parent = parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)
