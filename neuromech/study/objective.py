"""From a recording to points, from the runs of a candidate to its score: weighted sums, and stages of them."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal, Self

from neuromech.analyse.expectations import Expectation
from neuromech.analyse.measures import measure
from neuromech.simulate.recording import Recording
from neuromech.spec.measure import Measure
from neuromech.spec.study import Condition, Study
from neuromech.study.score import Score
from neuromech.study.terms import JudgedTerm

Value = float | str


@dataclass(frozen=True, slots=True)
class Grade:
    """What one run is worth.

    Args:
        measures: values in SI units or the words that say why there is none, by the name of term or condition.
        points: weighted points of each term.
        entered: for each stage whether the run satisfies its conditions.
        sums: for each stage the sum of its points.
    """

    measures: Mapping[str, Value]
    points: Mapping[str, float]
    entered: tuple[bool, ...]
    sums: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class JudgedStage:
    """A stage: conditions and terms by the names under which they are stored."""

    conditions: Mapping[str, Condition]
    terms: Mapping[str, JudgedTerm]


@dataclass(frozen=True, slots=True)
class Objective:
    """What a study strives for.

    A candidate is in the last stage to which every run of it satisfies all conditions of that stage and of those before
    it (Dzeladini 2013, section 2.2.1.2); its value is the sum of that stage's terms, combined over runs. An objective
    without stages is one stage that is open to all.
    """

    stages: tuple[JudgedStage, ...]
    combine: Literal["mean", "worst"]

    @classmethod
    def of(cls, study: Study) -> Self:
        """Return the objective of a study that was checked."""
        if study.objective.terms:
            terms = {name: JudgedTerm.of(term) for name, term in study.objective.terms.items()}
            return cls((JudgedStage({}, terms),), study.combine)
        stages = (
            JudgedStage(
                {f"{stage}.enter.{name}": condition for name, condition in one.enter.items()},
                {f"{stage}.{name}": JudgedTerm.of(term) for name, term in one.terms.items()},
            )
            for stage, one in study.objective.stages.items()
        )
        return cls(tuple(stages), study.combine)

    def measures(self) -> list[Measure]:
        """Return everything that is measured."""
        found = [condition.measure for stage in self.stages for condition in stage.conditions.values()]
        terms = [judged.term for stage in self.stages for judged in stage.terms.values()]
        return [*found, *(one for term in terms for one in term.factors.values())]

    def grade(self, recording: Recording) -> Grade:
        """Judge one run.

        Raises:
            MeasureError: a measure or an expectation does not fit the signals.
            RecordingError: a signal was not recorded.
        """
        measures: dict[str, Value] = {}
        points: dict[str, float] = {}
        entered, sums = [], []
        for stage in self.stages:
            entered.append(all([_satisfies(recording, *item, measures) for item in stage.conditions.items()]))
            for name, judged in stage.terms.items():
                factors = {key: measure(recording, one) for key, one in judged.term.factors.items()}
                measures[name] = judged.value(factors)
                points[name] = judged.weighted(measures[name])
            sums.append(sum(points[name] for name in stage.terms))
        return Grade(measures, points, tuple(entered), tuple(sums))

    def score(self, grades: Sequence[Grade], weights: Sequence[float]) -> Score:
        """Return the score of a candidate.

        Args:
            grades: of its runs, at least one.
            weights: of the runs in the mean; they add up to 1.
        """
        reached = 0
        while reached + 1 < len(self.stages) and all(grade.entered[reached + 1] for grade in grades):
            reached += 1
        sums = [grade.sums[reached] for grade in grades]
        if self.combine == "worst":
            return Score(reached, min(sums))
        return Score(reached, sum(weight * value for weight, value in zip(weights, sums, strict=True)))


def _satisfies(recording: Recording, name: str, condition: Condition, measures: dict[str, Value]) -> bool:
    measured = measure(recording, condition.measure)
    measures[name] = measured.value
    return Expectation(condition.expected, measured.unit).satisfied(measured.value)
