"""The body as a tree of segments and joints: its one root, its order, and the joints between two segments."""

from collections.abc import Iterator, Mapping

import networkx as nx

from neuromech.errors import Problem
from neuromech.graph.model import BodyModel, Element
from neuromech.spec.document import Document
from neuromech.spec.model import Contact, Joint, Segment


def body_model(document: Document, elements: list[Element]) -> tuple[BodyModel | None, list[Problem]]:
    """Return the body of resolved elements, None without one, and what keeps it from being a tree with one root."""
    segments = {one.name: one for one in elements if one.family == "segment"}
    joints = {one.name: one for one in elements if one.family == "joint"}
    body = document.experiment.body
    if body is None:
        return None, list(_parts_without_body(document, elements))
    problems = list(_tree_problems(document, segments, joints))
    if problems:
        return None, problems
    joint_specs = {name: one.spec for name, one in joints.items() if isinstance(one.spec, Joint)}
    segment_specs = {name: one.spec for name, one in segments.items() if isinstance(one.spec, Segment)}
    children = {joint.child for joint in joint_specs.values()}
    model = BodyModel(
        engine=body.engine,
        file=body.file,
        root=body.root,
        root_segment=next(name for name in segments if name not in children),
        segments={name: segment_specs[name] for name in _segment_order(segment_specs, joint_specs)},
        joints={name: joint_specs[name] for name in _joint_order(joint_specs)},
        contacts={one.name: one.spec for one in elements if isinstance(one.spec, Contact)},
        world=document.experiment.world,
    )
    return model, []


def _parts_without_body(document: Document, elements: list[Element]) -> Iterator[Problem]:
    for one in elements:
        if one.family in ("segment", "joint", "contact"):
            hint = "add 'body:' to the document, with its engine and root"
            yield document.problem("no-body", one.path, "needs a body, and the document has none", hint=hint)
            return


def _tree_problems(
    document: Document, segments: Mapping[str, Element], joints: Mapping[str, Element]
) -> Iterator[Problem]:
    if not segments:
        yield document.problem("no-segment", "body", "has no segment", hint="list its segments under 'segments'")
        return
    parent_joint: dict[str, str] = {}
    for name, element in joints.items():
        assert isinstance(element.spec, Joint)
        child = element.spec.child
        if child in parent_joint:
            got = f"'{child}', already the child of joint '{parent_joint[child]}'"
            hint = "a body is a tree: each segment is the child of one joint"
            yield document.problem("two-parents", f"{element.path}.child", "gives a segment a second parent", got, hint)
        else:
            parent_joint[child] = name
    yield from _cycle_problems(document, list(segments), joints, parent_joint)
    roots = [name for name in segments if name not in parent_joint]
    for name in roots[1:]:
        message = f"is a second root beside '{roots[0]}': it is the child of no joint"
        hint = "add the joint that holds it"
        yield document.problem("two-roots", segments[name].path, message, hint=hint)


def _cycle_problems(
    document: Document, segments: list[str], joints: Mapping[str, Element], parent_joint: Mapping[str, str]
) -> Iterator[Problem]:
    links = nx.DiGraph()
    for child, name in parent_joint.items():
        spec = joints[name].spec
        assert isinstance(spec, Joint)
        links.add_edge(spec.parent, child)
    for cycle in nx.simple_cycles(links):
        first = cycle.index(min(cycle, key=segments.index))
        around = " → ".join([*cycle[first:], *cycle[: first + 1]])
        path = f"{joints[parent_joint[cycle[first]]].path}.parent"
        yield document.problem("body-cycle", path, "closes a cycle of segments, a body is a tree", around)


def _segment_order(segments: Mapping[str, Segment], joints: Mapping[str, Joint]) -> list[str]:
    links = nx.DiGraph()
    links.add_nodes_from(segments)
    links.add_edges_from((joint.parent, joint.child) for joint in joints.values())
    return _parents_first(links)


def _joint_order(joints: Mapping[str, Joint]) -> list[str]:
    towards = {joint.child: name for name, joint in joints.items()}
    links = nx.DiGraph()
    links.add_nodes_from(joints)
    links.add_edges_from((towards[one.parent], name) for name, one in joints.items() if one.parent in towards)
    return _parents_first(links)


def _parents_first(links: "nx.DiGraph[str]") -> list[str]:
    """Return the nodes with parents before children, otherwise in the order in which they were added."""
    authored = {name: index for index, name in enumerate(links)}
    return list(nx.lexicographical_topological_sort(links, key=authored.__getitem__))


def chain(body: BodyModel, start: str, end: str) -> list[str]:
    """Return the joints on the way from one segment to another, in that order."""
    towards = {joint.child: name for name, joint in body.joints.items()}
    up = _joints_to_root(body, towards, start)
    down = _joints_to_root(body, towards, end)
    while up and down and up[-1] == down[-1]:
        up.pop()
        down.pop()
    return up + down[::-1]


def _joints_to_root(body: BodyModel, towards: Mapping[str, str], segment: str) -> list[str]:
    joints = []
    while segment in towards:
        joints.append(towards[segment])
        segment = body.joints[towards[segment]].parent
    return joints
