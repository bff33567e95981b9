"""What a study is: written when it begins, compared when it is continued."""

import hashlib
from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass
from importlib.metadata import version
from typing import Any, Self

from neuromech.errors import DocumentError
from neuromech.graph.declare import body_file
from neuromech.graph.diff import ABSENT, Change
from neuromech.spec.document import Document
from neuromech.spec.node import MapNode, Node, ScalarNode
from neuromech.spec.positions import Positions
from neuromech.spec.reader import parse
from neuromech.study.space import Space

PACKAGES = ("neuromech", "numpy", "scipy", "numba", "pybullet")
_FREE = ("name", "description", "references", "claims", "sweeps", "study.evaluations", "study.confirm")
_FREE_OF_PARAMETERS = ("description", "source")


@dataclass(frozen=True, slots=True)
class Header:
    """What a study is.

    Args:
        document: name of the document.
        file: the file that the study was begun with.
        specification: the resolved document as YAML, as written.
        body: SHA-256 of the file that the body comes from, None without one.
        seed: of the study, which may be another than the document's.
        units: tuned parameter -> the unit that its values are written in.
        stages: names of the stages of the objective, none where it is a plain sum.
        versions: package -> version that the study was begun with.
    """

    document: str
    file: str
    specification: str
    body: str | None
    seed: int
    units: Mapping[str, str]
    stages: tuple[str, ...]
    versions: Mapping[str, str]

    @classmethod
    def of(cls, document: Document, seed: int) -> Self:
        """Return the header of the study of a document.

        Args:
            document: as written.
            seed: of the study.

        Raises:
            OSError: the file of the body cannot be read.
            ValueError: the document has no study.
        """
        study = document.experiment.study
        if study is None:
            raise ValueError("a document without a study has no header of one")
        return cls(
            document=document.experiment.name,
            file=str(document.file),
            specification=document.text,
            body=body_digest(document),
            seed=seed,
            units={dimension.name: dimension.unit for dimension in Space.of(document).dimensions},
            stages=tuple(study.objective.stages),
            versions={package: version(package) for package in PACKAGES},
        )

    def to_dict(self) -> dict[str, Any]:
        """Return plain values for JSON."""
        return asdict(self)

    @classmethod
    def from_dict(cls, values: Mapping[str, Any]) -> Self:
        """Read back what `to_dict` gave."""
        return cls(**{**values, "stages": tuple(values["stages"])})

    def changes(self, now: Self) -> list[Change]:
        """Return what a study that goes on would do differently from this one, by path.

        Names, descriptions, references, claims, sweeps, the number of evaluations and `confirm` are free to change.
        """
        found = changes_of(self.specification, now.specification, _is_free)
        if self.seed != now.seed:
            found.append(Change("--seed", str(self.seed), str(now.seed)))
        if self.body != now.body:
            found.append(Change("content of body.file", str(self.body)[:12], str(now.body)[:12]))
        return found

    def other_versions(self, now: Self) -> list[Change]:
        """Return the packages that are another version now; numbers may differ in their last bits."""
        pairs = ((name, self.versions.get(name, ABSENT), one) for name, one in now.versions.items())
        return [Change(name, old, new) for name, old, new in pairs if old != new]


def changes_of(old: str, new: str, is_free: Callable[[str], bool]) -> list[Change]:
    """Return in which values two resolved documents differ, by path, and in which order; but for those free to."""
    before, now = _values(old, is_free), _values(new, is_free)
    paths = sorted({**before, **now})
    changes = [Change(path, before.get(path, ABSENT), now.get(path, ABSENT)) for path in paths]
    if before.keys() == now.keys():
        changes += [Change("order", one, other) for one, other in zip(before, now, strict=True) if one != other][:1]
    return [change for change in changes if change.old != change.new]


def body_digest(document: Document) -> str | None:
    """Return the SHA-256 of the file that the body comes from, None without one.

    Raises:
        OSError: the file cannot be read.
    """
    body = body_file(document)
    return None if body is None else hashlib.sha256(body.read_bytes()).hexdigest()


def is_free_parameter_text(path: str) -> bool:
    """Tell whether a path is about words of a parameter that no number depends on."""
    first, _, rest = path.partition(".")
    return first == "parameters" and rest.rpartition(".")[2] in _FREE_OF_PARAMETERS


def _values(specification: str, is_free: Callable[[str], bool]) -> dict[str, str]:
    """Return path -> text of every single value, and of everything empty, that is not free."""
    try:
        nodes = Positions.of(parse(specification.encode(), "stored document")).nodes
    except DocumentError as error:
        raise ValueError(f"a resolved document cannot be read: {error}") from error
    texts = {path: _text(node) for path, node in nodes.items() if not is_free(path)}
    return {path: text for path, text in texts.items() if text is not None}


def _text(node: Node) -> str | None:
    """Return what stands there where nothing stands below it."""
    if isinstance(node, ScalarNode):
        return node.text
    if isinstance(node, MapNode):
        return None if node.entries else "{}"
    return None if node.items else "[]"


def _is_free(path: str) -> bool:
    return is_free_parameter_text(path) or any(path == free or path.startswith(f"{free}.") for free in _FREE)
