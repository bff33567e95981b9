"""The import of PyBullet's Python module, which greets on stderr; every other message passes."""

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from tempfile import TemporaryFile

_GREETING = b"pybullet build time:"


@contextmanager
def _without_greeting() -> Iterator[None]:
    """Hold back what is written to file descriptor 2 in the block, and write it afterwards without the greeting."""
    try:
        stderr = os.dup(2)
    except OSError:  # There is no stderr to keep clean.
        yield
        return
    with TemporaryFile() as held:
        if sys.stderr is not None:
            sys.stderr.flush()
        os.dup2(held.fileno(), 2)
        try:
            yield
        finally:
            os.dup2(stderr, 2)
            os.close(stderr)
            held.seek(0)
            said = b"".join(line for line in held if not line.startswith(_GREETING))
            if said:
                os.write(2, said)


with _without_greeting():
    import pybullet as pybullet
