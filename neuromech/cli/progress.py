"""The progress bar of a run: simulated time, real-time factor, time to go."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager

from rich.progress import BarColumn, Progress, ProgressColumn, Task, TextColumn, TimeRemainingColumn
from rich.text import Text

from neuromech.cli.consoles import notes


class RealTimeFactorColumn(ProgressColumn):
    """Simulated seconds per second on the clock."""

    def render(self, task: Task) -> Text:
        """Return the factor since the start, or nothing before the first step."""
        if not task.completed or not task.elapsed:
            return Text("")
        return Text(f"{task.completed / task.elapsed:.3g} × real time")


@contextmanager
def simulated_time(duration: float, shown: bool) -> Iterator[Callable[[float], None]]:
    """Show a bar on stderr while the block runs; yield what takes the simulated time (s) of a run of `duration` (s)."""
    if not shown:
        yield lambda time: None
        return
    columns = (
        TextColumn("simulating"),
        BarColumn(),
        TextColumn("{task.completed:.2f} of {task.total:g} s"),
        RealTimeFactorColumn(),
        TimeRemainingColumn(),
    )
    with Progress(*columns, console=notes()) as progress:
        task = progress.add_task("", total=duration)
        yield lambda time: progress.update(task, completed=time)


@contextmanager
def counted(total: int, shown: bool) -> Iterator[Callable[[str], None]]:
    """Show a bar on stderr for `total` runs; yield what takes the name of the run that is about to start."""
    if not shown:
        yield lambda name: None
        return
    columns = (TextColumn("run {task.completed:.0f} of {task.total:.0f}"), BarColumn(), TimeRemainingColumn())
    with Progress(*columns, TextColumn("{task.description}"), console=notes()) as progress:
        task = progress.add_task("", total=total, completed=-1)
        yield lambda name: progress.update(task, advance=1, description=name)
        progress.update(task, completed=total, description="")


@contextmanager
def drawn(shown: bool) -> Iterator[Callable[[int, int], None]]:
    """Show a bar on stderr while a film is drawn; yield what takes the number of pictures so far, and of all."""
    if not shown:
        yield lambda number, count: None
        return
    columns = (TextColumn("picture {task.completed:.0f} of {task.total:.0f}"), BarColumn(), TimeRemainingColumn())
    with Progress(*columns, console=notes()) as progress:
        task = progress.add_task("", total=1)
        yield lambda number, count: progress.update(task, completed=number, total=count)
