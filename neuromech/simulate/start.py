"""The body at time zero: pose, angles, velocities and ground, as the document says or as they are drawn."""

from dataclasses import replace

from neuromech.compiler.wiring import generator
from neuromech.errors import DocumentError
from neuromech.graph.model import BodyModel, ModelGraph
from neuromech.graph.pose import sunk
from neuromech.graph.start import started, written_start
from neuromech.simulate.ground import drawn_ground


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
    ground = drawn_ground(body.world.ground, seed)
    body = replace(body, world=body.world.model_copy(update={"ground": ground}))
    start = written_start(body, graph.document.experiment.protocol.initial)
    values = {
        name: low + float(generator(seed, name).random()) * (high - low) for name, (_, low, high) in start.items()
    }
    drawn = started(body, values) if start else body
    found = sunk(drawn) if body.engine != "hinge" else None
    if found is not None:
        message = f"contact '{found[0]}' starts {1e3 * found[1]:.3g} mm below the ground with seed {seed}"
        hint = "raise the root, or make the random start smaller"
        raise DocumentError([graph.document.problem("start-below-ground", "protocol.initial", message, hint=hint)])
    return drawn
