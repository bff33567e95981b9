"""What the whole library has to say about one document, as the text that a person reads."""

from pathlib import Path

from neuromech.components.catalogue import Catalogue
from neuromech.errors import DocumentError
from neuromech.graph.build import build
from neuromech.graph.check import check
from neuromech.spec.includes import compose
from neuromech.spec.load import load
from neuromech.study.checks import check_study


def diagnose(path: Path) -> str:
    """Return every problem of a document on a line of its own; empty for a good document."""
    try:
        graph = build(load(path, catalogue=Catalogue.built_in()))
        check(graph)
        if graph.document.experiment.study is not None:
            check_study(graph, compose(path))
    except DocumentError as error:
        return "".join(f"{problem}\n" for problem in error.problems)
    return ""
