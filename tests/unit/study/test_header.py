"""A study goes on only with the document that it was begun with."""

from pathlib import Path

import pytest
from searches import DOCUMENT, plan_in

from neuromech.study.header import Header


def changes(folder: Path, old: str, new: str) -> list[str]:
    """Return what differs after some text of the document was replaced."""
    assert old in DOCUMENT
    before = plan_in(folder).header
    after = plan_in(folder, text=DOCUMENT.replace(old, new)).header
    return [str(change) for change in before.changes(after)]


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("bias: 1}", "bias: 2}", "network.neurons.first.bias: 1 → 2"),
        ("seed: 3", "seed: 4", "study.seed: 3 → 4"),
        ("maximum: 2}", "maximum: 3}", "parameters.gain.maximum: 2 → 3"),
        ("target: 0.3", "target: 0.4", "study.objective.terms.level.target: 0.3 → 0.4"),
        ("tune: {gain: {},", "tune: {", "study.tune.gain: {} → –"),
        ("tune: {gain: {}, delay: {scale: log}}", "tune: {delay: {scale: log}, gain: {}}", "order: study.tune.gain"),
        ("every: 1 ms", "every: 2 ms", "record.all.every: 1 ms → 2 ms"),
        (
            "protocol: {duration: 50 ms}",
            "protocol: {duration: 50 ms}\nsolver: {method: lsoda}",
            "solver.method: – → lsoda",
        ),
    ],
)
def test_what_changes_the_numbers_is_a_change(tmp_path: Path, old: str, new: str, said: str):
    found = changes(tmp_path, old, new)
    assert any(change.startswith(said) for change in found), found


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("evaluations: 14", "evaluations: 140"),
        ("evaluations: 14", "evaluations: 14\n  confirm: {candidates: 2}"),
        ("name: two cells", "name: two cells\ndescription: of no consequence"),
        ("gain: {value: 0.5,", "gain: {value: 0.5, description: how much, source: a book,"),
        ("study:\n", "references: {a: a book}\nstudy:\n"),
        ("bias: 1}", "bias:     1} # the same"),
    ],
)
def test_what_does_not_change_the_numbers_is_no_change(tmp_path: Path, old: str, new: str):
    assert changes(tmp_path, old, new) == []


def test_a_header_survives_its_storage_and_tells_other_versions(tmp_path: Path):
    header = plan_in(tmp_path).header
    assert Header.from_dict(header.to_dict()) == header
    older = Header.from_dict({**header.to_dict(), "versions": {**header.versions, "numpy": "1.0"}})
    assert [change.path for change in older.other_versions(header)] == ["numpy"]
    assert older.changes(header) == []


def test_the_body_counts_with_its_content(tmp_path: Path):
    header = plan_in(tmp_path).header
    one, other = (Header.from_dict({**header.to_dict(), "body": digest}) for digest in ("a" * 64, "b" * 64))
    assert [change.path for change in one.changes(other)] == ["content of body.file"]
