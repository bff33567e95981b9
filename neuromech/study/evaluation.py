"""What an evaluator is asked, and what it answers; both travel between processes and into storage."""

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any, Final, Literal

from neuromech.study.score import Score

Value = float | str
Parameters = Mapping[str, str]
"""What is set: name → value with unit, as written into the document."""

CENTER: Final = "center"
"""The place where the algorithm stands, beside its candidates."""

Confirms = int | Literal["center"]


@dataclass(frozen=True, slots=True)
class Job:
    """One candidate to evaluate.

    Args:
        number: of the evaluation in the study, from 0.
        generation: from 0.
        index: of the candidate in its generation, from 0.
        parameters: what it sets, name -> value with unit.
        seeds: the seed of each run, in the order of `neuromech.study.scenarios.Scenarios.runs`.
        thresholds: for each run the partial score below which it is ended early; empty where no run is.
        confirms: number of the evaluation that this one confirms after the search, or `CENTER`; None in the search.
    """

    number: int
    generation: int
    index: int
    parameters: Parameters
    seeds: tuple[int, ...]
    thresholds: tuple[Score, ...] = ()
    confirms: Confirms | None = None


@dataclass(frozen=True, slots=True)
class RunResult:
    """One run of a candidate.

    Args:
        scenario: name of the scenario, empty where the study has none.
        seed: seed of the run.
        kind: how the run ended.
        time: simulated time of the end (s).
        message: what happened; empty for a finished run.
        measures: what was measured, by the name of the term or condition (`gait.speed` within the stage `gait`): a
            number in SI units, or the words that say why there is none.
        points: weighted points of each term, by the same names.
        partial: score at the time at which hopeless runs are ended; None where the run did not reach it.
    """

    scenario: str
    seed: int
    kind: Literal["finished", "fell", "diverged", "stopped"]
    time: float
    message: str
    measures: Mapping[str, Value]
    points: Mapping[str, float]
    partial: Score | None = None

    def to_dict(self) -> dict[str, Any]:
        """Return plain values for JSON, exact."""
        plain: dict[str, Any] = {name: getattr(self, name) for name in self.__slots__}
        plain["partial"] = None if self.partial is None else asdict(self.partial)
        plain["measures"], plain["points"] = dict(self.measures), dict(self.points)
        return plain


@dataclass(frozen=True, slots=True)
class Evaluation:
    """What became of a job.

    Args:
        number: of the evaluation in the study, from 0.
        generation: from 0.
        index: of the candidate in its generation, from 0.
        parameters: what was tuned, name -> value with unit.
        runs: in the order of the seeds of the job; a crash leaves out the runs after it.
        score: None where a run crashed or diverged.
        failure: what crashed or diverged, None where nothing did.
        wall_seconds: time that the evaluation took on the clock (s).
        simulated_seconds: simulated time of all runs (s).
        confirms: number of the evaluation that this one confirms after the search, or `CENTER`; None in the search.
    """

    number: int
    generation: int
    index: int
    parameters: Parameters
    runs: tuple[RunResult, ...]
    score: Score | None
    failure: str | None
    wall_seconds: float
    simulated_seconds: float
    confirms: Confirms | None = None

    @property
    def seeds(self) -> tuple[int, ...]:
        """Seeds of the runs."""
        return tuple(run.seed for run in self.runs)

    @property
    def fell(self) -> bool:
        """Whether any run ended in a fall."""
        return any(run.kind == "fell" for run in self.runs)

    def to_dict(self) -> dict[str, Any]:
        """Return plain values for JSON, exact."""
        plain: dict[str, Any] = {name: getattr(self, name) for name in self.__slots__}
        plain["score"] = None if self.score is None else asdict(self.score)
        plain["parameters"] = dict(self.parameters)
        plain["runs"] = tuple(run.to_dict() for run in self.runs)
        return plain

    @classmethod
    def from_dict(cls, values: Mapping[str, Any]) -> "Evaluation":
        """Read back what `to_dict` gave.

        Raises:
            KeyError: something is missing.
            TypeError: something is there that does not belong to an evaluation.
        """
        runs = tuple(RunResult(**{**run, "partial": _score(run["partial"])}) for run in values["runs"])
        return cls(**{**values, "runs": runs, "score": _score(values["score"])})


def _score(values: Mapping[str, Any] | None) -> Score | None:
    return None if values is None else Score(int(values["stage"]), float(values["value"]))
