"""The runs of one candidate: each scenario with each of its seeds."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final, Self

import numpy as np

from neuromech.spec.document import Document
from neuromech.spec.study import Scenario

_CONFIRMATION: Final = 0
"""Key of the stream that the seeds of a confirmation are drawn from; those of generations have none."""


@dataclass(frozen=True, slots=True)
class PlannedRun:
    """A run that every candidate makes.

    Args:
        scenario: name of the scenario, empty where the study has none.
        seed: its seed; None where one is drawn for each generation.
        draw: which of the drawn seeds it gets.
        weight: its part of the mean; the parts of all runs add up to 1.
    """

    scenario: str
    seed: int | None
    draw: int
    weight: float


@dataclass(frozen=True, slots=True)
class Scenarios:
    """The runs of a candidate, and their seeds.

    Args:
        runs: scenario after scenario, drawn seeds before fixed ones.
        overrides: what each scenario changes, by its name, as for `--set`.
        seed: of the study.
    """

    runs: tuple[PlannedRun, ...]
    overrides: Mapping[str, tuple[str, ...]]
    seed: int

    @classmethod
    def of(cls, document: Document) -> Self:
        """Return the scenarios of a document with a study; without any, the document itself is the only one."""
        return cls._planned(document, _written(document))

    @classmethod
    def confirming(cls, document: Document, seeds: int) -> Self:
        """Return the same scenarios, each with this many seeds that no generation draws, in place of its own."""
        study = document.experiment.study
        stream = np.random.SeedSequence(study.seed if study else 0, spawn_key=(_CONFIRMATION,))
        fresh = {"seeds": None, "fixed_seeds": tuple(map(int, stream.generate_state(seeds, np.uint32)))}
        written = {name: one.model_copy(update=fresh) for name, one in _written(document).items()}
        return cls._planned(document, written)

    @classmethod
    def _planned(cls, document: Document, scenarios: Mapping[str, Scenario]) -> Self:
        study, own = document.experiment.study, document.experiment.protocol.seed
        total = sum(scenario.weight for scenario in scenarios.values())
        runs = [run for name, one in scenarios.items() for run in _runs(name, one, one.weight / total, own)]
        overrides = {name: written_overrides(scenario.set) for name, scenario in scenarios.items()}
        return cls(tuple(runs), overrides, study.seed if study else 0)

    def seeds(self, generation: int) -> tuple[int, ...]:
        """Return the seed of every run in a generation, the same for all of its candidates.

        The k-th drawn seed of a generation is the same in all scenarios, so that they differ in nothing else.
        """
        draws = 1 + max((run.draw for run in self.runs if run.seed is None), default=-1)
        drawn = np.random.SeedSequence([self.seed, generation]).generate_state(draws, np.uint32) if draws else ()
        return tuple(int(drawn[run.draw]) if run.seed is None else run.seed for run in self.runs)

    @property
    def weights(self) -> tuple[float, ...]:
        """The part that each run has in a mean."""
        return tuple(run.weight for run in self.runs)


def written_overrides(values: Mapping[str, str | int | float | bool]) -> tuple[str, ...]:
    """Return changes of a document as texts for `--set`."""
    return tuple(f"{path}={str(value).lower() if isinstance(value, bool) else value}" for path, value in values.items())


def _written(document: Document) -> Mapping[str, Scenario]:
    study = document.experiment.study
    return (study.scenarios if study else {}) or {"": Scenario()}


def _runs(name: str, scenario: Scenario, weight: float, own: int) -> list[PlannedRun]:
    fixed = scenario.fixed_seeds or (() if scenario.seeds else (own,))
    drawn = range(scenario.seeds or 0)
    part = weight / (len(fixed) + len(drawn))
    return [PlannedRun(name, None, draw, part) for draw in drawn] + [PlannedRun(name, one, 0, part) for one in fixed]
