"""Verdicts on claims: what was measured against what a document demands. Nothing is simulated here."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from itertools import pairwise
from statistics import median
from typing import Any, Literal

from neuromech.analyse.expectations import Expectation, Value
from neuromech.analyse.measures import MeasuredValue
from neuromech.errors import MeasureError
from neuromech.spec.model import Claim

# 0.9 of 10 values are 9 of them, whatever their product is in binary.
_ROUNDING = 1e-9


@dataclass(frozen=True, slots=True)
class Measured:
    """Median, smallest and largest of n measured values, in the unit of the expectation.

    For texts, `median` is the most frequent one, with its number where there are others, `min` and `max` the first and
    last in the alphabet. Where some runs gave a number and others could not be measured, `median` says how many could
    not and why.
    """

    median: Value
    min: Value | None
    max: Value | None
    n: int


@dataclass(frozen=True, slots=True)
class Verdict:
    """A judged claim. `published` is the source's value as written, `expected` what the document demands."""

    spec: str
    id: str
    claim: str
    source: str
    published: str | int | float | None
    expected: str
    measured: Measured
    verdict: Literal["met", "not met"]

    def as_dict(self) -> dict[str, Any]:
        """Return the verdict as plain values for JSON."""
        return asdict(self)


def judge(spec: str, identifier: str, claim: Claim, runs: Sequence[Sequence[MeasuredValue]]) -> Verdict:
    """Judge a claim by what was measured.

    The claim is met when every value of every seed satisfies the expectation, or the claim's `share` of them; a run
    that could not be measured never does. With `sweep`, what is judged is the difference between successive values of
    the swept path, seed by seed (of a measure of text, each text); with `compare`, the ratio of the claim's own run to
    the one that it is compared with.

    Args:
        spec: name of the document.
        identifier: name of the claim in it.
        claim: the claim.
        runs: measured values, one sequence of seeds for each value of the sweep, or for the claim's own run and then
            the run that it is compared with, or for the one run.

    Raises:
        MeasureError: the expectation's unit is not that of the measure, or the expectation is not complete.
    """
    try:
        values, unit = _judged_values(claim, runs)
        expectation = Expectation(claim.expected, unit)
    except MeasureError as error:
        raise MeasureError(f"claims.{identifier}.expected  {error}") from error
    satisfied = sum(expectation.satisfied(value) for value in values)
    return Verdict(
        spec,
        identifier,
        claim.claim,
        claim.source,
        claim.published,
        _preface(claim, unit) + expectation.text() + _share(claim),
        _summary([expectation.show(value) for value in values]),
        "met" if satisfied >= float(claim.share) * len(values) - _ROUNDING else "not met",
    )


def _judged_values(claim: Claim, runs: Sequence[Sequence[MeasuredValue]]) -> tuple[list[Value], str | None]:
    """Return the values that an expectation is about, and their unit."""
    unit = runs[0][0].unit
    if claim.compare or claim.compare_with:
        if unit is None:
            raise MeasureError("a measure that gives a text cannot be compared")
        own, other = runs
        return [_combine(ours, theirs, "ratio") for ours, theirs in zip(own, other, strict=True)], ""
    if claim.sweep and unit is not None:
        steps = [step for before, after in pairwise(runs) for step in zip(after, before, strict=True)]
        if not steps:
            raise MeasureError("a sweep needs at least two values")
        return [_combine(after, before, "difference") for after, before in steps], unit
    return [value.value for seeds in runs for value in seeds], unit


def _combine(first: MeasuredValue, second: MeasuredValue, how: Literal["difference", "ratio"]) -> Value:
    for value in (first.value, second.value):
        if isinstance(value, str):
            return value
    if how == "difference":
        return float(first.value) - float(second.value)
    return float(first.value) / float(second.value) if second.value else "the compared value is zero"


def _preface(claim: Claim, unit: str | None) -> str:
    if claim.compare or claim.compare_with:
        return "ratio "
    return "each step " if claim.sweep and unit is not None else ""


def _share(claim: Claim) -> str:
    return f", in {100 * float(claim.share):g} % of the runs" if float(claim.share) < 1.0 else ""


def _summary(values: Sequence[Value]) -> Measured:
    numbers = [value for value in values if not isinstance(value, str)]
    texts = [value for value in values if isinstance(value, str)]
    if not texts:
        return Measured(median(numbers), min(numbers), max(numbers), len(values))
    commonest, count = Counter(texts).most_common(1)[0]
    if not numbers and count == len(values):
        return Measured(commonest, commonest, commonest, count)
    if not numbers:
        return Measured(f"{commonest} in {count} of {len(values)}", min(texts), max(texts), len(values))
    missing = f"{commonest} in {count}" if count == len(texts) else f"no value in {len(texts)}"
    ending = "" if count == len(texts) else f", first: {texts[0]}"
    return Measured(f"{missing} of {len(values)}{ending}", min(numbers), max(numbers), len(values))
