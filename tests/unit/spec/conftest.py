"""Documents for the tests of the spec layer."""

import pytest
from spec_documents import HALF_CENTRE

from neuromech.components.catalogue import Catalogue
from neuromech.spec.load import load


@pytest.fixture
def write(tmp_path, monkeypatch):
    """A function that writes a document into an empty current folder and returns its relative path."""
    monkeypatch.chdir(tmp_path)

    def _write(text, name="document.yaml"):
        path = tmp_path.__class__(name)
        path.write_text(text, encoding="utf-8")
        return path

    return _write


@pytest.fixture
def loaded(write):
    """A function that loads the text of a document."""

    def _loaded(text, *overrides):
        return load(write(text), catalogue=Catalogue.built_in(), overrides=overrides)

    return _loaded


@pytest.fixture
def half_centre():
    """The text of a valid document that uses modules, a mirror and parameters."""
    return HALF_CENTRE
