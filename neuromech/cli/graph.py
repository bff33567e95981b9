"""`neuromech graph`: a model as a list, a drawing, or a file for graph tools."""

from collections import Counter
from collections.abc import Callable, Sequence
from pathlib import Path

from rich.table import Table
from rich.text import Text

from neuromech.cli.consoles import results
from neuromech.cli.documents import checked_graph
from neuromech.cli.files import replace
from neuromech.cli.terminal import FINISHED, note
from neuromech.components.catalogue import Catalogue
from neuromech.errors import DocumentError, Problem
from neuromech.graph.model import ModelGraph

WRITERS = (".svg", ".graphml")


def graph(spec: Path, out: Path | None, overrides: Sequence[str]) -> int:
    """Show a model as a table, or write it to a file whose suffix says how; return the exit code.

    Raises:
        DocumentError: the document is wrong, or the suffix is unknown.
        OSError: the file cannot be written.
    """
    if out is not None and out.suffix not in WRITERS:
        raise DocumentError([Problem("suffix", "--out", f"must end in {' or '.join(WRITERS)}", repr(str(out)))])
    model = checked_graph(spec, Catalogue.installed(), overrides)
    if out is None:
        results().print(element_table(model))
        return FINISHED
    write = _writer(out.suffix)
    replace(out, lambda partial: write(model, partial))
    note(f"wrote {out}")
    return FINISHED


def element_table(model: ModelGraph) -> Table:
    """Return how many elements of each family each part of the model has, and its connections by kind."""
    elements = Counter((element.scope or "(document)", element.family) for element in model.elements())
    connections = Counter(connection.kind for _, _, connection in model.connections())
    table = Table("part", "what", "number", box=None, pad_edge=False)
    for (scope, family), number in elements.items():
        table.add_row(Text(scope), f"{family}s", str(number))
    for kind, number in connections.items():
        table.add_row("(connections)", kind, str(number))
    return table


def _writer(suffix: str) -> Callable[[ModelGraph, Path], None]:
    """Return what writes a model; drawing is loaded only here because it brings Matplotlib."""
    if suffix == ".svg":
        from neuromech.graph.draw import draw

        return draw
    from neuromech.graph.graphml import export_graphml

    return export_graphml
