"""Units: text in, one SI number out, and nothing else."""

import copy
import math
import pickle
import subprocess
import sys
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic_core import PydanticCustomError

from neuromech.units import (
    ANGLE,
    CONDUCTANCE,
    DIMENSIONLESS,
    LENGTH,
    TIME,
    BoundText,
    Quantity,
    Unit,
    common_units,
    measure,
    quantity,
    repr_short,
    resolved,
    unit_factor,
)

FINITE = st.floats(-1e12, 1e12, allow_nan=False)


@given(FINITE)
def test_written_and_read_back(value):
    assert CONDUCTANCE.parse(f"{value!r} nS") == pytest.approx(value * 1e-9, rel=1e-12)
    assert DIMENSIONLESS.parse(repr(value)) == value


@given(FINITE, st.sampled_from(["nS", "µS", "S", "1/ohm", "A/V"]))
def test_every_unit_of_a_dimension_means_the_same(value, unit):
    text = f"{value!r} {unit}"
    assert CONDUCTANCE.parse(text) == pytest.approx(value * unit_factor(unit)[0], rel=1e-12)


def test_order_of_factors_does_not_matter():
    assert unit_factor("kg m^2") == unit_factor("m^2 kg") == unit_factor("m kg m")
    assert unit_factor("N m s/rad")[1] == unit_factor("s m N/rad")[1]


@pytest.mark.parametrize(
    ("text", "si"),
    [
        ("20 pF", 20e-12),
        ("4.5nS", 4.5e-9),
        ("90 deg", math.pi / 2),
        ("0.083 1/s", 0.083),
        ("1 kg m^2", 1.0),
        ("2 g cm^2", 2e-7),
        ("3 N m s/rad", 3.0),
        ("10 %", 0.1),
        ("1e-3 m", 1e-3),
        ("-.5 mm", -5e-4),
        ("2 Hz", 2.0),
        ("1 m**2", 1.0),
    ],
)
def test_known_values(text, si):
    assert quantity(text) == pytest.approx(si, rel=1e-14)


@pytest.mark.parametrize(
    ("unit", "value", "code"),
    [
        (DIMENSIONLESS, "9 deg", "wrong-unit"),
        (ANGLE, 9, "missing-unit"),
        (ANGLE, "9", "missing-unit"),
        (ANGLE, "9 %", "wrong-unit"),
        (LENGTH, "9 kg", "wrong-unit"),
        (LENGTH, "9 nonsense", "unknown-unit"),
        (LENGTH, "mm", "not-a-quantity"),
        (LENGTH, True, "not-a-quantity"),
        (LENGTH, None, "not-a-quantity"),
        (LENGTH, [1], "not-a-quantity"),
        (LENGTH, "nan mm", "out-of-range"),
        (LENGTH, "-inf", "out-of-range"),
        (DIMENSIONLESS, math.nan, "out-of-range"),
        (DIMENSIONLESS, "1e999", "out-of-range"),
        (LENGTH.positive, "0 mm", "out-of-range"),
        (LENGTH.non_negative, "-1 mm", "out-of-range"),
        (DIMENSIONLESS.within(0.0, 1.0), "101 %", "out-of-range"),
    ],
)
def test_what_is_refused_and_why(unit, value, code):
    with pytest.raises(PydanticCustomError) as caught:
        unit.parse(value)
    assert caught.value.type == code


def test_bounds_are_told_in_the_unit_of_the_example():
    with pytest.raises(PydanticCustomError, match="must be at most 5 ms"):
        TIME.within(0.0, 5e-3).parse("6 ms")


@pytest.mark.parametrize(
    "unit", ["m^9^9^9^9", "9^9^9", "m.__class__", "os.system", "m" * 41, "(m", "m)", "m^^2", "2 m"]
)
def test_what_is_no_unit_is_refused_at_once(unit):
    with pytest.raises(ValueError, match="no unit"):
        unit_factor(unit)


@given(st.text(max_size=50))
def test_random_text_is_a_quantity_or_a_value_error(text):
    try:
        value, _ = measure(text)
    except ValueError:
        return
    assert isinstance(value, float)


@given(FINITE, st.one_of(st.none(), st.text(max_size=5)))
def test_quantity_remembers_its_parameter(value, name):
    original = Quantity(value, name)
    for twin in (pickle.loads(pickle.dumps(original)), copy.copy(original), copy.deepcopy(original)):
        assert (twin, twin.parameter, type(twin)) == (value, name, Quantity)


def test_text_of_a_parameter_remembers_it():
    original = BoundText("5 mm", "width")
    for twin in (pickle.loads(pickle.dumps(original)), copy.copy(original), copy.deepcopy(original)):
        assert (twin, twin.parameter, type(twin)) == ("5 mm", "width", BoundText)


def test_quantity_that_is_read_from_a_parameter_remembers_it():
    read = LENGTH.parse(BoundText("5 mm", "width"))
    assert (read, read.parameter) == (pytest.approx(5e-3), "width")
    assert LENGTH.parse("5 mm").parameter is None


def test_quantity_that_is_validated_again_keeps_value_and_parameter():
    again = LENGTH.parse(Quantity(5e-3, "width"))
    assert (again, again.parameter) == (5e-3, "width")


def test_article_fits_the_word():
    with pytest.raises(PydanticCustomError, match="must be an angle"):
        Unit("angle", "deg").parse("1 s")


@pytest.mark.parametrize(
    ("value", "text"),
    [({}, "a map"), ([], "a list"), (None, "nothing"), (True, "true"), ("x", "'x'"), (1.5, "1.5"), ("a" * 99, None)],
)
def test_short_text_of_what_was_found(value, text):
    short = repr_short(value)
    assert len(short) <= 60
    assert short == text or text is None


def test_the_table_of_common_units_says_what_pint_says():
    for unit, known in common_units().items():
        assert resolved(unit) == known, unit


def test_the_shipped_documents_need_no_unit_beyond_the_table():
    code = "import sys; from neuromech.cli.main import run_arguments\n"
    code += "try: run_arguments(['validate', *sys.argv[1:]])\n"
    code += "finally: print(sorted({'pint', 'numpy', 'scipy', 'numba', 'matplotlib'} & set(sys.modules)))"
    specs = Path(__file__).parents[3] / "specs"
    done = subprocess.run([sys.executable, "-c", code, str(specs)], capture_output=True, text=True, check=True)
    assert done.stdout.splitlines()[-1] == "[]"
