"""A document with a study, ready to be searched."""

from dataclasses import dataclass
from typing import Self

from neuromech.errors import DocumentError
from neuromech.spec.document import Document
from neuromech.study.algorithms.base import Algorithm, Settings
from neuromech.study.algorithms.catalogue import AlgorithmCatalogue
from neuromech.study.confirmation import Confirmation
from neuromech.study.header import Header
from neuromech.study.scenarios import Scenarios
from neuromech.study.space import Space


@dataclass(frozen=True)
class Plan:
    """What a search needs to know of a document.

    Args:
        document: the document.
        header: what identifies the study.
        space: what is tuned.
        scenarios: the runs of each candidate.
        confirmation: how the best are confirmed; None where they are not.
        settings: of the algorithm.
        evaluations: how many candidates are evaluated.
        seed: of the study.
    """

    document: Document
    header: Header
    space: Space
    scenarios: Scenarios
    confirmation: Confirmation | None
    settings: Settings
    evaluations: int
    seed: int

    @classmethod
    def of(cls, document: Document, written: Document | None = None) -> Self:
        """Return the plan of a document.

        Args:
            document: what is searched.
            written: the same as its author wrote it, where the command line changed seed or number of evaluations.

        Raises:
            DocumentError: the document has no study, or its algorithm is wrong.
            OSError: the file of the body cannot be read.
        """
        study = document.experiment.study
        if study is None:
            hint = "write a section 'study', see docs/studies.md"
            raise DocumentError([document.problem("no-study", "", "the document has no study", None, hint)])
        return cls(
            document=document,
            header=Header.of(written or document, study.seed),
            space=Space.of(document),
            scenarios=Scenarios.of(document),
            confirmation=Confirmation.of(document),
            settings=AlgorithmCatalogue.installed().settings(study.algorithm, mark=document.mark),
            evaluations=study.evaluations,
            seed=study.seed,
        )

    def algorithm(self) -> Algorithm:
        """Return the algorithm before its first generation.

        Raises:
            MissingExtraError: it needs a library that is not installed.
        """
        start = self.space.point(self.document)
        return AlgorithmCatalogue.installed().create(self.settings, len(self.space.dimensions), self.seed, start)
