"""The JSON Schema: kept up to date, valid, and at one with the loader on what is right and what is wrong."""

import json
from pathlib import Path
from typing import Literal

import pytest
from jsonschema import Draft202012Validator
from spec_documents import HALF_CENTRE

from neuromech.components.catalogue import Catalogue
from neuromech.components.neurons import RybakInterneuron
from neuromech.spec.plain import plain
from neuromech.spec.reader import parse, read
from neuromech.spec.schema import json_schema

ROOT = Path(__file__).parents[3]
KEPT = ROOT / "docs" / "schema" / "neuromech.schema.json"
SPECS = sorted((ROOT / "specs").rglob("*.yaml"))


@pytest.fixture(scope="module")
def validator():
    return Draft202012Validator(json_schema(Catalogue.built_in()))


def _says(validator, text):
    return not validator.is_valid(plain(parse(text.encode(), "document.yaml")))


def test_kept_schema_is_the_one_that_the_code_gives():
    expected = json.dumps(json_schema(Catalogue.built_in()), indent=2, ensure_ascii=False) + "\n"
    assert KEPT.read_text(encoding="utf-8") == expected, "run: neuromech schema --out docs/schema/neuromech.schema.json"


def test_schema_is_a_valid_schema(validator):
    Draft202012Validator.check_schema(validator.schema)


@pytest.mark.parametrize("path", SPECS, ids=lambda path: path.stem)
def test_shipped_documents_are_valid(validator, path):
    assert [error.message for error in validator.iter_errors(plain(read(path)))] == []


def test_there_are_shipped_documents():
    assert len(SPECS) > 0


def test_document_with_modules_is_valid(validator):
    assert not _says(validator, HALF_CENTRE)


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("neuromech: 1", "neuromech: 2"),
        ("name: half centre", "nam: half centre"),
        ("kind: rybak_interneuron", "kind: rybak_interneuorn"),
        ("kind: rybak_interneuron", "kind: rybak_interneuron, sodium_conductance: 1 nS"),
        ("sodium_conductance: 3.5 nS", "sodium_conductance: 3.5"),
        ("excitatory:", "excitattory:"),
        ("{In: 0.4}", "{In: {wieght: 0.4}}"),
        ("[0.1, 1, 0.2]", "[0.1, 1]"),
        ("{use: leg,", "{ues: leg,"),
        ("engine: hinge", "engine: hinges"),
        ("default:", "defualt:"),
        ("duration: 2 s", "seed: 1.5"),
    ],
)
def test_mistakes_that_an_editor_can_see(validator, before, after):
    assert before in HALF_CENTRE
    assert _says(validator, HALF_CENTRE.replace(before, after, 1))


@pytest.mark.parametrize(
    "text",
    [
        "extends: base.yaml\n",
        "extends: [a.yaml, b.yaml]\nnetwork: {neurons: {RG-F: {sodium_conductance: 3 nS}}}\n",
        "extends: a.yaml\n$schema: x\nmuscles: null\nrecord: {all: null}\n",
        "extends: a.yaml\nmodules: {leg: {network: {neurons: {A: '${neuron}'}}}}\n",
        'extends: a.yaml\nnetwork: {synapses: {excitatory: {A: {B: "${w}", C: {weight: "${w}"}}, D: "${row}"}}}\n',
    ],
)
def test_parts_of_documents_are_valid_where_something_is_extended(validator, text):
    assert not _says(validator, text)


def test_every_field_of_every_component_is_described_with_its_unit(validator):
    definitions = validator.schema["$defs"]
    neuron = definitions["RybakNeuron"]
    assert "Source: Habu 2020" in neuron["description"]
    described = neuron["properties"]["potassium_conductance"]["description"]
    assert described == "conductance in units like nS, at least 0 nS; default 4.5 nS"
    assert "required" in neuron["properties"]["sodium_conductance"]["description"]


class CustomNeuron(RybakInterneuron):
    """A neuron of another package."""

    kind: Literal["custom_neuron"] = "custom_neuron"


class RateNeuron(RybakInterneuron):
    """A neuron of another package whose class has the name of a built-in one."""

    kind: Literal["other_rate_neuron"] = "other_rate_neuron"


def test_classes_of_the_same_name_are_told_apart():
    definitions = json_schema(Catalogue([*Catalogue.built_in().classes.values(), RateNeuron]))["$defs"]
    cases = {
        case["if"]["properties"]["kind"]["const"]: case["then"]["$ref"] for case in definitions["neuron"]["allOf"][:-1]
    }
    assert cases["rate_neuron"] != cases["other_rate_neuron"]
    for kind in ("rate_neuron", "other_rate_neuron"):
        found = definitions[cases[kind].removeprefix("#/$defs/")]
        assert found["properties"]["kind"]["anyOf"][0]["enum"] == [kind]


def test_classes_of_other_packages_appear():
    schema = json_schema(Catalogue([*Catalogue.built_in().classes.values(), CustomNeuron]))
    assert "custom_neuron" in schema["$defs"]["neuron"]["properties"]["kind"]["anyOf"][0]["enum"]
    assert schema["$defs"]["CustomNeuron"]["description"].startswith("A neuron of another package.")
