"""What a process or a machine is given to do: pickled, and only for those that would do it the same way."""

import pickle
import platform
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, lru_cache
from importlib.metadata import version
from typing import Any, Self

from neuromech.errors import StudyError

PACKAGES = ("neuromech", "numpy", "numba")
"""What must be of the same version wherever evaluations run."""

_latest: list[Callable[[Any], Any]] = []


@dataclass(frozen=True, slots=True)
class Packed:
    """A task on its way to another process, and the versions of the packages that made it."""

    task: bytes
    versions: tuple[str, ...]

    @classmethod
    def of(cls, task: Callable[[Any], Any]) -> Self:
        """Pack a task."""
        return cls(pickle.dumps(task), _versions())


def call(packed: Packed, job: Any) -> Any:
    """Call a packed task with a job, in the process that works.

    Raises:
        StudyError: the packages there are others, which might give other numbers.
    """
    return _unpacked(packed)(job)


def call_and_keep(packed: Packed, job: Any) -> Any:
    """Do the same and keep the task for `call_again`.

    Raises:
        StudyError: as for `call`.
    """
    _latest[:] = [_unpacked(packed)]
    return call_again(job)


def call_again(job: Any) -> Any:
    """Call the task that this process was given last with another job: a packed task is large."""
    (task,) = _latest
    return task(job)


@lru_cache(maxsize=4)
def _unpacked(packed: Packed) -> Callable[[Any], Any]:
    """Return a task, the same object for the same bytes."""
    own = _versions()
    if packed.versions != own:
        there, here = ", ".join(own), ", ".join(packed.versions)
        hint = "install the same versions everywhere"
        raise StudyError(f"the worker on {platform.node()} has {there}; the search has {here}. Hint: {hint}")
    found: Callable[[Any], Any] = pickle.loads(packed.task)
    return found


@cache
def _versions() -> tuple[str, ...]:
    return tuple(f"{package} {version(package)}" for package in PACKAGES)
