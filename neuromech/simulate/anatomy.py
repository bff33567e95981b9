"""What measures must know about the body that was simulated: its weight, and the parameters of its muscles."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Self

from neuromech.components.base import Component
from neuromech.graph.model import ModelGraph
from neuromech.spec.model import Segment


@dataclass(frozen=True, slots=True)
class Anatomy:
    """Masses and muscle parameters of a body.

    Args:
        mass: total mass (kg), zero without a body.
        gravity: gravitational acceleration (m/s²).
        muscles: {muscle: {parameter: value in SI units}}, for every parameter that is a number.
    """

    mass: float
    gravity: float
    muscles: Mapping[str, Mapping[str, float]]

    @property
    def weight(self) -> float:
        """Body weight (N), zero without a body."""
        return self.mass * self.gravity

    @classmethod
    def of(cls, graph: ModelGraph) -> Self:
        """Return the anatomy of a model, as it is at the start of a run."""
        segments = [element.spec for element in graph.elements("segment")]
        return cls(
            mass=sum(float(segment.mass) for segment in segments if isinstance(segment, Segment)),
            gravity=float(graph.document.experiment.world.gravity),
            muscles={
                element.name: _numbers(element.spec)
                for element in graph.elements("muscle")
                if isinstance(element.spec, Component)
            },
        )


NO_BODY = Anatomy(0.0, 0.0, {})


def _numbers(spec: Component) -> dict[str, float]:
    values = {name: getattr(spec, name) for name in type(spec).model_fields}
    return {name: float(value) for name, value in values.items() if isinstance(value, float)}
