"""The progress of a search: a live line in a terminal, a line for each generation elsewhere."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from datetime import timedelta

from rich.progress import BarColumn, Progress, TextColumn

from neuromech.cli.consoles import notes
from neuromech.cli.scores import score_text
from neuromech.cli.terminal import note
from neuromech.study.progress import Report, Standing


@contextmanager
def search_progress(stages: Sequence[str], shown: bool) -> Iterator[Report]:
    """Show progress on stderr while the block runs; yield what takes the standing of the search."""
    if not shown:
        yield lambda standing: None
    elif not notes().is_terminal:
        lines = _Lines(stages)
        yield lines
        lines.end()
    else:
        with Progress(BarColumn(20), TextColumn("{task.description}", markup=False), console=notes()) as progress:
            task = progress.add_task("preparing", total=None)
            yield lambda standing: progress.update(
                task, description=standing_text(standing, stages), completed=standing.done, total=standing.total
            )


def standing_text(standing: Standing, stages: Sequence[str]) -> str:
    """Return how far a search is, on one line."""
    parts = [
        "confirming" if standing.is_confirming else f"generation {standing.generation}",
        f"{standing.done} of {standing.total}",
        f"best {score_text(standing.best, stages)}",
        f"median {score_text(standing.median, stages)}",
        f"{standing.rate:.3g}/s",
        f"{standing.real_time_factor:.3g} × real time",
    ]
    if standing.remaining is not None:
        parts.append(f"{timedelta(seconds=round(standing.remaining))} to go")
    parts.append(f"{standing.crashed} crashed, {standing.fallen} fell")
    return ", ".join(parts)


class _Lines:
    """Writes a line at the end of each generation, one at the end of the search, and one at the end."""

    def __init__(self, stages: Sequence[str]) -> None:
        self._stages = stages
        self._latest: Standing | None = None
        self._told: Standing | None = None

    def __call__(self, standing: Standing) -> None:
        if standing.is_confirming and self._latest is not None and not self._latest.is_confirming:
            self.end()
        if self._latest is not None and standing.generation > self._latest.generation:
            self._tell(standing)
        self._latest = standing

    def end(self) -> None:
        """Tell what was not told yet."""
        if self._latest is not None and self._latest is not self._told:
            self._tell(self._latest)

    def _tell(self, standing: Standing) -> None:
        note(standing_text(standing, self._stages))
        self._told = standing
