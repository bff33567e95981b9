"""Every snippet of the documentation does what the text says.

In each Markdown file the blocks are executed in order, in one temporary folder. `<!-- file: name.yaml -->` before a
block writes it to a file. Whole documents are run for a few steps unless the comment says `broken`. `python` blocks
that are no file are executed. `console` blocks run each `$ neuromech …` line and compare the output that is shown,
where `...` stands for any text.
"""

import contextlib
import io
import re
import shlex
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest

from neuromech.cli.main import run_arguments
from neuromech.pipeline import run

ROOT = Path(__file__).parents[1]
PAGES = (ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md")), ROOT / "plugins" / "README.md")
BLOCK = re.compile(
    r"^(?:<!-- (?P<role>file|broken): (?P<file>\S+) -->\n)?```(?P<language>\w*)\n(?P<text>.*?)^```$",
    re.MULTILINE | re.DOTALL,
)


@dataclass(frozen=True)
class Snippet:
    language: str
    text: str
    file: str | None
    broken: bool
    line: int


def snippets(page: str) -> Iterator[Snippet]:
    for found in BLOCK.finditer(page):
        line = page.count("\n", 0, found.start("text")) + 1
        yield Snippet(found["language"], found["text"], found["file"], found["role"] == "broken", line)


def is_whole_document(snippet: Snippet) -> bool:
    return snippet.language == "yaml" and re.search(r"^neuromech: *1", snippet.text, re.MULTILINE) is not None


def commands(console: str) -> Iterator[tuple[str, str]]:
    """Yield (command, expected output) of a console block."""
    for part in re.split(r"^\$ ", console, flags=re.MULTILINE)[1:]:
        command, _, output = part.partition("\n")
        yield command, output


def output_of(command: str) -> str:
    stream = io.StringIO()
    with contextlib.redirect_stdout(stream), contextlib.redirect_stderr(stream), pytest.raises(SystemExit):
        run_arguments(shlex.split(command)[1:])
    return stream.getvalue()


def matches(expected: str, got: str) -> bool:
    """Tell whether an output is as shown: line by line without trailing blanks, `...` for any text, lines included."""
    wanted = "\n".join(line.rstrip() for line in expected.strip().splitlines())
    found = "\n".join(line.rstrip() for line in got.strip().splitlines())
    pattern = ".*".join(re.escape(part) for part in wanted.split("..."))
    return re.fullmatch(pattern, found, re.DOTALL) is not None


def execute(snippet: Snippet, namespace: dict[str, object]) -> None:
    if snippet.file:
        Path(snippet.file).parent.mkdir(parents=True, exist_ok=True)
        Path(snippet.file).write_text(snippet.text, encoding="utf-8")
    if is_whole_document(snippet) and not snippet.broken:
        file = Path(snippet.file or "snippet.yaml")
        file.write_text(snippet.text, encoding="utf-8")
        assert run(file, duration=0.005).outcome.kind == "finished"
    elif snippet.language == "python" and not snippet.file:
        exec(compile(snippet.text, f"line {snippet.line}", "exec"), namespace)
    elif snippet.language == "console":
        for command, expected in commands(snippet.text):
            if command.startswith("neuromech "):
                got = output_of(command)
                if expected.strip() and not matches(expected, got):
                    raise AssertionError(f"this is shown:\n$ {command}\n{expected}\nbut this comes out:\n{got}")


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.relative_to(ROOT).as_posix())
def test_every_snippet_does_what_the_page_says(page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.setenv("COLUMNS", "200")
    namespace: dict[str, object] = {"__name__": "snippet"}
    for snippet in snippets(page.read_text("utf-8")):
        print(f"{page.name}, snippet at line {snippet.line}")  # noqa: T201 (shown by pytest where the test fails)
        execute(snippet, namespace)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.relative_to(ROOT).as_posix())
def test_every_relative_link_leads_somewhere(page: Path):
    links = re.findall(r"\]\((?!https?:|#)([^)#]+)", page.read_text("utf-8"))
    assert [link for link in links if not (page.parent / link).exists()] == []


def test_a_difference_in_output_is_noticed():
    assert matches("a ... c\n", "a b c\n\n")
    assert not matches("a b\n", "a b c\n")
    assert not matches("a ... d\n", "a b c\n")


def test_blocks_are_found_with_their_roles():
    document = "text\n<!-- broken: x.yaml -->\n```yaml\nneuromech: 1\n```\n"
    page = f"{document}\n```console\n$ neuromech a\nout\n$ neuromech b\n```\n"
    found = list(snippets(page))
    assert [(one.language, one.file, one.broken, one.line) for one in found] == [
        ("yaml", "x.yaml", True, 4),
        ("console", None, False, 8),
    ]
    assert list(commands(found[1].text)) == [("neuromech a", "out\n"), ("neuromech b", "")]
