"""What a claim demands of a measured value."""

from neuromech.analyse.windows import in_unit
from neuromech.errors import MeasureError
from neuromech.spec.measure import Expected
from neuromech.units import unit_factor, unit_text

Value = float | str
Written = str | int | float


class Expectation:
    """An interval of numbers, both ends included, or a text.

    Args:
        expected: what the author wrote.
        unit: SI unit of the measure, empty for a plain number, None for a measure of text.

    Raises:
        MeasureError: it is incomplete or contradictory, asks a text of a number, or has another unit.
    """

    def __init__(self, expected: Expected, unit: str | None) -> None:
        self._expected = expected
        self._unit = unit
        self._check()
        self._low, self._high = self._interval()
        self._factor = 1.0 if unit is None else unit_factor(unit)[0] / unit_factor(written_unit(expected))[0]

    @property
    def interval(self) -> tuple[float, float]:
        """Lowest and highest number that is expected, in the measure's unit; a text is expected in neither."""
        return self._low, self._high

    def satisfied(self, value: Value) -> bool:
        """Return whether a measured value, in the measure's unit, is what is expected."""
        if isinstance(value, str):
            return self._unit is None and value == self._expected.equals
        return self._low <= value <= self._high

    def show(self, value: Value) -> Value:
        """Return a measured number in the unit in which the expectation is written."""
        return value if isinstance(value, str) else value * self._factor

    def text(self) -> str:
        """Return the expectation in words: `0.457 s ± 1 %`, `at least 60 deg and at most 80 deg`, `trot`."""
        expected = self._expected
        if expected.equals is not None:
            return expected.equals
        if expected.value is not None:
            return f"{expected.value} ± {expected.within}"
        bounds = {"at least": expected.at_least, "at most": expected.at_most}
        return " and ".join(f"{word} {bound}" for word, bound in bounds.items() if bound is not None)

    def _check(self) -> None:
        expected = self._expected
        forms = expected.value is not None, expected.equals is not None, _bounded(expected)
        if sum(forms) != 1:
            raise MeasureError("must have either 'value' with 'within', or 'at_least' and/or 'at_most', or 'equals'")
        if (expected.value is None) != (expected.within is None):
            raise MeasureError("'value' and 'within' go together")
        if self._unit is None and expected.equals is None:
            raise MeasureError("this measure gives a text. Hint: use 'equals'")
        if self._unit is not None and expected.equals is not None:
            raise MeasureError("this measure gives a number. Hint: use 'value' with 'within', 'at_least' or 'at_most'")

    def _interval(self) -> tuple[float, float]:
        expected = self._expected
        if expected.value is not None and expected.within is not None:
            value = self._number(expected.value, "value")
            within = self._tolerance(expected.within, value)
            return value - within, value + within
        low = -float("inf") if expected.at_least is None else self._number(expected.at_least, "at_least")
        high = float("inf") if expected.at_most is None else self._number(expected.at_most, "at_most")
        return low, high

    def _tolerance(self, within: Written, value: float) -> float:
        """Return the half width of the interval: a percentage is relative to the value, all else is absolute."""
        if unit_text(within) == "%":
            return abs(value) * in_unit(within, "", "percentage")
        return self._number(within, "within")

    def _number(self, written: Written, key: str) -> float:
        try:
            return in_unit(written, self._unit or "", "value")
        except MeasureError as error:
            raise MeasureError(f"'{key}' {error}") from error


def written_unit(expected: Expected) -> str:
    """Return the unit text of the first number that an expectation is written with, empty where there is none."""
    written = (expected.value, expected.at_least, expected.at_most)
    return next((unit_text(value) for value in written if value is not None), "")


def _bounded(expected: Expected) -> bool:
    return expected.at_least is not None or expected.at_most is not None
