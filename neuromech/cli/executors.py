"""Where a command's runs take place, and how Ctrl-C ends them."""

import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType

from neuromech.errors import MissingExtraError
from neuromech.study.executors import Executor, ProcessExecutor


def open_executor(workers: int | None, dask: str | None) -> Executor:
    """Return the workers of a Dask scheduler, or processes of this machine where no address is given.

    Raises:
        MissingExtraError: Dask is asked for and not installed.
        StudyError: no scheduler answers there.
    """
    if dask is None:
        return ProcessExecutor(workers)
    try:
        from neuromech.study.dask_executor import DaskExecutor
    except ModuleNotFoundError as error:
        raise MissingExtraError(str(error.name), "study") from error
    return DaskExecutor(dask)


@contextmanager
def stopped_by_user() -> Iterator[Callable[[], bool]]:
    """Yield what tells whether Ctrl-C was pressed; a second one ends the block at once with `KeyboardInterrupt`."""
    pressed = False

    def press(_number: int, _frame: FrameType | None) -> None:
        nonlocal pressed
        if pressed:
            raise KeyboardInterrupt
        pressed = True

    before = signal.signal(signal.SIGINT, press)
    try:
        yield lambda: pressed
    finally:
        signal.signal(signal.SIGINT, before)
