"""Populations in the graph: one node each, named, drawn, compared, and chosen by index."""

import networkx as nx
import pytest

from neuromech.errors import DocumentError
from neuromech.graph.build import build
from neuromech.graph.check import check
from neuromech.graph.diff import diff
from neuromech.graph.draw import draw
from neuromech.graph.graphml import export_graphml
from neuromech.graph.signals import matching, signals
from neuromech.pipeline import load_document

TEXT = """
modules:
  side:
    network:
      populations:
        pool: {size: 8000, neuron: {kind: rybak_interneuron, layer: motoneuron}}
instances:
  left: {use: side}
  right: {use: side}
network:
  drives: {brain: {kind: descending_drive, strength: 1}}
  projections:
    across: {sender: left.pool, receiver: right.pool, in_degree: 100, synapse: {kind: excitatory, weight: 0.02}}
  synapses: {excitatory: {brain: {left.pool: 1}}}
protocol: {duration: 1 s}
"""


@pytest.fixture
def graph(document):
    found = build(load_document(document(TEXT)))
    check(found)
    return found


def test_one_node_for_a_population_and_one_edge_for_a_projection(graph):
    assert list(graph.graph.nodes) == ["brain", "left.pool", "right.pool"]
    assert [(one, two, edge.kind) for one, two, edge in graph.connections()] == [
        ("brain", "left.pool", "synapse"),
        ("left.pool", "right.pool", "projection"),
    ]
    assert "left.pool.activity" in signals(graph)


def test_motoneurons_are_reached_through_populations(document):
    cut = TEXT.replace("synapses: {excitatory: {brain: {left.pool: 1}}}", "synapses: {}")
    with pytest.raises(DocumentError, match=r"no path of synapses leads to this motoneuron"):
        check(build(load_document(document(cut))))


def test_picture_and_graphml_show_one_symbol_with_its_size(graph, tmp_path):
    draw(graph, tmp_path / "picture.svg")
    picture = (tmp_path / "picture.svg").read_text(encoding="utf-8")
    assert picture.count("×8000") == 2
    export_graphml(graph, tmp_path / "graph.graphml")
    nodes = nx.read_graphml(tmp_path / "graph.graphml").nodes
    assert {name: node["size"] for name, node in nodes.items()} == {"brain": 1, "left.pool": 8000, "right.pool": 8000}


def test_difference_names_what_changed_in_populations_and_projections(graph, document):
    other = build(load_document(document(TEXT.replace("size: 8000", "size: 400").replace("100,", "50,"))))
    assert str(diff(graph, other)).splitlines() == [
        "~ instances.left.network.populations.pool.size: 8000 → 400",
        "~ instances.right.network.populations.pool.size: 8000 → 400",
        "~ network.projections.across.in_degree: 100 → 50",
    ]


@pytest.mark.parametrize(
    ("pattern", "indices"),
    [
        ("left.pool[17].activity", [17]),
        ("left.pool[7998:].activity", [7998, 7999]),
        ("left.pool[0:10:4].activity", [0, 4, 8]),
        ("left.p*[:2].activ*", [0, 1]),
        ("left.pool[8000].activity", []),
    ],
)
def test_neurons_are_chosen_by_index(pattern, indices):
    found = matching(pattern, ["left.pool.activity", "left.pool.potential"], {"left.pool": 8000})
    assert found == [f"left.pool[{index}].activity" for index in indices]


def test_patterns_without_index_mean_the_mean():
    names = ["pool.activity", "pool[3].activity"]
    assert matching("pool.activity", names, {"pool": 9}) == ["pool.activity"]
    assert matching("pool[*].activity", names) == ["pool[3].activity"]
