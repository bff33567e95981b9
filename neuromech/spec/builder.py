"""Parser events to a tree, with limits on depth and size and without what a document may not hold."""

from collections.abc import Callable

from ruamel.yaml.events import (
    AliasEvent,
    DocumentStartEvent,
    Event,
    MappingEndEvent,
    MappingStartEvent,
    ScalarEvent,
    SequenceEndEvent,
    SequenceStartEvent,
)

from neuromech.errors import DocumentError, Mark, Problem
from neuromech.spec.node import Entry, ListNode, MapNode, Node, ScalarNode, scalar_value

MAXIMAL_NODES = 200_000
MAXIMAL_DEPTH = 60
_CORE = "tag:yaml.org,2002:"
_CORE_TYPES: dict[str, tuple[type, ...]] = {
    "int": (int,),
    "float": (float, int),
    "bool": (bool,),
    "null": (type(None),),
}


class _Open:
    """A map or list whose end has not been read yet."""

    def __init__(self, mark: Mark | None, anchor: str | None, is_map: bool) -> None:
        self.mark = mark
        self.anchor = anchor
        self.is_map = is_map
        self.key: tuple[str, Mark | None] | None = None
        self.entries: dict[str, Entry] = {}
        self.items: list[Node] = []
        self.size = 1
        self.depth = 0

    def node(self) -> Node:
        """Return the finished map or list."""
        return MapNode(self.entries, self.mark) if self.is_map else ListNode(tuple(self.items), self.mark)


class TreeBuilder:
    """Builds the tree from parser events with a stack of its own, so that depth and size have limits."""

    def __init__(self, file: str | None) -> None:
        self._file = file
        self._stack: list[_Open] = []
        self._anchors: dict[str, tuple[Node, int, int]] = {}
        self._result: Node | None = None
        self._nodes = 0
        self._problems: list[Problem] = []

    def take(self, event: Event) -> None:
        """Take the next event of the parser."""
        for cls, handle in self._handlers():
            if isinstance(event, cls):
                handle(event)
                return

    def value(self) -> Node:
        """Return the finished tree, whatever it is.

        Raises:
            DocumentError: something in it is refused.
        """
        if self._problems:
            raise DocumentError(self._problems)
        return self._result if self._result is not None else ScalarNode("", False, None)

    def root(self) -> MapNode:
        """Return the finished tree of a file.

        Raises:
            DocumentError: something in it is refused, or the root is no map.
        """
        found = self.value()
        if isinstance(found, MapNode):
            return found
        message = "a document must be a map"
        empty = isinstance(found, ScalarNode) and scalar_value(found) is None
        got = "an empty file" if empty else "a list" if isinstance(found, ListNode) else "a single value"
        mark = Mark(self._file or "", 1, 1) if empty else found.mark
        raise DocumentError([Problem("not-a-map", "", message, got, "begin with 'neuromech: 1'", mark)])

    def _handlers(self) -> tuple[tuple[type[Event], Callable[..., None]], ...]:
        return (
            (ScalarEvent, self._scalar),
            (MappingStartEvent, self._open),
            (SequenceStartEvent, self._open),
            (MappingEndEvent, self._close),
            (SequenceEndEvent, self._close),
            (AliasEvent, self._alias),
            (DocumentStartEvent, self._document),
        )

    def _mark(self, event: Event) -> Mark | None:
        at = event.start_mark
        return Mark(self._file, at.line + 1, at.column + 1) if self._file is not None else None

    def _stop(self, code: str, message: str, event: Event, hint: str | None = None) -> DocumentError:
        return DocumentError([*self._problems, Problem(code, "", message, None, hint, self._mark(event))])

    def _document(self, event: DocumentStartEvent) -> None:
        if self._result is not None:
            raise self._stop(
                "second-document", "a second document begins here", event, "one file holds one document; remove '---'"
            )

    def _tag(self, event: ScalarEvent | MappingStartEvent | SequenceStartEvent) -> str | None:
        tag = event.tag
        if tag is None:
            return None
        kind = str(tag).removeprefix(_CORE)
        if str(tag).startswith(_CORE) and kind in {"str", "map", "seq", *_CORE_TYPES}:
            return kind
        shown = str(tag).replace(_CORE, "!!")
        self._problems.append(Problem("tag", "", "tags are not allowed", shown, "remove the tag", self._mark(event)))
        return None

    def _scalar(self, event: ScalarEvent) -> None:
        kind = self._tag(event)
        quoted = not event.implicit[0] if event.tag is None else kind not in _CORE_TYPES
        node = ScalarNode(event.value, quoted, self._mark(event))
        if kind in {"map", "seq"} or (kind in _CORE_TYPES and not isinstance(scalar_value(node), _CORE_TYPES[kind])):
            self._problems.append(
                Problem("tag", "", f"is not of the type '!!{kind}'", event.value[:60], None, node.mark)
            )
        top = self._stack[-1] if self._stack else None
        if top and top.is_map and top.key is None:
            self._key(top, node)
        else:
            self._spend(1, event)
            self._add(node, event.anchor, 1, 0)

    def _key(self, top: _Open, node: ScalarNode) -> None:
        if node.text == "<<" and not node.quoted:
            self._problems.append(
                Problem(
                    "merge-key", "", "the merge key '<<' is not allowed", None, "use 'extends' or a module", node.mark
                )
            )
        elif node.text in top.entries:
            first = top.entries[node.text].mark
            message = f"the key '{node.text[:60]}' stands twice in this map"
            hint = f"it first stands in line {first.line}, column {first.column}" if first else None
            self._problems.append(Problem("duplicate-key", "", message, None, hint, node.mark))
        elif not node.text:
            self._problems.append(Problem("empty-key", "", "a key is empty", None, None, node.mark))
        top.key = (node.text, node.mark)

    def _open(self, event: MappingStartEvent | SequenceStartEvent) -> None:
        self._tag(event)
        top = self._stack[-1] if self._stack else None
        if top and top.is_map and top.key is None:
            raise self._stop("complex-key", "a key must be a word", event)
        self._descend(1, event)
        self._spend(1, event)
        self._stack.append(_Open(self._mark(event), event.anchor, isinstance(event, MappingStartEvent)))

    def _close(self, _event: MappingEndEvent | SequenceEndEvent) -> None:
        done = self._stack.pop()
        self._add(done.node(), done.anchor, done.size, done.depth)

    def _alias(self, event: AliasEvent) -> None:
        if event.anchor not in self._anchors:
            raise self._stop("unknown-alias", f"no '&{event.anchor}' stands before '*{event.anchor}'", event)
        node, size, depth = self._anchors[event.anchor]
        top = self._stack[-1] if self._stack else None
        if top and top.is_map and top.key is None:
            raise self._stop("complex-key", "a key must be a word", event)
        self._descend(depth, event)
        self._spend(size, event)
        self._add(node, None, size, depth)

    def _descend(self, levels: int, event: Event) -> None:
        if len(self._stack) + levels > MAXIMAL_DEPTH:
            raise self._stop("too-deep", f"is nested more than {MAXIMAL_DEPTH} levels deep", event)

    def _spend(self, nodes: int, event: Event) -> None:
        self._nodes += nodes
        if self._nodes > MAXIMAL_NODES:
            raise self._stop(
                "too-many-values",
                f"holds or expands to more than {MAXIMAL_NODES} values",
                event,
                "use modules instead of nested aliases",
            )

    def _add(self, node: Node, anchor: str | None, size: int, depth: int) -> None:
        if anchor is not None:
            self._anchors[anchor] = (node, size, depth)
        if not self._stack:
            self._result = node
            return
        top = self._stack[-1]
        top.size += size
        top.depth = max(top.depth, depth + 1)
        if not top.is_map:
            top.items.append(node)
            return
        key, mark = top.key if top.key is not None else ("", None)
        top.key = None
        top.entries.setdefault(key, Entry(node, mark))
