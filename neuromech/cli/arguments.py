"""Arguments with units, as people write them."""

import re

from pydantic_core import PydanticCustomError

from neuromech.errors import DocumentError, Problem
from neuromech.units import TIME

_SIZE = re.compile(r"([1-9]\d{0,4})x([1-9]\d{0,4})")


def duration_argument(text: str, option: str) -> float:
    """Return a time (s) above zero.

    Raises:
        DocumentError: the text is no such time.
    """
    try:
        return float(TIME.positive.parse(text))
    except PydanticCustomError as error:
        raise _refused("duration", option, error.message(), text, "'5 s'") from error


def time_argument(text: str, option: str) -> float:
    """Return a time (s), zero or more.

    Raises:
        DocumentError: the text is no such time.
    """
    try:
        return float(TIME.non_negative.parse(text))
    except PydanticCustomError as error:
        raise _refused("time", option, error.message(), text, "'5 s'") from error


def size_argument(text: str, option: str) -> tuple[int, int]:
    """Return width and height of a picture in pixels.

    Raises:
        DocumentError: the text is no size, or a side is odd.
    """
    found = _SIZE.fullmatch(text)
    if found is None or int(found[1]) % 2 or int(found[2]) % 2:
        raise _refused("size", option, "must be two even numbers of pixels", text, "1280x720")
    return int(found[1]), int(found[2])


def _refused(code: str, option: str, message: str, got: str, example: str) -> DocumentError:
    return DocumentError([Problem(code, option, message, repr(got), f"write for example {option} {example}")])
