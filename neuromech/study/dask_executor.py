"""Evaluations on the workers of a Dask cluster: other machines, SLURM, clouds."""

from collections.abc import Callable
from concurrent.futures import CancelledError, Future
from functools import partial
from typing import Any

from distributed import Client, KilledWorker

from neuromech.errors import StudyError
from neuromech.study.executors import Executor
from neuromech.study.tasks import Packed, call

CONNECTION_SECONDS = 10.0
QUEUE = 2
"""Jobs handed out for each thread of a worker: one runs, the next one is there already."""


_client: Callable[..., Any] = partial(Client, set_as_default=False)


class DaskExecutor(Executor):
    """The workers of a running Dask scheduler. Jobs of one that dies go to others; later ones get jobs too.

    How often a job is tried again is Dask's setting `distributed.scheduler.allowed-failures`. Workers need this package
    and the files of the document, at the same place.
    """

    def __init__(self, address: str, patience: float = CONNECTION_SECONDS) -> None:
        """Connect.

        Args:
            address: of the scheduler, like `tcp://127.0.0.1:8786`.
            patience: how long it is tried (s).

        Raises:
            StudyError: no scheduler answers there.
        """
        self._address = address
        try:
            self._client = _client(address, timeout=patience)
        except (OSError, ValueError) as error:
            hint = "start one with 'dask scheduler', or leave out '--dask'"
            raise StudyError(f"no Dask scheduler answers at {address}. Hint: {hint}") from error
        self._pool = self._client.get_executor(pure=False)

    @property
    def workers(self) -> int:
        """How many threads the workers have together."""
        return sum(self._client.nthreads().values())

    def prepare(self, function: Callable[[], None]) -> None:
        """Call a function on one worker of each machine; waits for the first worker to be there."""
        self._client.wait_for_workers(1)
        hosts = {worker["host"]: address for address, worker in self._client.scheduler_info(-1)["workers"].items()}
        for future in [self._pool.submit(function, workers=[address]) for address in hosts.values()]:
            future.result()

    def close(self) -> None:
        """Drop what is under way and disconnect."""
        self._pool.shutdown(wait=False)
        self._client.close()

    def _slots(self) -> int:
        return QUEUE * max(1, self.workers)

    def _submit(self, packed: Packed, job: Any) -> Future[Any]:
        future: Future[Any] = self._pool.submit(call, packed, job)
        return future

    def _release(self, future: Future[Any]) -> bool:
        """Tell whether several workers died of a job.

        Raises:
            StudyError: the scheduler is gone.
        """
        try:
            return isinstance(future.exception(), KilledWorker)
        except CancelledError as error:
            raise StudyError(f"the Dask scheduler at {self._address} does not answer any more") from error
