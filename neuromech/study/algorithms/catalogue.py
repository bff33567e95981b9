"""Which algorithm each kind of a document means, and what is wrong with settings that do not fit."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from importlib.metadata import entry_points
from types import MappingProxyType
from typing import Any, Final, Self

from pydantic import ValidationError
from pydantic_core import ErrorDetails

from neuromech.errors import DocumentError, Mark, Problem, did_you_mean
from neuromech.study.algorithms.base import Algorithm, Floats, Settings
from neuromech.study.algorithms.cma_es import CmaEs
from neuromech.study.algorithms.pso import Pso
from neuromech.study.algorithms.real_coded_ga import RealCodedGa
from neuromech.units import repr_short

BUILT_IN: Final[tuple[type[Algorithm], ...]] = (RealCodedGa, Pso, CmaEs)
GROUP: Final = "neuromech.algorithms"

_WORDS: Final = {"int": "a whole number", "float": "a number", "string": "text", "bool": "true or false"}


class AlgorithmCatalogue:
    """An immutable set of algorithms, looked up by kind."""

    def __init__(self, classes: Iterable[type[Algorithm]]) -> None:
        """Collect the classes.

        Raises:
            ValueError: two classes claim the same kind.
        """
        found: dict[str, type[Algorithm]] = {}
        for cls in classes:
            kind = cls.kind_name()
            if kind in found:
                raise ValueError(
                    f"two algorithms claim the kind '{kind}': {found[kind].__qualname__} and {cls.__qualname__}"
                )
            found[kind] = cls
        self.classes: Mapping[str, type[Algorithm]] = MappingProxyType(found)

    @classmethod
    def installed(cls) -> Self:
        """Return the algorithms of this package joined with every class of the entry-point group."""
        return cls((*BUILT_IN, *(point.load() for point in entry_points(group=GROUP))))

    def kinds(self) -> tuple[str, ...]:
        """Return the kinds in alphabetical order."""
        return tuple(sorted(self.classes))

    def settings(
        self,
        written: Mapping[str, Any],
        path: str = "study.algorithm",
        mark: Callable[[str], Mark | None] = lambda _path: None,
    ) -> Settings:
        """Return the settings that a document wrote.

        Args:
            written: the section as plain values, `kind` included.
            path: where the section stands in the document.
            mark: gives the position of a path of the document.

        Raises:
            DocumentError: the kind is missing or unknown, or settings are unknown, missing or wrong.
        """
        kind = written.get("kind")
        allowed = ", ".join(self.kinds())
        if kind is None:
            problem = Problem("missing-kind", path, "'kind' is missing", None, f"allowed: {allowed}", mark(path))
            raise DocumentError([problem])
        if str(kind) not in self.classes:
            hint, at = did_you_mean(str(kind), self.kinds()), f"{path}.kind"
            raise DocumentError([Problem("unknown-kind", at, "is no algorithm", repr_short(kind), hint, mark(at))])
        settings_type = self.classes[str(kind)].settings_type
        try:
            return settings_type.model_validate(dict(written))
        except ValidationError as error:
            details = error.errors(include_url=False)
            raise DocumentError(_problems(details, settings_type, path, mark)) from error

    def create(self, settings: Settings, dimension: int, seed: int, start: Floats | None = None) -> Algorithm:
        """Return a new search.

        Args:
            settings: what `settings` returned.
            dimension: number of parameters.
            seed: of all random numbers.
            start: the document's own values as a point of the unit cube, (dimension,).

        Raises:
            MissingExtraError: the algorithm needs a library that is not installed.
        """
        kind = str(settings.model_dump()["kind"])
        return self.classes[kind](settings, dimension, seed, start)


def _problems(
    details: Iterable[ErrorDetails], model: type[Settings], path: str, mark: Callable[[str], Mark | None]
) -> Iterator[Problem]:
    for detail in details:
        context = detail.get("ctx", {})
        keys = [str(key) for key in detail["loc"]] or [str(context["key"])]
        at = ".".join((path, *keys))
        got = repr_short(detail["input"])
        if detail["type"] == "extra_forbidden":
            hint = did_you_mean(keys[0], model.model_fields)
            yield Problem("unknown-key", at, "is not known here", None, hint, mark(at))
        elif detail["type"] == "missing":
            yield Problem("missing-key", path, f"'{keys[0]}' is missing", None, None, mark(path))
        elif "message" in context:
            yield Problem(detail["type"], at, context["message"], context["got"], context["hint"], mark(at))
        else:
            yield Problem("wrong-value", at, _demand(detail), got, None, mark(at))


def _demand(detail: ErrorDetails) -> str:
    """Return what pydantic asks for, in the words of documents."""
    context, kind = detail.get("ctx", {}), detail["type"]
    if kind == "greater_than_equal":
        return f"must be at least {context['ge']}"
    if kind == "less_than_equal":
        return f"must be at most {context['le']}"
    if kind == "literal_error":
        return f"must be one of {context['expected'].replace(chr(39), '').replace(' or ', ', ')}"
    word = next((word for prefix, word in _WORDS.items() if kind.startswith(prefix)), None)
    return f"must be {word}" if word else f"does not fit: {detail['msg']}"
