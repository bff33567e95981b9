"""Clocks that must divide."""

from neuromech.errors import Problem
from neuromech.units import Quantity


def time_text(time: float) -> str:
    """Return a time (s) as text, in s or ms."""
    return f"{time:.9g} s" if time >= 1.0 else f"{1e3 * time:.9g} ms"


def whole_multiple(longer: Quantity, shorter: Quantity, path: str, name: str) -> Problem | None:
    """Return a problem unless the time `longer`, written at `path`, is a whole number of `shorter` (both in s).

    Args:
        longer: the longer time.
        shorter: the shorter time, greater than zero.
        path: dotted path of the longer one, for the message.
        name: dotted path of the shorter one, for the message.
    """
    ratio = longer / shorter
    if ratio > 0.5 and abs(ratio - round(ratio)) <= 1e-9 * ratio:
        return None
    nearest = time_text(max(1, round(ratio)) * shorter)
    message = f"must be a whole number of {name}, which is {time_text(shorter)}"
    return Problem("clocks", path, message, time_text(longer), f"the nearest is {nearest}")
