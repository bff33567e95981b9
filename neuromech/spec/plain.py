"""A tree to plain values for the typed model, and to YAML text for provenance."""

import json
import re
from functools import lru_cache
from typing import Any

from neuromech.spec.node import ListNode, MapNode, Node, ScalarNode, scalar_value
from neuromech.units import BoundText

_WORD = re.compile(r"(-(?=[0-9])|[A-Za-z0-9_+/])[A-Za-z0-9_.+/ ^*()%µ-]*$")


def plain(node: Node) -> Any:
    """Return maps, lists, text, numbers, true, false and None; text of a parameter remembers its name."""
    if isinstance(node, MapNode):
        return {key: plain(entry.node) for key, entry in node.entries.items()}
    if isinstance(node, ListNode):
        return [plain(item) for item in node.items]
    return BoundText(node.text, node.parameter) if node.parameter is not None else scalar_value(node)


def to_yaml(tree: MapNode) -> str:
    """Return a tree as YAML: maps as blocks, lists on one line where they hold single values only."""
    return "\n".join(_block(tree, "")) + "\n"


def _block(node: MapNode | ListNode, indent: str) -> list[str]:
    lines: list[str] = []
    if isinstance(node, MapNode):
        heads = [(f"{indent}{_quoted(key)}:", entry.node) for key, entry in node.entries.items()]
    else:
        heads = [(f"{indent}-", item) for item in node.items]
    for head, child in heads:
        flow = _flow(child)
        lines.extend([f"{head} {flow}"] if flow is not None else [head, *_block_of(child, indent + "  ")])
    return lines


def _block_of(node: Node, indent: str) -> list[str]:
    return [] if isinstance(node, ScalarNode) else _block(node, indent)


def _flow(node: Node) -> str | None:
    if isinstance(node, ScalarNode):
        return _scalar(node)
    if isinstance(node, MapNode):
        return None if node.entries else "{}"
    items = [_flow(item) for item in node.items]
    return None if None in items else f"[{', '.join(item or '' for item in items)}]"


def _scalar(node: ScalarNode) -> str:
    if node.quoted:
        return _quoted(node.text)
    value = scalar_value(node)
    if value is None:
        return "null"
    return _quoted(node.text) if isinstance(value, str) else node.text


@lru_cache(maxsize=4096)
def _quoted(text: str) -> str:
    harmless = _WORD.match(text) and not text.endswith(" ")
    if harmless and isinstance(scalar_value(ScalarNode(text, False, None)), str):
        return text
    return json.dumps(text, ensure_ascii=False)
