"""What a kind of measure is: what it takes, what it gives, and of which runs it may be taken."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Literal

from neuromech.analyse.windows import View
from neuromech.errors import MeasureError
from neuromech.spec.measure import Measure

Result = Literal["signal", "text", "number", "time", "length", "speed", "angle"]

RESULT_UNITS: Mapping[Result, str | None] = MappingProxyType(
    {"text": None, "number": "", "time": "s", "length": "m", "speed": "m/s", "angle": "rad"}
)
"""SI unit of each result other than `signal`, which has the unit of the measured signal; None for a text."""

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
        if self.feet is not None and spec.feet is not None and len(spec.feet) != self.feet:
            raise MeasureError(f"measure '{spec.kind}' takes {self.feet} feet (got {len(spec.feet)})")

    def _refuse_others(self, spec: Measure, given: set[str]) -> None:
        known = {name for choice in (*self.needs, *self.takes) for name in _names(choice)}
        if "feet" in given:
            known.update(_CONTACTS)
        for name in sorted(given - known - _EVERY_KIND):
            hint = f". Hint: it takes {', '.join(sorted(known))}" if known else ""
            raise MeasureError(f"measure '{spec.kind}' takes no '{name}'{hint}")


def _names(choice: str) -> set[str]:
    return set(choice.split(" or "))


def _words(choice: str) -> str:
    names = "' or '".join(choice.split(" or "))
    return f"either '{names}'" if " or " in choice else f"'{names}'"
