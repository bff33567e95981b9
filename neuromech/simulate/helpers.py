"""The other threads of a large network."""

from collections.abc import Iterator
from contextlib import contextmanager
from threading import Thread

from neuromech.compiler.program import Memory, Program
from neuromech.compiler.team import DONE, HELPERS, ORDER, STOP


@contextmanager
def helpers(program: Program, memory: Memory) -> Iterator[None]:
    """Keep the threads of a program at hand, all but the one that runs the step."""
    if program.threads == 1:
        yield
        return
    module, team = program.module, memory.I[program.header["team"] :]
    team[ORDER] = STOP
    module.help(*memory.buffers[1:])  # Compiles in this thread: what goes wrong is raised here.
    team[[ORDER, DONE, HELPERS]] = 0, 0, program.threads - 1
    threads = [Thread(target=module.help, args=memory.buffers[1:]) for _ in range(program.threads - 1)]
    for thread in threads:
        thread.start()
    try:
        yield
    finally:
        module.stop(memory.I)
        for thread in threads:
            thread.join()
        team[HELPERS] = 0
