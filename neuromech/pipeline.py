"""The whole architecture on one page: a document becomes a graph, a graph a program, a program a recording, a verdict.

recording = run("specs/examples/half_centre.yaml", overrides=["parameters.drive.value=0.06"])
"""

from collections.abc import Callable, Sequence
from pathlib import Path

from neuromech.analyse.claims import Verdict
from neuromech.compiler.lower import lower
from neuromech.components.catalogue import Catalogue
from neuromech.graph.build import build
from neuromech.graph.check import check
from neuromech.graph.model import ModelGraph
from neuromech.simulate.recording import Recording
from neuromech.simulate.run import simulate
from neuromech.spec.document import Document
from neuromech.spec.load import load
from neuromech.verification import carry_out, plan


def load_document(path: str | Path, overrides: Sequence[str] = (), catalogue: Catalogue | None = None) -> Document:
    """Read a document with everything that it extends.

    Args:
        path: the file.
        overrides: changes of values, each like `solver.step=0.25 ms`.
        catalogue: the vocabulary; what is installed where None is given.

    Raises:
        DocumentError: the document is wrong; every problem is named.
    """
    return load(Path(path), catalogue=catalogue or Catalogue.installed(), overrides=overrides)


def build_graph(document: Document) -> ModelGraph:
    """Resolve the names of a document and check what they make up.

    Raises:
        DocumentError: the model is wrong; every problem is named.
    """
    graph = build(document)
    check(graph)
    return graph


def run(
    path: str | Path,
    overrides: Sequence[str] = (),
    seed: int | None = None,
    duration: float | None = None,
    progress: Callable[[float], None] | None = None,
) -> Recording:
    """Simulate a document.

    Args:
        path: the file.
        overrides: changes of values, each like `solver.step=0.25 ms`.
        seed: seed of the random initial state; the document's where None is given.
        duration: simulated time (s); the document's where None is given.
        progress: gets the simulated time (s) now and then.

    Raises:
        DocumentError: the document or the model is wrong.
    """
    program = lower(build_graph(load_document(path, overrides)))
    return simulate(program, seed=seed, duration=duration, progress=progress)


def verify(path: str | Path, seeds: int | None = None, progress: Callable[[str], None] | None = None) -> list[Verdict]:
    """Run what the claims of a document need, and judge them.

    Args:
        path: the file.
        seeds: how many seeds each claim is repeated with; what the claims say where None is given.
        progress: gets the words for each run before it starts.

    Raises:
        DocumentError: the document, or a variant that a claim asks for, is wrong.
        MeasureError: a claim asks for what is no measure, or its arguments do not fit.
        RecordingError: a claim looks at a signal that is not recorded.
    """
    return carry_out(plan(load_document(path), seeds), progress)
