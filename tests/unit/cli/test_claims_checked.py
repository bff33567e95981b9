"""Claims that no run could judge are refused before anything runs."""

import pytest

from neuromech.errors import DocumentError
from neuromech.pipeline import load_document
from neuromech.verification import check_claims

TEXT = """\
neuromech: 1
name: claims
network:
  neurons:
    cell: {kind: rate_neuron, time_constant: 10 ms}
protocol: {duration: 10 ms}
record:
  all: {signals: ["*.activity"], every: 1 ms}
claims:
  top:
    claim: the cell is silent
    measure: {kind: maximun, signal: cell.activity}
    expected: {at_most: 0}
    source: this test
"""


def test_a_misspelt_measure_is_told_with_its_place(tmp_path):
    file = tmp_path / "claims.yaml"
    file.write_text(TEXT)
    with pytest.raises(DocumentError) as caught:
        check_claims(load_document(file))
    (problem,) = caught.value.problems
    assert (problem.mark.line, problem.path) == (12, "claims.top.measure")
    assert "'maximun' is not a measure. Hint: did you mean 'maximum'?" in str(problem)
