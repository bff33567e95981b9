"""Storing beside the work: a thread writes to the database, strictly in the order in which it is asked to.

Evaluations that follow each other within a quarter of a second are written together: a transaction for each would take
longer than the rest of storing it.
"""

import threading
import time
from collections import deque
from collections.abc import Callable, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from types import TracebackType
from typing import Self

from neuromech.study.evaluation import Evaluation, Job
from neuromech.study.space import Space
from neuromech.study.storage import Boundary, StoredStudy

_TOGETHER = 0.25
"""For how long (s) after a write evaluations are gathered."""


class Writer:
    """Writes a study in a thread of its own; to be used in a `with` block, which ends when all is written.

    After a failure nothing is written any more, so that what is stored never has a gap. The failure is raised by the
    next call, or by the end of the block.
    """

    def __init__(self, stored: StoredStudy, space: Space) -> None:
        """Start the thread."""
        self._stored = stored
        self._space = space
        self._thread = ThreadPoolExecutor(1, thread_name_prefix="storage")
        self._asked: deque[Future[None]] = deque()
        self._broken = False
        self._gathering = threading.Lock()
        self._gathered: list[Evaluation] | None = None
        self._ends = threading.Event()
        self._written = -_TOGETHER

    def begin(self, jobs: Sequence[Job]) -> None:
        """Store which evaluations come next.

        Raises:
            StudyError: something could not be written.
        """
        self._close_gathered()
        self._write(lambda: self._stored.begin(jobs, self._space))

    def finish(self, evaluation: Evaluation) -> None:
        """Store an evaluation, with those that follow soon.

        Raises:
            StudyError: something could not be written.
        """
        self._raise()
        with self._gathering:
            if self._gathered is not None:
                self._gathered.append(evaluation)
                return
            gathered = self._gathered = [evaluation]
        self._write(lambda: self._finish(gathered))

    def set_boundary(self, boundary: Boundary) -> None:
        """Store where the study stands between two generations.

        Raises:
            StudyError: something could not be written.
        """
        self._close_gathered()
        self._write(lambda: self._stored.set_boundary(boundary))

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self._ends.set()
        self._thread.shutdown(wait=True)
        if error is None:
            self._raise()

    def _finish(self, gathered: list[Evaluation]) -> None:
        self._ends.wait(self._written + _TOGETHER - time.monotonic())
        with self._gathering:
            if self._gathered is gathered:
                self._gathered = None
        self._stored.finish(gathered)
        self._written = time.monotonic()

    def _close_gathered(self) -> None:
        with self._gathering:
            self._gathered = None

    def _write(self, write: Callable[[], None]) -> None:
        self._raise()
        self._asked.append(self._thread.submit(self._unless_broken, write))

    def _raise(self) -> None:
        while self._asked and self._asked[0].done():
            self._asked.popleft().result()

    def _unless_broken(self, write: Callable[[], None]) -> None:
        if not self._broken:
            self._broken = True
            write()
            self._broken = False
