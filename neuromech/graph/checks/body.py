"""Rules about segments, joints and contacts."""

from collections.abc import Iterator
from math import degrees

from neuromech.errors import Problem
from neuromech.graph.engines import refusals
from neuromech.graph.model import Element, ModelGraph
from neuromech.spec.model import Joint, Segment

_ROUNDING = 1.0 + 1e-9


def range_upside_down(graph: ModelGraph) -> Iterator[Problem]:
    """The range of a joint has its lower limit first, and room between the two."""
    for element, joint in _joints(graph):
        if joint.range is not None and not joint.range[0] < joint.range[1]:
            message = "must have its lower limit first and its upper limit second"
            yield graph.document.problem("joint-range", f"{element.path}.range", message, _range(joint))


def angle_outside_range(graph: ModelGraph) -> Iterator[Problem]:
    """A joint starts within its range, and a spring does not pull it out of its range."""
    for element, joint in _joints(graph):
        if joint.range is None or not joint.range[0] < joint.range[1]:
            continue
        for field, angle in _angles(joint):
            if not joint.range[0] <= angle <= joint.range[1]:
                path = f"{element.path}.{field}"
                message = f"is outside the joint's range of {_range(joint)}"
                yield graph.document.problem("joint-range", path, message, f"{degrees(angle):g} deg")


def zero_axis(graph: ModelGraph) -> Iterator[Problem]:
    """The axis of a joint has a direction."""
    for element, joint in _joints(graph):
        if not any(joint.axis):
            message = "must have a direction"
            yield graph.document.problem("zero-axis", f"{element.path}.axis", message, "[0, 0, 0]")


def inertia_of_no_body(graph: ModelGraph) -> Iterator[Problem]:
    """No principal moment of inertia exceeds the sum of the two others: no distribution of mass has that."""
    for element in graph.elements("segment"):
        assert isinstance(element.spec, Segment)
        moments = element.spec.inertia
        if 2.0 * max(moments) > sum(moments) * _ROUNDING:
            message = "violates the triangle inequality: each moment is at most the sum of the two others"
            got = f"[{', '.join(f'{moment:g}' for moment in moments)}] kg m^2"
            yield graph.document.problem("impossible-inertia", f"{element.path}.inertia", message, got)


def contact_without_ground(graph: ModelGraph) -> Iterator[Problem]:
    """A world in which something can touch the ground has a ground."""
    if graph.document.experiment.world.ground is not None:
        return
    for element in graph.elements("contact"):
        message = "can touch nothing: the world has no ground"
        hint = "add 'ground: {}' to 'world'"
        yield graph.document.problem("no-ground", element.path, message, hint=hint)


def hinge_engine(graph: ModelGraph) -> Iterator[Problem]:
    """The engine `hinge` moves one hinge joint on a fixed root."""
    body = graph.body
    if body is None or body.engine != "hinge":
        return
    kinds = [joint.kind for joint in body.joints.values()]
    if kinds != ["hinge"] or body.root.kind != "fixed":
        message = "needs exactly one hinge joint on a fixed root"
        got = f"{len(kinds)} joints ({', '.join(kinds)}) on a {body.root.kind} root"
        hint = "engines 'pybullet' and 'mujoco' move any tree"
        yield graph.document.problem("hinge-engine", "body.engine", message, got, hint)


def hinge_engine_knows_no_contact(graph: ModelGraph) -> Iterator[Problem]:
    """The engine `hinge` moves its joint exactly and knows no ground."""
    if graph.body is not None and graph.body.engine == "hinge":
        for element in graph.elements("contact"):
            hint = "use engine 'pybullet' or 'mujoco', or remove the contact"
            yield graph.document.problem("hinge-engine", element.path, "engine 'hinge' knows no contacts", hint=hint)


def engine_refusal(graph: ModelGraph) -> Iterator[Problem]:
    """The engine knows everything that is written of joints, contacts and the root."""
    body = graph.body
    if body is None or body.engine == "hinge":
        return
    for refusal in refusals(body, body.engine):
        path = graph.element(refusal.element).path if refusal.element else "body.root"
        place = f"{path}.{refusal.field}"
        yield graph.document.problem("unknown-to-engine", place, refusal.message, hint=refusal.hint)


def _joints(graph: ModelGraph) -> Iterator[tuple[Element, Joint]]:
    for element in graph.elements("joint"):
        assert isinstance(element.spec, Joint)
        yield element, element.spec


def _angles(joint: Joint) -> Iterator[tuple[str, float]]:
    yield "initial_angle", joint.initial_angle
    if joint.stiffness > 0.0 or "rest_angle" in joint.model_fields_set:
        yield "rest_angle", joint.rest_angle


def _range(joint: Joint) -> str:
    assert joint.range is not None
    return f"[{degrees(joint.range[0]):g} deg, {degrees(joint.range[1]):g} deg]"
