"""What can be said about the claims of a document before anything runs."""

from neuromech.analyse.expectations import Expectation, written_unit
from neuromech.analyse.kinds import RESULT_UNITS, MeasureKind
from neuromech.analyse.table import measure_kind
from neuromech.errors import MeasureError, Problem
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
        Expectation(claim.expected, _unit(claim, kind))
    except (MeasureError, ValueError) as error:
        message, _, hint = str(error).partition(". Hint: ")
        return document.problem("bad-claim", path, message, hint=hint or None)
    return None


def _unit(claim: Claim, kind: MeasureKind) -> str | None:
    """Return the unit of what is judged; of a measure in the signal's unit, the one that the author wrote."""
    if claim.compare or claim.compare_with:
        if kind.result == "text":
            raise MeasureError("a measure that gives a text cannot be compared")
        return ""
    if kind.result == "signal":
        return written_unit(claim.expected)
    return RESULT_UNITS[kind.result]
