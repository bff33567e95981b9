"""Every broken document in tests/invalid is told apart exactly: NAME.yaml is diagnosed as NAME.expected.txt says."""

from pathlib import Path

import pytest
from diagnose import diagnose

FOLDER = Path(__file__).parents[2] / "invalid"
DOCUMENTS = sorted(path.name for path in FOLDER.glob("*.yaml"))


@pytest.mark.parametrize("name", DOCUMENTS)
def test_broken_document_gets_exactly_the_expected_messages(name, monkeypatch):
    monkeypatch.chdir(FOLDER)
    expected = Path(name).with_suffix(".expected.txt").read_text(encoding="utf-8")
    assert expected.strip()
    assert diagnose(Path(name)) == expected


def test_there_are_many_broken_documents_and_no_expectation_without_one():
    assert len(DOCUMENTS) >= 40
    assert [path.name.removesuffix(".expected.txt") for path in sorted(FOLDER.glob("*.expected.txt"))] == sorted(
        name.removesuffix(".yaml") for name in DOCUMENTS
    )


def test_file_of_ten_megabytes_is_refused_unread(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("large.yaml").write_bytes(b"# data\n" * (10_000_000 // 7))
    assert diagnose(Path("large.yaml")) == (
        "large.yaml:1:1  the file is larger than 2 MB (got 10.0 MB). Hint: keep data out of documents, or split them "
        "with 'extends'\n"
    )


def test_file_that_does_not_exist(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert diagnose(Path("no.yaml")) == "no.yaml:1:1  cannot be read: No such file or directory.\n"


def test_folder_instead_of_a_file(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("folder").mkdir()
    assert diagnose(Path("folder")) == "folder:1:1  cannot be read: Is a directory.\n"
