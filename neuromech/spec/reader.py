"""Bytes to a tree: YAML 1.2 without tags, merge keys and second documents, and with limits on what it may cost."""

from functools import lru_cache
from pathlib import Path

from ruamel.yaml import YAML
from ruamel.yaml.error import MarkedYAMLError, YAMLError

from neuromech.errors import DocumentError, Mark, Problem
from neuromech.spec.builder import TreeBuilder
from neuromech.spec.node import MapNode, Node

MAXIMAL_BYTES = 2_000_000
_KINDS = {"block mapping": "map", "flow mapping": "map", "block sequence": "list", "flow sequence": "list"}


def read(path: Path) -> MapNode:
    """Return the tree of a file.

    Raises:
        DocumentError: the file cannot be read, is too large, or is no single YAML map of plain values.
    """
    file = str(path)
    try:
        size = path.stat().st_size
        if size > MAXIMAL_BYTES:
            raise _refused(
                "file-too-large",
                f"the file is larger than {MAXIMAL_BYTES / 1e6:g} MB",
                file,
                f"{size / 1e6:.1f} MB",
                "keep data out of documents, or split them with 'extends'",
            )
        content = path.read_bytes()
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
        raise _refused("unreadable-file", f"cannot be read: {reason}", file, None, None) from error
    return parse(content, file)


@lru_cache(maxsize=64)
def parse(content: bytes, file: str) -> MapNode:
    """Return the tree of a document's bytes; `file` is its name in messages.

    Raises:
        DocumentError: the bytes are no single YAML map of plain values.
    """
    text = _decode(content, file)
    builder = TreeBuilder(file)
    try:
        for event in YAML(typ="safe", pure=True).parse(text):
            builder.take(event)
    except MarkedYAMLError as error:
        raise DocumentError([_syntax(error, file, text)]) from error
    except (YAMLError, ValueError, OverflowError) as error:
        reason = str(error).strip().splitlines()[0] if str(error).strip() else "not understood"
        raise _refused("syntax", f"is not YAML: {reason}", file, None, None) from error
    return builder.root()


def parse_value(text: str) -> Node:
    """Return the tree of a value as it follows `=` in `--set`; its marks are None.

    Raises:
        DocumentError: the text is no YAML value.
    """
    builder = TreeBuilder(None)
    try:
        for event in YAML(typ="safe", pure=True).parse(text):
            builder.take(event)
    except (YAMLError, ValueError, OverflowError) as error:
        raise DocumentError([Problem("syntax", "", "the value is not YAML", repr(text[:60]))]) from error
    return builder.value()


def _decode(content: bytes, file: str) -> str:
    try:
        text = content.removeprefix(b"\xef\xbb\xbf").decode("utf-8")
    except UnicodeDecodeError as error:
        mark = _mark_at(content[: error.start].decode("utf-8", "replace"), file)
        raise DocumentError(
            [
                Problem(
                    "encoding",
                    "",
                    "is not UTF-8 text",
                    f"byte 0x{content[error.start]:02x}",
                    "save the file as UTF-8",
                    mark,
                )
            ]
        ) from error
    for position, character in enumerate(text):
        if character < " " and character not in "\n\r\t":
            mark = _mark_at(text[:position], file)
            raise DocumentError(
                [
                    Problem(
                        "encoding",
                        "",
                        "holds a control character",
                        f"U+{ord(character):04X}",
                        "a document is plain text",
                        mark,
                    )
                ]
            )
    return text


def _mark_at(before: str, file: str) -> Mark:
    lines = before.split("\n")
    return Mark(file, len(lines), len(lines[-1]) + 1)


def _refused(code: str, message: str, file: str, got: str | None, hint: str | None) -> DocumentError:
    return DocumentError([Problem(code, "", message, got, hint, Mark(file, 1, 1))])


def _syntax(error: MarkedYAMLError, file: str, text: str) -> Problem:
    at = error.problem_mark or error.context_mark
    mark = Mark(file, at.line + 1, at.column + 1) if at else Mark(file, 1, 1)
    message = str(error.problem or error.context or "not understood").strip()
    lines = text.splitlines()
    line = lines[mark.line - 1] if mark.line <= len(lines) else ""
    began = _began(error)
    hint = f"see the {began}" if began else None
    if "'\\t'" in message or "\t" in line[: mark.column]:
        message, hint = "a tab is not allowed here", "indent with spaces"
    elif "${" in line and any(bracket in line.split("${")[0] for bracket in "[{"):
        hint = "inside [ ] or { } put ${…} between quotes"
    elif "<block end>" in message:
        message = f"the indentation does not fit the {began}" if began else "the indentation does not fit"
        hint = None
    elif "mapping values" in message:
        message, hint = "a second ':' on this line", "put text that holds ': ' between quotes"
    return Problem("syntax", "", f"is not YAML: {message}", None, hint, mark)


def _began(error: MarkedYAMLError) -> str | None:
    context = str(error.context or "")
    if not context.startswith("while parsing a ") or not error.context_mark or not error.problem_mark:
        return None
    word = context.removeprefix("while parsing a ").strip()
    return f"{_KINDS.get(word, word)} that begins on line {error.context_mark.line + 1}"
