"""What can be said about the claims of a document before anything runs."""

from neuromech.analyse.expectations import Expectation, written_unit
from neuromech.analyse.kinds import RESULT_UNITS, MeasureKind
from neuromech.analyse.reach import Possible
from neuromech.analyse.table import measure_kind
from neuromech.errors import MeasureError, Problem, did_you_mean
from neuromech.spec.document import Document
from neuromech.spec.model import Claim


def claim_problems(document: Document) -> list[Problem]:
    """Return what is wrong with the measures and expectations of a document's claims, in authored order."""
    found = [_problem(document, name, claim) for name, claim in document.experiment.claims.items()]
    return [problem for problem in found if problem is not None]


def _problem(document: Document, name: str, claim: Claim) -> Problem | None:
    path = f"claims.{name}.measure"
    try:
        kind = measure_kind(claim.measure)
        path = f"claims.{name}.expected"
        unit = _unit(claim, kind)
        expectation = Expectation(claim.expected, unit)
    except (MeasureError, ValueError) as error:
        message, _, hint = str(error).partition(". Hint: ")
        return document.problem("bad-claim", path, message, hint=hint or None)
    possible, words = _possible(claim, kind)
    if possible.meeting(expectation, claim.expected.equals) is not None:
        return None
    word = claim.expected.equals
    closest = None if word is None else did_you_mean(word, possible.words or ())
    message = words + possible.refusal(claim.measure.kind, unit)
    return document.problem("impossible", path, message, expectation.text(), closest)


def _possible(claim: Claim, kind: MeasureKind) -> tuple[Possible, str]:
    """Return what can be judged, and in words what it is of the measure where that is not its value."""
    possible = Possible.of(kind)
    if claim.compare or claim.compare_with:
        return possible.ratio(), "is a ratio and "
    if claim.sweep and kind.result != "text":
        return possible.difference(), "is a difference and "
    return possible, ""


def _unit(claim: Claim, kind: MeasureKind) -> str | None:
    """Return the unit of what is judged; of a measure in the signal's unit, the one that the author wrote."""
    if claim.compare or claim.compare_with:
        if kind.result == "text":
            raise MeasureError("a measure that gives a text cannot be compared")
        return ""
    if kind.result == "signal":
        return written_unit(claim.expected)
    return RESULT_UNITS[kind.result]
