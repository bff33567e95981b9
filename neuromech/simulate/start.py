"""The body at time zero: pose, angles and velocities, as the protocol says or as they are drawn."""

from neuromech.compiler.wiring import generator
from neuromech.errors import DocumentError
from neuromech.graph.model import BodyModel, ModelGraph
from neuromech.graph.pose import sunk
from neuromech.graph.start import started, written_start


def drawn_body(graph: ModelGraph, seed: int) -> BodyModel | None:
    """Return the body of a run as it starts, None without a body.

    Each value of `protocol.initial` that is a distribution has a random number of its own, made from the seed and the
    name of the value, so that nothing depends on how a document is arranged, nor on the engine.

    Raises:
        DocumentError: the start that was drawn puts a contact into the ground.
    """
    body = graph.body
    if body is None:
        return None
    start = written_start(body, graph.document.experiment.protocol.initial)
    if not start:
        return body
    values = {
        name: low + float(generator(seed, name).random()) * (high - low) for name, (_, low, high) in start.items()
    }
    drawn = started(body, values)
    found = sunk(drawn)
    if found is not None:
        message = f"contact '{found[0]}' starts {1e3 * found[1]:.3g} mm below the ground with seed {seed}"
        hint = "raise the root, or make the random start smaller"
        raise DocumentError([graph.document.problem("start-below-ground", "protocol.initial", message, hint=hint)])
    return drawn
