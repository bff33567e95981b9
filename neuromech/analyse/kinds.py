"""What a kind of measure is: what it takes, what it gives, and of which runs it may be taken."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Literal

from neuromech.analyse.windows import View
from neuromech.errors import MeasureError
from neuromech.spec.measure import Measure, ReferenceCurve

Result = Literal[
    "signal", "text", "number", "time", "length", "speed", "angle", "energy", "power", "energy per distance"
]

RESULT_UNITS: Mapping[Result, str | None] = MappingProxyType(
    {
        "text": None,
        "number": "",
        "time": "s",
        "length": "m",
        "speed": "m/s",
        "angle": "rad",
        "energy": "J",
        "power": "W",
        "energy per distance": "J/m",
    }
)
"""SI unit of each result other than `signal`, which has the unit of the measured signal; None for a text."""

FEWEST_PHASES = 3

_EVERY_KIND = frozenset({"kind", "after", "until"})
_CONTACTS = ("level", "least_duration")


@dataclass(frozen=True, slots=True)
class MeasureKind:
    """A kind of measure.

    Args:
        take: takes the measure.
        result: what it gives.
        needs: arguments that it needs; of `reference or feet`, one.
        takes: arguments that it can have besides; of `reference or feet`, at most one.
        feet: how many feet it is about, None for any number.
        signals: how many signals it is about, each given by its name; None for any number, and for patterns.
        of_early_end: whether it may be taken of a run that ended early, in a fall for example, up to its end.
        least: no value is below this, SI units; None where there is no limit.
        most: no value is above this.
        words: the words that a measure of text may give; empty where they depend on the model.
    """

    take: Callable[[View], float | str]
    result: Result
    needs: tuple[str, ...] = ()
    takes: tuple[str, ...] = ()
    feet: int | None = None
    signals: int | None = None
    of_early_end: bool = False
    least: float | None = None
    most: float | None = None
    words: tuple[str, ...] = ()

    def check(self, spec: Measure) -> None:
        """Refuse a measure whose arguments are not those of this kind.

        Raises:
            MeasureError: an argument is missing or means nothing to this kind, or the number of feet is wrong.
        """
        given = {name for name in spec.model_fields_set if getattr(spec, name) is not None}
        for need in self.needs:
            if not given & _names(need):
                raise MeasureError(f"measure '{spec.kind}' needs {_words(need)}")
        for choice in (*self.needs, *self.takes):
            if len(given & _names(choice)) > 1:
                raise MeasureError(f"measure '{spec.kind}' takes {_words(choice)}, not both")
        self._refuse_others(spec, given)
        self._count(spec)
        if spec.curve is not None:
            _check_curve(spec.curve, spec.signals or ())

    def _count(self, spec: Measure) -> None:
        if self.feet is not None and spec.feet is not None and len(spec.feet) != self.feet:
            feet = "1 foot" if self.feet == 1 else f"{self.feet} feet"
            raise MeasureError(f"measure '{spec.kind}' takes {feet} (got {len(spec.feet)})")
        if self.signals is not None and spec.signals is not None:
            if len(spec.signals) != self.signals:
                raise MeasureError(f"measure '{spec.kind}' takes {self.signals} signals (got {len(spec.signals)})")
            for name in spec.signals:
                if any(sign in name for sign in "*?["):
                    raise MeasureError(f"measure '{spec.kind}' takes the names of signals, not patterns (got '{name}')")

    def _refuse_others(self, spec: Measure, given: set[str]) -> None:
        known = {name for choice in (*self.needs, *self.takes) for name in _names(choice)}
        if "feet" in given:
            known.update(_CONTACTS)
        for name in sorted(given - known - _EVERY_KIND):
            hint = f". Hint: it takes {', '.join(sorted(known))}" if known else ""
            raise MeasureError(f"measure '{spec.kind}' takes no '{name}'{hint}")


def _check_curve(curve: ReferenceCurve, signals: tuple[str, ...]) -> None:
    if len(curve.columns) != len(signals):
        raise MeasureError(f"a curve needs a column for each signal (got {len(curve.columns)} for {len(signals)})")
    if len(curve.values) != len(curve.columns):
        raise MeasureError("a curve needs either a 'file', or 'phases' and for each column a list in 'values'")
    if len(curve.phases) < FEWEST_PHASES or any(len(values) != len(curve.phases) for values in curve.values):
        raise MeasureError(f"a curve needs at least {FEWEST_PHASES} phases, and a value for each")
    if not all(0.0 <= phase <= 100.0 for phase in curve.phases):
        raise MeasureError("the phases of a curve must lie between 0 and 100 percent")


def _names(choice: str) -> set[str]:
    return set(choice.split(" or "))


def _words(choice: str) -> str:
    names = "' or '".join(choice.split(" or "))
    return f"either '{names}'" if " or " in choice else f"'{names}'"
