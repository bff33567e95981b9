"""Two legs on a trunk as a plain dictionary to break, and the way from such a dictionary to its graph."""

import json
from collections.abc import Callable
from typing import Any

import pytest
from legs import QUADRUPED_HALF, to_document

from neuromech.graph.build import build
from neuromech.graph.model import ModelGraph


@pytest.fixture
def raw() -> dict[str, Any]:
    return json.loads(json.dumps(QUADRUPED_HALF))  # shares nothing between the legs, as a deep copy would


@pytest.fixture
def graph() -> Callable[[dict[str, Any]], ModelGraph]:
    return lambda raw: build(to_document(raw))
