"""Storing beside the work: a thread writes to the database, strictly in the order in which it is asked to."""

from collections import deque
from collections.abc import Callable, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from types import TracebackType
from typing import Self

from neuromech.study.evaluation import Evaluation, Job
from neuromech.study.space import Space
from neuromech.study.storage import Boundary, StoredStudy


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

    def begin(self, jobs: Sequence[Job]) -> None:
        """Store which evaluations come next.

        Raises:
            StudyError: something could not be written.
        """
        self._write(lambda: self._stored.begin(jobs, self._space))

    def finish(self, evaluation: Evaluation) -> None:
        """Store an evaluation.

        Raises:
            StudyError: something could not be written.
        """
        self._write(lambda: self._stored.finish(evaluation))

    def set_boundary(self, boundary: Boundary) -> None:
        """Store where the study stands between two generations.

        Raises:
            StudyError: something could not be written.
        """
        self._write(lambda: self._stored.set_boundary(boundary))

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self._thread.shutdown(wait=True)
        if error is None:
            self._raise()

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
