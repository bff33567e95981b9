"""The runs that claims need: each changed document is simulated once for each seed, however many claims look at it."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from neuromech.analyse.checks import claim_problems
from neuromech.analyse.claims import Verdict, judge
from neuromech.analyse.measures import MeasuredValue, measure
from neuromech.compiler.lower import lower
from neuromech.compiler.program import Program
from neuromech.components.catalogue import Catalogue
from neuromech.errors import DocumentError
from neuromech.graph.build import build
from neuromech.graph.check import check
from neuromech.simulate.recording import Recording
from neuromech.simulate.run import simulate
from neuromech.spec.document import Document
from neuromech.spec.load import load
from neuromech.spec.model import Claim

Values = Mapping[str, str | int | float | bool]


@dataclass(frozen=True, slots=True)
class Variant:
    """A document with changes, each as in `--set`."""

    file: Path
    overrides: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Plan:
    """What the claims of a document need.

    Args:
        document: the document as written.
        variants: for each claim the variants that it judges, in the order of `neuromech.analyse.claims.judge`.
        seeds: for each claim how many seeds each variant is run with.
    """

    document: Document
    variants: Mapping[str, tuple[Variant, ...]]
    seeds: Mapping[str, int]

    def claims_about(self, variant: Variant) -> list[str]:
        """Return the claims that look at a variant."""
        return [identifier for identifier, variants in self.variants.items() if variant in variants]

    def distinct(self) -> list[Variant]:
        """Return the variants without repetition, in the order in which claims name them."""
        return list(dict.fromkeys(variant for variants in self.variants.values() for variant in variants))

    def repetitions(self, variant: Variant) -> int:
        """Return with how many seeds a variant is run."""
        return max(self.seeds[identifier] for identifier in self.claims_about(variant))

    def runs(self) -> int:
        """Return how many runs the plan has."""
        return sum(self.repetitions(variant) for variant in self.distinct())


def check_claims(document: Document) -> None:
    """Refuse claims that no run could judge, before anything runs.

    Raises:
        DocumentError: a claim names no measure, leaves out what its measure needs, or expects what does not fit it.
    """
    problems = claim_problems(document)
    if problems:
        raise DocumentError(problems)


def plan(document: Document, seeds: int | None = None) -> Plan:
    """Return the runs that the claims of a document need.

    Args:
        document: the document.
        seeds: how many seeds each claim is repeated with; what the claims say where None is given.

    Raises:
        DocumentError: a claim names no measure, leaves out what its measure needs, or expects what does not fit it.
    """
    check_claims(document)
    claims = document.experiment.claims
    variants = {identifier: _variants(document, identifier, claim) for identifier, claim in claims.items()}
    return Plan(document, variants, {identifier: seeds or claim.seeds for identifier, claim in claims.items()})


def carry_out(plan: Plan, progress: Callable[[str], None] | None = None) -> list[Verdict]:
    """Run a plan and judge the claims.

    Seeds count up from the seed of each variant's protocol.

    Args:
        plan: the plan.
        progress: gets the words for each run before it starts.

    Raises:
        DocumentError: a variant is wrong.
        MeasureError: an argument or the expectation of a claim does not fit what is measured.
        RecordingError: a claim looks at a signal that is not recorded.
    """
    claims = plan.document.experiment.claims
    measured: dict[tuple[str, Variant], list[MeasuredValue]] = {}
    for variant in plan.distinct():
        program = _program(variant)
        for repetition in range(plan.repetitions(variant)):
            if progress is not None:
                progress(_words(variant, repetition))
            recording = _simulate(program, repetition)
            for identifier in plan.claims_about(variant):
                if repetition < plan.seeds[identifier]:
                    value = measure(recording, claims[identifier].measure)
                    measured.setdefault((identifier, variant), []).append(value)
    return [
        judge(
            plan.document.experiment.name, identifier, claims[identifier], [measured[identifier, v] for v in variants]
        )
        for identifier, variants in plan.variants.items()
    ]


def judge_run(document: Document, recording: Recording) -> list[Verdict]:
    """Judge those claims that need no other run than the one that was recorded.

    Raises:
        MeasureError: a claim names no measure, or its arguments or expectation do not fit.
        RecordingError: a claim looks at a signal that is not recorded.
    """
    return [
        judge(document.experiment.name, identifier, claim, [[measure(recording, claim.measure)]])
        for identifier, claim in document.experiment.claims.items()
        if needs_one_run(claim)
    ]


def all_met(verdicts: Iterable[Verdict]) -> bool:
    """Tell whether every claim is met."""
    return all(verdict.verdict == "met" for verdict in verdicts)


def needs_one_run(claim: Claim) -> bool:
    """Tell whether one run of the document as written can judge a claim; `verify` repeats it over its seeds."""
    return not (claim.set or claim.sweep or claim.compare or claim.compare_with)


def _variants(document: Document, identifier: str, claim: Claim) -> tuple[Variant, ...]:
    own = Variant(document.file, _overrides(claim.set))
    if claim.sweep:
        changes = ({path: value} for path, values in claim.sweep.items() for value in values)
        return tuple(Variant(document.file, own.overrides + _overrides(change)) for change in changes)
    if claim.compare or claim.compare_with:
        other = _other_file(document, identifier, claim)
        return own, Variant(other, own.overrides + _overrides(claim.compare))
    return (own,)


def _other_file(document: Document, identifier: str, claim: Claim) -> Path:
    """Return the file of `compare_with`, which stands relative to the file that names it."""
    if claim.compare_with is None:
        return document.file
    mark = document.mark(f"claims.{identifier}.compare_with")
    return (Path(mark.file) if mark else document.file).parent / claim.compare_with


def _overrides(values: Values) -> tuple[str, ...]:
    return tuple(f"{path}={str(value).lower() if isinstance(value, bool) else value}" for path, value in values.items())


def _program(variant: Variant) -> Program:
    graph = build(load(variant.file, catalogue=Catalogue.installed(), overrides=variant.overrides))
    check(graph)
    return lower(graph)


def _simulate(program: Program, repetition: int) -> Recording:
    seed = program.graph.document.experiment.protocol.seed + repetition
    return simulate(program, seed=seed)


def _words(variant: Variant, repetition: int) -> str:
    changes: Sequence[str] = (variant.file.name, *variant.overrides, *([f"seed {repetition}"] if repetition else []))
    return ", ".join(changes)
