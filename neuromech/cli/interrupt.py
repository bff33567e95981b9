"""Ctrl-C and SIGTERM: the first one asks to stop, the second one ends at once."""

import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any

SIGNALS = (signal.SIGINT, signal.SIGTERM)


@contextmanager
def stop_on_signals(first: Callable[[], None]) -> Iterator[Callable[[], bool]]:
    """Yield a function that tells whether the user, or the system, has asked to stop.

    Args:
        first: called at the first signal. The second one raises `KeyboardInterrupt`.
    """
    asked = False

    def handle(_number: int, _frame: FrameType | None) -> None:
        nonlocal asked
        if asked:
            raise KeyboardInterrupt
        asked = True
        first()

    before: dict[signal.Signals, Any] = {number: signal.signal(number, handle) for number in SIGNALS}
    try:
        yield lambda: asked
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
