"""The document as JSON Schema 2020-12, for editors.

It is wider than the loader in three ways: nothing is required where `extends` may bring it, `${…}` may stand for any
value, and `null` may stand under any key, because it removes what a base document says.
"""

import inspect
from typing import Any

from pydantic import BaseModel
from pydantic.fields import FieldInfo
from pydantic_core import PydanticUndefined

from neuromech.components.base import Component
from neuromech.components.catalogue import Catalogue
from neuromech.spec.model import Experiment, Instance
from neuromech.spec.scalars import NAME_PATTERN
from neuromech.spec.shape import Choice, Fields, Items, Leaf, Names, Table, field_annotation, kind_word, shape_of
from neuromech.units import NUMBER, Unit

Schema = dict[str, Any]

_REFERENCE: Schema = {"$ref": "#/$defs/reference"}
_NULL: Schema = {"type": "null"}
_TYPES = {str: "string", int: "integer", float: "number", bool: "boolean"}


def json_schema(catalogue: Catalogue) -> Schema:
    """Return the schema of documents that use a vocabulary."""
    return _Generator(catalogue).document()


class _Generator:
    def __init__(self, catalogue: Catalogue) -> None:
        self._catalogue = catalogue
        self._models: dict[str, type[BaseModel]] = {}
        self._definitions: dict[str, Schema] = {
            "reference": {
                "type": "string",
                "pattern": r"\$\{[^{}]+\}",
                "description": "a parameter of the document, or an argument of the module",
            }
        }

    def document(self) -> Schema:
        """Return the schema of a whole document."""
        body = self._object(Experiment)
        required = [name for name, field in Experiment.model_fields.items() if field.is_required()]
        own: Schema = {
            "$schema": {"type": "string"},
            "extends": {
                "description": "Relative path of the document that this one changes, or a list of them.",
                "anyOf": [{"type": "string"}, {"type": "array", "items": {"type": "string"}}],
            },
            "modules": {
                "description": "Templates that instances use.",
                "type": "object",
                "additionalProperties": self._module(),
            },
        }
        return {
            "$schema": "https://json-schema.org/draft/2020-12/schema",
            "title": "neuromech document",
            **body,
            "properties": {**own, **body["properties"]},
            "if": {"not": {"required": ["extends"]}},
            "then": {"required": required},
            "$defs": dict(sorted(self._definitions.items())),
        }

    def _module(self) -> Schema:
        instance = self._object(Instance)
        argument: Schema = {
            "type": ["object", "null"],
            "properties": {"default": {}, "description": {"type": "string"}},
            "additionalProperties": False,
        }
        arguments: Schema = {
            "description": "What an instance gives under 'with'; required where it has no default.",
            "type": ["object", "null"],
            "additionalProperties": argument,
        }
        return {
            **instance,
            "description": "A template: a scope with ${argument} in it.",
            "properties": {"arguments": arguments, **instance["properties"]},
        }

    def _object(self, model: type[BaseModel]) -> Schema:
        properties = {name: self._field(model, name, field) for name, field in model.model_fields.items()}
        return {
            "description": _description(model),
            "type": "object",
            "properties": properties,
            "additionalProperties": False,
        }

    def _field(self, model: type[BaseModel], name: str, field: FieldInfo) -> Schema:
        annotation = field_annotation(model, name)
        schema = self._value(annotation)
        words = [field.description, self._meaning(annotation, field)]
        text = "; ".join(word for word in words if word)
        return {"description": text, **schema} if text else schema

    def _meaning(self, annotation: Any, field: FieldInfo) -> str:
        shape = shape_of(annotation, self._catalogue)
        unit = shape.unit if isinstance(shape, Leaf) else None
        words = [unit_words(unit)] if unit else []
        if field.is_required():
            words.append("required")
        elif field.default not in (None, PydanticUndefined) and isinstance(shape, Leaf):
            words.append(f"default {unit.written(field.default) if unit else field.default}")
        return "; ".join(word for word in words if word)

    def _value(self, annotation: Any) -> Schema:
        return {"anyOf": [self._schema(annotation), _REFERENCE, _NULL]}

    def _schema(self, annotation: Any) -> Schema:
        shape = shape_of(annotation, self._catalogue)
        if isinstance(shape, Table):
            return self._table(shape)
        if isinstance(shape, Fields):
            return self._fields(shape)
        if isinstance(shape, Choice):
            return self._choice(shape)
        if isinstance(shape, Names):
            pattern = rf"{NAME_PATTERN}|\$\{{" if shape.named else ".+"
            value = self._value(shape.value)
            return {"type": "object", "propertyNames": {"pattern": pattern}, "additionalProperties": value}
        if isinstance(shape, Items):
            return self._list(shape)
        return self._leaf(shape)

    def _named(self, model: type[BaseModel]) -> Schema:
        name = model.__name__
        if self._models.setdefault(name, model) is not model:
            name = f"{model.__module__}.{model.__qualname__}"
        if name not in self._definitions:
            self._definitions[name] = {}
            self._definitions[name] = self._instance() if model is Instance else self._object(model)
        return {"$ref": f"#/$defs/{name}"}

    def _instance(self) -> Schema:
        schema = self._object(Instance)
        words: Schema = {
            "use": {"type": "string", "description": "the module"},
            "mirror": {"type": "string", "description": "the instance whose mirror image about y = 0 this is"},
            "with": {"type": "object", "description": "arguments of the module"},
        }
        return {
            **schema,
            "description": "An instance of a module, and what is different in it.",
            "properties": {**words, **schema["properties"]},
        }

    def _choice(self, shape: Choice) -> Schema:
        references = {kind_word(model): self._named(model) for model in shape.models}
        cases: list[Schema] = [
            {"if": {"properties": {"kind": {"const": kind}}, "required": ["kind"]}, "then": reference}
            for kind, reference in references.items()
        ]
        partial: Schema = {"if": {"not": {"required": ["kind"]}}, "then": {"anyOf": list(references.values())}}
        kinds: Schema = {"anyOf": [{"enum": list(references)}, _REFERENCE]}
        schema: Schema = {"type": "object", "properties": {"kind": kinds}, "allOf": [*cases, partial]}
        if not shape.word:
            return schema
        self._definitions.setdefault(shape.word, {"description": f"A {shape.word}.", **schema})
        return {"$ref": f"#/$defs/{shape.word}"}

    def _fields(self, shape: Fields) -> Schema:
        reference = self._named(shape.model)
        if shape.bare is None:
            return reference
        return {"anyOf": [reference, self._schema(field_annotation(shape.model, shape.bare))]}

    def _table(self, shape: Table) -> Schema:
        classes = {kind: self._catalogue.classes[shape.family, kind] for kind in self._catalogue.kinds(shape.family)}
        properties = {
            kind: {"description": _description(model), **self._value(shape.inner(model))}
            for kind, model in classes.items()
        }
        return {"type": "object", "properties": properties, "additionalProperties": False}

    def _list(self, shape: Items) -> Schema:
        if not shape.fixed:
            return {"type": "array", "items": self._value(shape.values[0])}
        length = len(shape.values)
        items = [self._value(value) for value in shape.values]
        same = all(item == items[0] for item in items)
        inner: Schema = {"items": items[0]} if same else {"prefixItems": items}
        return {"type": "array", **inner, "minItems": length, "maxItems": length}

    def _leaf(self, shape: Leaf) -> Schema:
        if shape.unit is not None:
            return _quantity(shape.unit)
        if shape.words:
            return {"enum": list(shape.words)}
        models = [kind for kind in shape.types if issubclass(kind, BaseModel)]
        types = list(dict.fromkeys(_TYPES[kind] for kind in shape.types if kind in _TYPES))
        if "number" in types and "integer" in types:
            types.remove("integer")
        single: Schema = {"type": types[0] if len(types) == 1 else types}
        return {"anyOf": [single, *(self._named(model) for model in models)]} if models else single


def unit_words(unit: Unit) -> str:
    """Return what a quantity must be, in one clause."""
    words = f"{unit.name} in units like {unit.example}" if unit.example else "number without a unit"
    bounds = (("greater than", unit.above), ("at least", unit.least), ("at most", unit.most))
    return ", ".join((words, *(f"{word} {unit.written(bound)}" for word, bound in bounds if bound is not None)))


def _quantity(unit: Unit) -> Schema:
    if unit.example:
        return {"type": "string", "pattern": rf"^\s*{NUMBER}\s*[A-Za-zµ%1(]"}
    return {"anyOf": [{"type": "number"}, {"type": "string", "pattern": rf"^\s*{NUMBER}"}]}


def _description(model: type[BaseModel]) -> str:
    text = " ".join((inspect.getdoc(model) or "").split())
    source = getattr(model, "source", None) if issubclass(model, Component) else None
    return f"{text} Source: {source}." if source else text
