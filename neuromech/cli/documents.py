"""Where documents are: files and folders that the user names, and the specs that come with the package."""

from collections.abc import Iterable, Sequence
from pathlib import Path

from neuromech.components.catalogue import Catalogue
from neuromech.errors import DocumentError, Problem
from neuromech.graph.build import build
from neuromech.graph.check import check
from neuromech.graph.model import ModelGraph
from neuromech.spec.load import load

PACKAGE = Path(__file__).parents[1]


def checked_graph(path: Path, catalogue: Catalogue, overrides: Sequence[str] = ()) -> ModelGraph:
    """Return the checked graph of a document. Light: nothing that can run a simulation is imported for it.

    Raises:
        DocumentError: the document is wrong.
    """
    graph = build(load(path, catalogue=catalogue, overrides=overrides))
    check(graph)
    return graph


def document_files(paths: Iterable[Path]) -> list[Path]:
    """Return the files that are named, and every `*.yaml` below the folders that are named, without repetition.

    Raises:
        DocumentError: a path does not exist, or a folder holds no document.
    """
    found: dict[Path, None] = {}
    problems = []
    for path in paths:
        files = sorted(path.rglob("*.yaml")) if path.is_dir() else [path]
        if not path.exists():
            problems.append(Problem("no-file", "", f"{path}: there is no such file or folder"))
        elif not files:
            problems.append(Problem("no-document", "", f"{path}: the folder holds no *.yaml file"))
        found.update(dict.fromkeys(files))
    if problems:
        raise DocumentError(problems)
    return list(found)


def shipped_specs() -> Path:
    """Return the folder of the documents that come with the package: in the wheel, or beside it in a checkout."""
    packaged = PACKAGE / "_specs"
    return packaged if packaged.is_dir() else PACKAGE.parent / "specs"
