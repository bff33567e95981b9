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


def refused(tmp_path, *changes):
    """Return the message of the claim after each (old, new) text was replaced."""
    text = TEXT.replace("maximun", "maximum")
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    file = tmp_path / "claims.yaml"
    file.write_text(text)
    try:
        check_claims(load_document(file))
    except DocumentError as error:
        return "\n".join(map(str, error.problems)).replace(f"{file}:", "")
    return ""


MEASURE = "{kind: maximum, signal: cell.activity}"
FEET = "[a, b, c, d]"


@pytest.mark.parametrize(
    ("measure", "expected", "said"),
    [
        (
            "{kind: duty_factor, feet: [a]}",
            "{at_least: 1.2}",
            "13:5  claims.top.expected  can never be met: measure 'duty_factor' gives 0 to 1 (got at least 1.2).",
        ),
        (
            f"{{kind: gait, feet: {FEET}}}",
            "{equals: galop}",
            "13:5  claims.top.expected  can never be met: measure 'gait' gives trot, pace, bound, pronk, "
            "lateral-sequence walk, diagonal-sequence walk, gallop, no symmetrical gait (got galop). "
            "Hint: did you mean 'gallop'?",
        ),
        (
            "{kind: range, signal: cell.activity}",
            "{value: -0.3, within: 0.1}",
            "13:5  claims.top.expected  can never be met: measure 'range' gives at least 0 (got -0.3 ± 0.1).",
        ),
        ("{kind: duty_factor, feet: [a]}", "{value: 1.1, within: 10 %}", ""),
        ("{kind: duty_factor, feet: [a]}", "{at_least: 1}", ""),
        (f"{{kind: gait, feet: {FEET}}}", "{equals: gallop}", ""),
    ],
)
def test_what_a_measure_can_never_give_is_refused_with_its_place(tmp_path, measure, expected, said):
    assert refused(tmp_path, (MEASURE, measure), ("{at_most: 0}", expected)) == said


def test_differences_and_ratios_have_limits_of_their_own(tmp_path):
    duty = (MEASURE, "{kind: duty_factor, feet: [a]}")
    sweep = ("    source: this", "    sweep: {network.neurons.cell.bias: [0, 1]}\n    source: this")
    compare = ("    source: this", "    compare: {network.neurons.cell.bias: 1}\n    source: this")
    assert refused(tmp_path, duty, ("{at_most: 0}", "{at_most: -0.5}"), sweep) == ""
    assert "is a difference and can never be met: measure 'duty_factor' gives -1 to 1" in refused(
        tmp_path, duty, ("{at_most: 0}", "{at_most: -1.5}"), sweep
    )
    assert refused(tmp_path, duty, ("{at_most: 0}", "{at_least: 1.5}"), compare) == ""
    assert "is a ratio and can never be met: measure 'duty_factor' gives at least 0" in refused(
        tmp_path, duty, ("{at_most: 0}", "{at_most: -1}"), compare
    )
    signed = (MEASURE, "{kind: correlation, signal: cell.activity, reference: cell.activity}")
    assert refused(tmp_path, signed, ("{at_most: 0}", "{at_most: -4}"), compare) == ""
