"""docs/measures.md lists every measure with what it gives and takes."""

import re
from pathlib import Path

import pytest

from neuromech.analyse.kinds import RESULT_UNITS
from neuromech.analyse.table import MEASURES

PAGE = Path(__file__).parents[3] / "docs" / "measures.md"
WORDS = {"signal": "unit of the signal", "text": "text", "number": "number"}


def rows():
    lines = re.findall(
        r"^\| `(\w+)`( \*)? \| ([^|]*) \| ([^|]*) \| ([^|]*) \| .+ \|$", PAGE.read_text("utf-8"), re.MULTILINE
    )
    return {name: (bool(star), gives, needs, takes) for name, star, gives, needs, takes in lines}


def test_every_measure_has_its_line():
    assert sorted(rows()) == sorted(MEASURES)


@pytest.mark.parametrize("name", MEASURES)
def test_a_line_says_what_the_measure_gives_and_takes(name):
    kind = MEASURES[name]
    star, gives, needs, takes = rows()[name]
    assert star == kind.of_early_end
    assert gives == WORDS.get(kind.result, RESULT_UNITS.get(kind.result))
    words = re.compile(r"`(\w+)`")
    assert words.findall(needs) == [word for need in kind.needs for word in need.split(" or ")]
    assert words.findall(takes) == [word for choice in kind.takes for word in choice.split(" or ")]
