"""What a study tunes, as a box of coordinates in 0…1, and the way from a point in it to values in a document."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Self

import numpy as np

from neuromech.compiler.numerics import Floats
from neuromech.spec.document import Document
from neuromech.spec.model import Parameter
from neuromech.spec.study import Tuned
from neuromech.units import measure, unit_factor, unit_text


@dataclass(frozen=True, slots=True)
class Dimension:
    """One coordinate.

    Args:
        name: the parameter that it sets.
        also: further parameters, each with the sign with which it gets the same value.
        least: lower bound, SI units.
        most: upper bound, SI units.
        unit: unit in which values are written, that of the document.
        log: whether equal steps of the coordinate are equal ratios.
    """

    name: str
    also: tuple[tuple[str, int], ...]
    least: float
    most: float
    unit: str
    log: bool

    @classmethod
    def of(cls, name: str, tuned: Tuned, parameter: Parameter) -> Self:
        """Return the coordinate of a parameter that has bounds."""
        bounds = tuned.range or (parameter.minimum, parameter.maximum)
        least, most = (measure(bound)[0] for bound in bounds if bound is not None)
        return cls(name, tuned.followers, least, most, unit_text(parameter.value), tuned.scale == "log")

    def value(self, coordinate: float) -> float:
        """Return the SI value at a coordinate in 0…1."""
        if self.log:
            return self.least * math.pow(self.most / self.least, coordinate)
        return self.least + (self.most - self.least) * coordinate

    def coordinate(self, value: float) -> float:
        """Return the coordinate in 0…1 of an SI value; of a value out of bounds, that of the closest bound."""
        value = min(max(value, self.least), self.most)
        if self.log:
            return math.log(value / self.least) / math.log(self.most / self.least)
        return (value - self.least) / (self.most - self.least)

    def text(self, coordinate: float) -> str:
        """Return the value at a coordinate as an author writes it; what is read from it is within the bounds."""
        number = self.value(coordinate) / unit_factor(self.unit)[0]
        while self._read(number) > self.most:
            number = math.nextafter(number, -math.inf)
        while self._read(number) < self.least:
            number = math.nextafter(number, math.inf)
        return f"{number!r} {self.unit}".strip()

    @property
    def names(self) -> tuple[str, ...]:
        """All parameters that the coordinate sets."""
        return (self.name, *(name for name, _ in self.also))

    def texts(self, coordinate: float) -> dict[str, str]:
        """Return name → value of every parameter that the coordinate sets, as an author writes it."""
        text = self.text(coordinate)
        return {self.name: text} | {name: text if sign > 0 else _negative(text) for name, sign in self.also}

    def _read(self, number: float) -> float:
        return number * unit_factor(self.unit)[0]


@dataclass(frozen=True, slots=True)
class Space:
    """The box that a study searches."""

    dimensions: tuple[Dimension, ...]

    @classmethod
    def of(cls, document: Document) -> Self:
        """Return the space of a document with a study that was checked."""
        experiment = document.experiment
        tune = experiment.study.tune if experiment.study else {}
        return cls(tuple(Dimension.of(name, tuned, experiment.parameters[name]) for name, tuned in tune.items()))

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the tuned parameters, in authored order."""
        return tuple(dimension.name for dimension in self.dimensions)

    @property
    def all_names(self) -> tuple[str, ...]:
        """Names of all parameters that a point sets, those of `also` included."""
        return tuple(name for dimension in self.dimensions for name in dimension.names)

    def parameters(self, point: Floats) -> dict[str, str]:
        """Return name → value of every parameter that a point sets, those of `also` included.

        Args:
            point: (dimension,) coordinates; what lies out of 0…1 counts as the closest bound.
        """
        found: dict[str, str] = {}
        for dimension, coordinate in zip(self.dimensions, np.clip(point, 0.0, 1.0), strict=True):
            found |= dimension.texts(float(coordinate))
        return found

    def values(self, point: Floats) -> dict[str, str]:
        """Return path → value of what a point sets, as for `--set`."""
        return {f"parameters.{name}.value": text for name, text in self.parameters(point).items()}

    def point(self, document: Document) -> Floats:
        """Return the coordinates of a document's own values; (dimension,)."""
        parameters: Mapping[str, Parameter] = document.experiment.parameters
        return np.array([one.coordinate(measure(parameters[one.name].value)[0]) for one in self.dimensions])


def _negative(text: str) -> str:
    """Return the negative of a written value; zero has no sign."""
    number, _, unit = text.partition(" ")
    return f"{0.0 - float(number)!r} {unit}".strip()
