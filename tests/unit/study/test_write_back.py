"""A tuned document: small, valid, exact, and polite to what is there already."""

from pathlib import Path

import pytest
from searches import DOCUMENT

from neuromech.errors import DocumentError
from neuromech.pipeline import load_document
from neuromech.spec.document import Document
from neuromech.study.write_back import write_back

ORIGIN = "study two cells, evaluation 12, score -0.5"
VALUES = {"gain": "0.1234567890123456", "delay": "31.400000000000002 ms"}


@pytest.fixture
def original(tmp_path: Path) -> Document:
    file = tmp_path / "models" / "cells.yaml"
    file.parent.mkdir()
    file.write_text(DOCUMENT)
    return load_document(file)


def test_a_new_document_extends_the_original_and_names_the_origin_of_its_numbers(original: Document, tmp_path: Path):
    file = tmp_path / "results" / "tuned.yaml"
    write_back(original, VALUES, ORIGIN, file)
    assert file.read_text() == (
        f"# Tuned by 'neuromech optimize': {ORIGIN}.\n"
        "neuromech: 1\n"
        "name: two cells tuned\n"
        "extends: ../models/cells.yaml\n"
        "\n"
        "parameters:\n"
        "  gain:\n"
        "    value: 0.1234567890123456\n"
        f"    source: {ORIGIN}\n"
        "  delay:\n"
        "    value: 31.400000000000002 ms\n"
        f"    source: {ORIGIN}\n"
    )
    tuned = load_document(file).experiment
    assert tuned.parameters["gain"].value == 0.1234567890123456
    assert tuned.network.neurons["first"].time_constant == pytest.approx(0.0314)
    assert tuned.parameters["gain"].maximum == 2
    assert list(file.parent.iterdir()) == [file]


@pytest.mark.parametrize("number", [1e-5, 5e-324, 0.1, 1.0, 1e22, 123456789.12345678])
def test_numbers_are_exact(original: Document, tmp_path: Path, number: float):
    text = DOCUMENT.replace("minimum: 0.1, maximum: 2", "minimum: 0, maximum: 1e300")
    original.file.write_text(text)
    file = tmp_path / "tuned.yaml"
    write_back(original, {"gain": repr(number)}, ORIGIN, file)
    assert float(load_document(file).experiment.parameters["gain"].value) == number


def test_an_existing_document_keeps_all_else(original: Document, tmp_path: Path):
    file = tmp_path / "mine.yaml"
    text = """# My own document.
neuromech: 1
name: mine  # a name
extends: models/cells.yaml
parameters:
  gain: {value: 0.7, maximum: 1.5}  # found by hand
protocol:
  duration: 60 ms   # longer
"""
    file.write_text(text)
    write_back(original, VALUES, ORIGIN, file)
    written = file.read_text()
    for kept in ("# My own document.", "name: mine  # a name", "# found by hand", "# longer", "maximum: 1.5"):
        assert kept in written
    assert load_document(file).experiment.parameters["gain"].value == 0.1234567890123456
    assert load_document(file).experiment.parameters["delay"].source == ORIGIN
    again = file.read_text()
    write_back(original, VALUES, ORIGIN, file)
    assert file.read_text() == again


def test_the_original_itself_may_be_written(original: Document):
    write_back(original, VALUES, ORIGIN, original.file)
    assert "extends" not in original.file.read_text()
    assert load_document(original.file).experiment.parameters["delay"].value == "31.400000000000002 ms"


def test_a_document_that_is_about_something_else_is_refused_and_left_alone(original: Document, tmp_path: Path):
    file = tmp_path / "other.yaml"
    text = "neuromech: 1\nname: other\nprotocol: {duration: 1 s}\n"
    file.write_text(text)
    with pytest.raises(DocumentError):
        write_back(original, VALUES, ORIGIN, file)
    assert file.read_text() == text
    file.write_text("not: [a document")
    with pytest.raises(DocumentError):
        write_back(original, VALUES, ORIGIN, file)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["models", "other.yaml"]


def test_values_out_of_bounds_are_refused(original: Document, tmp_path: Path):
    with pytest.raises(DocumentError, match="gain"):
        write_back(original, {"gain": "2.5"}, ORIGIN, tmp_path / "tuned.yaml")
    assert not (tmp_path / "tuned.yaml").exists()
