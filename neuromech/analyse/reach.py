"""What a measure can give at all, and whether anything of it is left after what is demanded of it."""

from dataclasses import dataclass, replace
from math import inf
from typing import Self

from neuromech.analyse.expectations import Expectation
from neuromech.analyse.kinds import MeasureKind


@dataclass(frozen=True, slots=True)
class Possible:
    """The values that a measure can have: numbers of an interval, or words.

    Args:
        low: lowest number, SI units.
        high: highest number.
        words: the words; none where any word is possible.
    """

    low: float = -inf
    high: float = inf
    words: tuple[str, ...] | None = None

    @classmethod
    def of(cls, kind: MeasureKind, duration: float = inf) -> Self:
        """Return what a kind of measure can give of a run of a certain duration (s)."""
        low = -inf if kind.least is None else kind.least
        high = inf if kind.most is None else kind.most
        if kind.result == "time":
            high = min(high, duration)
        return cls(low, high, kind.words or None)

    def meeting(self, expectation: Expectation, word: str | None) -> Self | None:
        """Return the values that meet an expectation, or None where there are none; `word` is the word it asks for."""
        if word is not None:
            return replace(self, words=(word,)) if self.words is None or word in self.words else None
        low, high = expectation.interval
        low, high = max(low, self.low), min(high, self.high)
        return replace(self, low=low, high=high) if low <= high else None

    def ratio(self) -> Self:
        """Return what the ratio of two of these numbers can be."""
        return replace(self, low=0.0 if self.low >= 0.0 or self.high <= 0.0 else -inf, high=inf)

    def difference(self) -> Self:
        """Return what the difference of two of these numbers can be."""
        return replace(self, low=self.low - self.high, high=self.high - self.low)

    def refusal(self, kind: str, unit: str | None) -> str:
        """Return in words that a measure of a kind gives nothing but this."""
        return f"can never be met: measure '{kind}' gives {self.text()}{f' {unit}' if unit else ''}"

    def text(self) -> str:
        """Return in words what is possible: `0 to 1`, `at least 0`, `rhythm, no rhythm`."""
        if self.words is not None:
            return ", ".join(self.words)
        if self.low == -inf:
            return f"at most {self.high:g}"
        return f"at least {self.low:g}" if self.high == inf else f"{self.low:g} to {self.high:g}"
