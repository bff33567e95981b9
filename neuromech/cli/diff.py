"""`neuromech diff`: what differs between two models."""

from pathlib import Path

from neuromech.cli.documents import checked_graph
from neuromech.cli.terminal import FINISHED, note, write_line
from neuromech.components.catalogue import Catalogue
from neuromech.graph.diff import diff as difference


def diff(first: Path, second: Path) -> int:
    """Write what one has to remove (-), add (+) and change (~) in the first model to get the second.

    Raises:
        DocumentError: a document is wrong.
    """
    catalogue = Catalogue.installed()
    found = difference(checked_graph(first, catalogue), checked_graph(second, catalogue))
    if found.is_empty:
        note("the two models are the same")
    else:
        write_line(str(found))
    return FINISHED
