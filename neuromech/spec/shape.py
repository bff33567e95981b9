"""What may stand at a place of a document: the types of the model, asked step by step along a tree."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from types import NoneType, UnionType
from typing import Annotated, Any, Literal, Union, get_args, get_origin

from pydantic import BaseModel

from neuromech.components.base import Family
from neuromech.components.catalogue import Catalogue
from neuromech.spec.fields import KindFromKey, OfCatalogue
from neuromech.spec.node import MapNode, Node, ScalarNode, children, join
from neuromech.units import Unit


@dataclass(frozen=True, slots=True)
class Fields:
    """A map with the keys of a class, or, where `bare` is set, a bare value for that one field."""

    model: type[BaseModel]
    bare: str | None = None


@dataclass(frozen=True, slots=True)
class Names:
    """A map with keys of the author's choice; `value` is the annotation of what stands under them.

    `named` is set where the keys are names of elements, and not patterns, paths or names of other scopes.
    """

    value: Any
    named: bool


@dataclass(frozen=True, slots=True)
class Items:
    """A list; `values` are the annotations of its items, one for all where `fixed` is false."""

    values: tuple[Any, ...]
    fixed: bool


@dataclass(frozen=True, slots=True)
class Choice:
    """A map whose class is chosen by `kind`; `family` is set where the catalogue does it."""

    models: tuple[type[BaseModel], ...]
    word: str


@dataclass(frozen=True, slots=True)
class Table:
    """Components of one family as {kind: {name: {name: component}}}; a bare value gives the field `bare`."""

    family: Family
    bare: str

    @lru_cache(maxsize=256)  # noqa: B019 (a table is a value of the vocabulary, of which there are few)
    def inner(self, model: type[BaseModel]) -> Any:
        """Return the annotation of what stands under the kind of a class."""
        return dict[str, dict[str, Annotated[model, _Bare(self.bare)]]]  # type: ignore[valid-type]


@dataclass(frozen=True, slots=True)
class _Bare:
    field: str


@dataclass(frozen=True, slots=True)
class Leaf:
    """A single value. `unit` is set where it is a quantity, `words` where it is one of several words."""

    types: tuple[type, ...]
    unit: Unit | None = None
    words: tuple[Any, ...] = ()


Shape = Fields | Names | Items | Choice | Table | Leaf


@lru_cache(maxsize=4096)
def shape_of(annotation: Any, catalogue: Catalogue) -> Shape:
    """Return what an annotation of the model allows; `| None` is looked through."""
    base, marks = _peel(annotation)
    for mark in marks:
        shape = _marked(base, mark, catalogue)
        if shape is not None:
            return shape
    origin = get_origin(base)
    if isinstance(base, type) and origin is None and issubclass(base, BaseModel):
        return Fields(base)
    if origin is dict:
        key, value = get_args(base)
        return Names(value, named=key is not str)
    if origin in (tuple, list):
        values = tuple(value for value in get_args(base) if value is not Ellipsis)
        return Items(values, origin is tuple and Ellipsis not in get_args(base))
    if origin is Literal:
        return Leaf((str,), words=get_args(base))
    if origin in (Union, UnionType):
        return _union(get_args(base), catalogue)
    return Leaf((base,))


def _marked(base: Any, mark: object, catalogue: Catalogue) -> Shape | None:
    if isinstance(mark, OfCatalogue):
        kinds = catalogue.kinds(mark.family)
        return Choice(tuple(catalogue.classes[mark.family, kind] for kind in kinds), mark.family)
    if isinstance(mark, KindFromKey):
        return Table(mark.family, mark.bare)
    if isinstance(mark, Unit):
        return Leaf((float,), unit=mark)
    return Fields(base, mark.field) if isinstance(mark, _Bare) else None


def field_annotation(model: type[BaseModel], name: str) -> Any:
    """Return the annotation of a field with its marks, or None where the class has no such field."""
    return _annotations(model).get(name)


def chosen(shape: Choice, node: Node | None) -> type[BaseModel] | None:
    """Return the class that a map's `kind` chooses, or None where it chooses none."""
    kind = node.get("kind") if isinstance(node, MapNode) else None
    if not isinstance(kind, ScalarNode):
        return None
    return _by_word(shape.models).get(kind.text)


@lru_cache(maxsize=256)
def _by_word(models: tuple[type[BaseModel], ...]) -> dict[str, type[BaseModel]]:
    """Return the first class that each word chooses."""
    return {kind_word(model): model for model in reversed(models)}


def kind_word(model: type[BaseModel]) -> str:
    """Return the word that chooses a class."""
    return str(get_args(model.model_fields["kind"].annotation)[0])


def step(annotation: Any, key: str | int, node: Node | None, catalogue: Catalogue) -> Any:
    """Return the annotation one step further along a path, None where nothing may stand there.

    Args:
        annotation: the annotation here.
        key: key of a map or position in a list.
        node: the tree here, which decides between classes.
        catalogue: the vocabulary.
    """
    return _inner(shape_of(annotation, catalogue), key, node, catalogue)


def _inner(shape: Shape, key: str | int, node: Node | None, catalogue: Catalogue) -> Any:
    if isinstance(shape, Fields):
        return field_annotation(shape.model, str(key))
    if isinstance(shape, Choice):
        model = chosen(shape, node)
        return field_annotation(model, str(key)) if model else None
    if isinstance(shape, Table):
        found = catalogue.find(shape.family, str(key))
        return shape.inner(found) if found else None
    if isinstance(shape, Names):
        return shape.value
    if isinstance(shape, Items) and isinstance(key, int):
        index = key if shape.fixed else 0
        return shape.values[index] if index < len(shape.values) else None
    return None


def narrowed(annotation: Any, node: Node, catalogue: Catalogue) -> Any:
    """Return the annotation that a node is judged by: where a bare value stands for a map, that of its field."""
    return _narrowed(annotation, shape_of(annotation, catalogue), node)


def _narrowed(annotation: Any, shape: Shape, node: Node) -> Any:
    if isinstance(shape, Fields) and shape.bare and isinstance(node, ScalarNode):
        return field_annotation(shape.model, shape.bare)
    return annotation


def model_of(annotation: Any, node: Node | None, catalogue: Catalogue) -> type[BaseModel] | None:
    """Return the class whose keys a map at this place has, or None where it has none."""
    shape = shape_of(annotation, catalogue)
    if isinstance(shape, Fields):
        return shape.model
    return chosen(shape, node) if isinstance(shape, Choice) else None


def typed(node: Node, annotation: Any, catalogue: Catalogue, path: str = "") -> Iterator[tuple[str, Node, Any]]:
    """Yield (path, node, annotation) for all of a tree that the model knows, in authored order."""
    waiting = [(path, node, annotation)]
    while waiting:
        path, node, annotation = waiting.pop()
        shape = shape_of(annotation, catalogue)
        yield path, node, _narrowed(annotation, shape, node)
        found = ((key, child, _inner(shape, key, node, catalogue)) for key, child in reversed(children(node)))
        waiting += [(join(path, key), child, inner) for key, child, inner in found if inner is not None]


@lru_cache(maxsize=256)
def _annotations(model: type[BaseModel]) -> dict[str, Any]:
    return {name: field.rebuild_annotation() for name, field in model.model_fields.items()}


def _peel(annotation: Any) -> tuple[Any, tuple[Any, ...]]:
    marks: tuple[Any, ...] = ()
    while True:
        if get_origin(annotation) is Annotated:
            annotation, *more = get_args(annotation)
            marks = (*marks, *more)
            continue
        if get_origin(annotation) in (Union, UnionType):
            rest = [part for part in get_args(annotation) if part is not NoneType]
            if len(rest) == 1:
                annotation = rest[0]
                continue
        return annotation, marks


def _union(parts: tuple[Any, ...], catalogue: Catalogue) -> Shape:
    shapes = [shape_of(part, catalogue) for part in parts if part is not NoneType]
    models = tuple(shape.model for shape in shapes if isinstance(shape, Fields))
    if len(models) == len(shapes):
        return Choice(models, "")
    return Leaf((*(kind for shape in shapes if isinstance(shape, Leaf) for kind in shape.types), *models))
