"""No text, no bytes and no slip of the pen ends in anything but a document or a DocumentError."""

import re

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from spec_documents import HALF_CENTRE

from neuromech.components.catalogue import Catalogue
from neuromech.errors import DocumentError
from neuromech.spec.load import load

CATALOGUE = Catalogue.built_in()
FRAGMENTS = st.sampled_from(
    [
        "",
        "${drive}",
        "${nobody}",
        "${}",
        "a${tau}b",
        "null",
        "~",
        "true",
        "[]",
        "{}",
        "[1, 2]",
        "{a: 1}",
        "-1",
        "1e400",
        "9" * 400,
        ".nan",
        "-.inf",
        "0x1F",
        "5 nS",
        "m^9",
        "&a x",
        "*a",
        "!!str 5",
        "!x y",
        "<<",
        "|\n  text",
        '"\\x00"',
        "'",
        "%",
        "@",
        "\t",
        "- ",
        "? ",
        "---",
        "...",
        "#",
        "é",
        "\u2028",
        "use",
        "mirror",
        "with",
        "kind",
        "extends: document.yaml\n",
    ]
)
TOKENS = [match.span() for match in re.finditer(r"[\w.+-]+|[^\w\s]|\n *", HALF_CENTRE)]


@pytest.fixture(scope="module")
def path(tmp_path_factory):
    return tmp_path_factory.mktemp("random") / "document.yaml"


def _load(path, content):
    path.write_bytes(content)
    try:
        load(path, catalogue=CATALOGUE)
    except DocumentError as error:
        assert error.problems
        assert all(str(problem).strip() for problem in error.problems)


def test_the_unchanged_document_is_valid(path):
    path.write_text(HALF_CENTRE)
    assert load(path, catalogue=CATALOGUE).experiment.name == "half centre"


@given(st.binary(max_size=300))
def test_random_bytes(path, content):
    _load(path, content)


@given(st.text(max_size=300))
def test_random_text(path, text):
    _load(path, text.encode("utf-8", "surrogatepass"))


@given(st.text(alphabet="ab:-?[]{}&*!|>'\"%@`#,\n \t0.~<=$\\x", max_size=60))
def test_random_yaml_punctuation(path, text):
    _load(path, text.encode())


@settings(max_examples=150, suppress_health_check=[HealthCheck.too_slow])
@given(st.lists(st.tuples(st.sampled_from(TOKENS), FRAGMENTS), min_size=1, max_size=3))
def test_random_changes_of_a_valid_document(path, changes):
    text = HALF_CENTRE
    for (start, end), fragment in sorted(changes, reverse=True):
        text = text[:start] + fragment + text[end:]
    _load(path, text.encode())


@settings(max_examples=60, suppress_health_check=[HealthCheck.too_slow])
@given(st.integers(0, len(HALF_CENTRE)), st.integers(0, 80), st.binary(max_size=4))
def test_random_bytes_inside_a_valid_document(path, start, length, content):
    valid = HALF_CENTRE.encode()
    _load(path, valid[:start] + content + valid[start + length :])


@settings(max_examples=60)
@given(st.text(max_size=40))
def test_random_overrides(path, text):
    path.write_text(HALF_CENTRE)
    try:
        load(path, catalogue=CATALOGUE, overrides=[text, f"name={text}", f"{text}=1", f"instances.LF.with.tau={text}"])
    except DocumentError as error:
        assert error.problems
