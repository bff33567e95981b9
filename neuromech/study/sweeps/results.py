"""What became of the points of a sweep; travels between processes and into the journal."""

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any, Literal, Self

from neuromech.study.sweeps.design import Point

SweepOutcome = Literal["finished", "fell", "diverged", "refused", "crashed"]
"""How the run of a point ended; `refused`: its values make a document that is wrong; `crashed`: nothing came back."""


@dataclass(frozen=True, slots=True)
class PointResult:
    """What became of a point.

    Args:
        point: which one.
        seed: of its run.
        outcome: how the run ended, or `finished` where it went on to the next point.
        end: simulated time at which the point was left or the run ended (s).
        message: what happened; empty for a finished one.
        measures: name → number in SI units, or text: what a measure of text gave, or why there is no number.
        engine: of the body; empty where nothing ran.
    """

    point: Point
    seed: int
    outcome: SweepOutcome
    end: float
    message: str
    measures: Mapping[str, float | str]
    engine: str

    def to_dict(self) -> dict[str, Any]:
        """Return plain values for JSON, exact."""
        return asdict(self)

    @classmethod
    def from_dict(cls, values: Mapping[str, Any]) -> Self:
        """Read back what `to_dict` gave.

        Raises:
            KeyError: something is missing.
            TypeError: something is there that does not belong to a result.
        """
        point = values["point"]
        return cls(**{**values, "point": Point(point["block"], tuple(point["position"]), point["repetition"])})
