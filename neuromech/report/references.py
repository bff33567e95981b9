"""The reference curves that a recording's document compares joint angles with."""

from collections.abc import Iterator
from dataclasses import dataclass
from math import pi
from typing import Any

import numpy as np
from ruamel.yaml import YAML

from neuromech.analyse.windows import Array
from neuromech.simulate.recording import Recording
from neuromech.spec.measure import Measure

_DEGREES = {"deg": 1.0, "rad": 180.0 / pi}


@dataclass(frozen=True, slots=True)
class Reference:
    """An angle over one cycle, measured elsewhere.

    Args:
        percent: (n,) of the cycle, rising.
        angle: (n,) in deg.
        begins_at: where the cycle begins, `touchdown` or `liftoff`.
    """

    percent: Array
    angle: Array
    begins_at: str

    def at(self, percent: Array, duty: float) -> Array:
        """Return angles (deg) at parts (percent) of a cycle that begins at touchdown, with this duty factor."""
        since = percent if self.begins_at == "touchdown" else percent - 100.0 * duty
        return np.interp(since % 100.0, self.percent, self.angle, period=100.0)


def references(recording: Recording) -> dict[str, Reference]:
    """Return the references of a recording's claims by the name of the signal that each is compared with.

    A reference has an angle where its column's name ends with the unit of one, as `hip_deg` does.
    """
    return dict(found for claim in compared_measures(recording) for found in _of(claim))


def compared_measures(recording: Recording) -> Iterator[Measure]:
    """Yield the measures with a curve in the claims of a recording's document."""
    document: dict[str, Any] = YAML(typ="safe").load(recording.provenance.specification) or {}
    for claim in (document.get("claims") or {}).values():
        if claim is not None and claim["measure"]["kind"] == "curve_correlation":
            yield Measure.model_validate(claim["measure"])


def _of(measure: Measure) -> Iterator[tuple[str, Reference]]:
    curve = measure.curve
    if curve is None:
        return
    for name, column, values in zip(measure.signals or (), curve.columns, curve.values, strict=True):
        unit = column.rpartition("_")[2]
        if unit in _DEGREES:
            yield name, Reference(np.array(curve.phases), _DEGREES[unit] * np.array(values), curve.begins_at)
