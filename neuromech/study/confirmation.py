"""The end of a search: its best candidates once more, with seeds that none of them was chosen by.

Where each generation has seeds of its own, the best score of many belongs to a candidate that was also lucky. Runs with
fresh seeds, the same for all who are compared, have no part in that luck.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import islice
from typing import Self

from neuromech.spec.document import Document
from neuromech.study.algorithms.base import Floats
from neuromech.study.evaluation import CENTER, Confirms, Evaluation, Parameters
from neuromech.study.scenarios import Scenarios
from neuromech.study.space import Space


@dataclass(frozen=True, slots=True)
class Confirmation:
    """How a search is confirmed.

    Args:
        candidates: how many of the best are evaluated again, at most.
        scenarios: the runs of each of them.
    """

    candidates: int
    scenarios: Scenarios

    @classmethod
    def of(cls, document: Document) -> Self | None:
        """Return the confirmation of a document with a study; None where it asks for none."""
        study = document.experiment.study
        if study is None or study.confirm is None:
            return None
        return cls(study.confirm.candidates, Scenarios.confirming(document, study.confirm.seeds))


def contenders(
    evaluations: Iterable[Evaluation], centers: Floats, space: Space, count: int
) -> list[tuple[Confirms, Parameters]]:
    """Return what is confirmed: for each the evaluation that it confirms, or `CENTER`, and its parameters.

    Args:
        evaluations: of the search.
        centers: (points, dimension) where the algorithm stands.
        space: of the search.
        count: how many of the best candidates, at most; the earliest of equals, and equal parameters once.
    """
    scored = [one for one in evaluations if one.score is not None]
    scored.sort(key=lambda one: (one.score, -one.number), reverse=True)
    known: dict[tuple[str, ...], tuple[Confirms, Parameters]] = {}
    for one in scored:
        known.setdefault(tuple(one.parameters.values()), (one.number, one.parameters))
    found = dict(islice(known.items(), count))
    for parameters in map(space.parameters, centers if scored else ()):
        values = tuple(parameters.values())
        found.setdefault(values, known.get(values, (CENTER, parameters)))
    return list(found.values())
