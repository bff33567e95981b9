"""Rules about pendulums: something to hit, a place to hang, time to swing, and a start outside the body."""

from collections.abc import Iterator

from neuromech.errors import Problem
from neuromech.graph.model import Element, ModelGraph
from neuromech.graph.swing import depth
from neuromech.spec.pendulum import Pendulum


def hinge_engine_knows_no_pendulum(graph: ModelGraph) -> Iterator[Problem]:
    """The engine `hinge` knows no collisions."""
    if graph.body is not None and graph.body.engine == "hinge":
        for element in graph.elements("pendulum"):
            hint = "use engine 'pybullet' or 'mujoco'"
            yield graph.document.problem("hinge-engine", element.path, "engine 'hinge' knows no pendulums", hint=hint)


def pendulum_without_place(graph: ModelGraph) -> Iterator[Problem]:
    """A pendulum has a target or a pivot, and gravity to swing by."""
    for element, pendulum in _pendulums(graph):
        if (pendulum.target is None) == (pendulum.pivot is None):
            got = "none" if pendulum.target is None else "both"
            yield graph.document.problem("two-ways", element.path, "needs a target or a pivot", got)
        if graph.document.experiment.world.gravity == 0.0:
            message = "does not swing: the world has no gravity"
            yield graph.document.problem("no-gravity", element.path, message)


def pendulum_after_the_end(graph: ModelGraph) -> Iterator[Problem]:
    """A pendulum is released before the run ends."""
    duration = float(graph.document.experiment.protocol.duration)
    for element, pendulum in _pendulums(graph):
        if pendulum.release >= duration:
            message, got = f"must be before {duration:g} s, when the run ends", f"{float(pendulum.release):g} s"
            yield graph.document.problem("after-the-end", f"{element.path}.release", message, got)


def pendulum_in_the_body(graph: ModelGraph) -> Iterator[Problem]:
    """The segment has a shape, and the weight starts outside it."""
    body = graph.body
    if body is None or any(pendulum_without_place(graph)) or any(not any(joint.axis) for joint in body.joints.values()):
        return
    for element, pendulum in _pendulums(graph):
        if body.segments[pendulum.segment].shape is None:
            message, hint = f"hits '{pendulum.segment}', which has no shape", "give the segment a 'shape'"
            yield graph.document.problem("no-shape", f"{element.path}.segment", message, hint=hint)
            continue
        inside = depth(body, pendulum)
        if inside > 0.0:
            message = f"starts inside '{pendulum.segment}', {1e3 * inside:.3g} mm deep"
            hint = "move the pivot or lengthen the string"
            field = "target" if pendulum.pivot is None else "pivot"
            yield graph.document.problem("pendulum-inside", f"{element.path}.{field}", message, hint=hint)


def _pendulums(graph: ModelGraph) -> Iterator[tuple[Element, Pendulum]]:
    for element in graph.elements("pendulum"):
        assert isinstance(element.spec, Pendulum)
        yield element, element.spec
