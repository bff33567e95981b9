"""Where the runs of a command take place."""

from neuromech.cli.terminal import of_extra
from neuromech.errors import DocumentError, Problem
from neuromech.study.executors import Executor, ProcessExecutor


def check_executor(workers: int | None, dask: str | None) -> None:
    """Refuse two places at once.

    Raises:
        DocumentError: processes and a cluster are asked for.
    """
    if dask is not None and workers is not None:
        message, hint = "goes with '--workers' only on this machine", "the cluster says how many workers it has"
        raise DocumentError([Problem("two-executors", "--dask", message, hint=hint)])


def open_executor(workers: int | None, dask: str | None) -> Executor:
    """Return the workers of a Dask scheduler, or processes of this machine where no address is given.

    Raises:
        MissingExtraError: Dask is asked for and not installed.
        StudyError: no scheduler answers there.
    """
    if dask is None:
        return ProcessExecutor(workers)
    with of_extra("study"):
        from neuromech.study.dask_executor import DaskExecutor
    return DaskExecutor(dask)
