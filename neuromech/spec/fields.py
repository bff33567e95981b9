"""Fields whose class is chosen by the `kind` that the author wrote, from the catalogue in the validation context."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler, ValidationInfo
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import PydanticCustomError, core_schema

from neuromech.components.base import Component, Family
from neuromech.components.catalogue import Catalogue
from neuromech.errors import did_you_mean
from neuromech.units import repr_short


@dataclass(frozen=True, slots=True)
class OfCatalogue:
    """Marks a field as a component of one family: `Annotated[Neuron, OfCatalogue("neuron")]`."""

    family: Family

    def validate(self, value: object, info: ValidationInfo) -> Component:
        """Choose the class by `kind` and validate the rest with it.

        Raises:
            PydanticCustomError: not a map, or the kind is missing or unknown.
            ValidationError: the class refuses a parameter.
        """
        if isinstance(value, Component):
            return value
        if not isinstance(value, Mapping):
            raise _error("not-a-map", f"must be a map that describes a {self.family}", repr_short(value), None)
        catalogue: Catalogue = info.context["catalogue"] if info.context else Catalogue.built_in()
        kind = value.get("kind")
        kinds = catalogue.kinds(self.family)
        if kind is None:
            raise _error("missing-kind", "'kind' is missing", None, f"allowed: {', '.join(kinds)}")
        cls = catalogue.find(self.family, str(kind))
        if cls is None:
            raise _error(
                "unknown-kind", f"is not a {self.family} kind", repr_short(kind), did_you_mean(str(kind), kinds)
            )
        return cls.model_validate(dict(value), context=info.context)

    def __get_pydantic_core_schema__(self, _source: object, _handler: GetCoreSchemaHandler) -> core_schema.CoreSchema:
        """Validate with `validate`."""
        return core_schema.with_info_plain_validator_function(
            self.validate, serialization=core_schema.plain_serializer_function_ser_schema(_dump)
        )

    def __get_pydantic_json_schema__(
        self, _schema: core_schema.CoreSchema, _handler: GetJsonSchemaHandler
    ) -> JsonSchemaValue:
        """Point to the definition that the schema generator adds for the family."""
        return {"$ref": f"#/$defs/{self.family}"}


@dataclass(frozen=True, slots=True)
class KindFromKey:
    """Marks a map of maps of maps of components: its own keys are kinds, and a bare value stands for one field.

    Args:
        family: family of the components.
        bare: the field that a bare value gives.
    """

    family: Family
    bare: str


def _error(code: str, message: str, got: str | None, hint: str | None) -> PydanticCustomError:
    return PydanticCustomError(code, "{message}", {"message": message, "got": got, "hint": hint})


def _dump(component: Component) -> dict[str, Any]:
    return component.model_dump()
