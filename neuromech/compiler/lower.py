"""ModelGraph → Program: names become positions, structure becomes arrays, kinds become one compiled step."""

import os
from collections.abc import Iterable

import numpy as np

from neuromech.compiler.buffers import Buffer, Reserve
from neuromech.compiler.cache import module_file
from neuromech.compiler.generate import generate
from neuromech.compiler.layout import Layout
from neuromech.compiler.lower_body import (
    body_signals,
    force_slots,
    joint_parameters,
    muscle_signals,
    muscles,
    push_signals,
    structure,
)
from neuromech.compiler.lower_components import Block, blocks, parameters, place
from neuromech.compiler.lower_connections import connections, evaluation_order
from neuromech.compiler.lower_paths import paths
from neuromech.compiler.numerics import Floats
from neuromech.compiler.program import Program
from neuromech.compiler.records import record_groups, record_sections, recorded_names
from neuromech.compiler.shape import COMMON, FixedStep, Shape
from neuromech.compiler.team import SIZE as TEAM
from neuromech.compiler.timeline import timeline
from neuromech.compiler.tree import Tree, lower_tree
from neuromech.errors import DocumentError
from neuromech.graph.model import BodyModel, ModelGraph

_STAGE_ARRAYS = 4
# Synapses from which on a second thread makes a step shorter (docs/performance.md).
_BREAK_EVEN = 300_000


def lower(graph: ModelGraph) -> Program:
    """Lower a model that was built and checked.

    Raises:
        DocumentError: delays with an adaptive solver, overlapping changes of a parameter, or a change during the run
            of what cannot change.
    """
    header = dict.fromkeys(COMMON, 0)
    integers, floats, work, layout = Buffer(header, np.int64), Buffer(header, np.float64), Reserve(header), Layout()
    solver = graph.document.experiment.solver
    parts = blocks(graph)
    place(parts, header, layout)
    tree = lower_tree(graph.body) if graph.body else None
    elements = muscles(graph)
    if tree is not None:
        pendulums = [element.name for element in graph.elements("pendulum")]
        body_signals(tree, layout, integers, _tracked(graph), pendulums)
        push_signals(graph, layout)
        muscle_signals(elements, layout, header)
        force_slots(elements, layout, integers)
    parameters(parts, floats, layout)
    connected = connections(graph, parts, layout, float(solver.step), integers, floats, work)
    evaluation_order(graph, parts, integers)
    points = _lower_mechanics(graph, graph.body, tree, layout, integers, floats, work)
    timeline(graph.document, layout, integers, floats)
    work.add("base", layout.input_count)
    work.add("stages", _STAGE_ARRAYS * layout.state_count)
    work.add("advanced", layout.state_count)
    floats.add("muscle_step", [float(solver.muscle_step)])
    header["explicit"] = int(solver.coupling == "explicit")
    substeps = header["substeps"] = round(float(solver.body_step) / float(solver.step)) if tree else 1
    records = record_groups(graph, float(solver.body_step if tree else solver.step))
    record_sections(records, layout, integers)
    integers.add("team", np.zeros(TEAM, dtype=np.int64))
    threads = _threads(solver.threads, connected.synapses)
    shape = Shape(
        tuple(part.shape for part in parts),
        _fixed_step(graph, parts, connected.has_delays),
        has_body=tree is not None,
        has_delays=connected.has_delays,
        has_shared_weights=connected.has_shared_weights,
        has_short_rows=connected.has_short_rows and threads == 1,
        has_threads=threads > 1,
    )
    source = generate(shape)
    return Program(
        graph=graph,
        shape=shape,
        source=source,
        module_file=module_file(source, [part.shape.cls for part in parts]),
        layout=layout,
        header=header,
        integers=_with_header(integers, shape),
        parameters=floats.array(),
        work_size=work.size,
        tree=tree,
        path_points=points,
        initial=_initial(parts, layout),
        substeps=substeps,
        threads=threads,
        records=records,
    )


def _tracked(graph: ModelGraph) -> Iterable[str]:
    """Return the segments whose motion is looked at: what sensors refer to, what is recorded."""
    segments = {element.name for element in graph.elements("segment")}
    yield from (sender for sender, _, _ in graph.connections("wire") if sender in segments)
    for name in recorded_names(graph):
        if name.rpartition(".")[0] in segments:
            yield name.rpartition(".")[0]


def _lower_mechanics(
    graph: ModelGraph,
    body: BodyModel | None,
    tree: Tree | None,
    layout: Layout,
    integers: Buffer,
    floats: Buffer,
    work: Reserve,
) -> int:
    if body is None or tree is None:
        return 0
    elements = muscles(graph)
    n, m = len(tree.joints), len(elements)
    joint_parameters(graph, body, layout, floats)
    structure(tree, integers)
    work.add("last_velocity", n)
    work.add("last_torque", n)
    work.add("work", 2 * m + n + tree.root)
    return paths(elements, tree, graph, layout, integers, floats, work)


def _fixed_step(graph: ModelGraph, parts: Iterable[Block], has_delays: bool) -> FixedStep:
    method = graph.document.experiment.solver.method
    if method == "rk4" or method == "exponential_euler" or method == "rush_larsen":
        return method
    if has_delays:
        hint = "use rk4, rush_larsen or exponential_euler, or remove the delays"
        message = "an adaptive solver cannot run a network with delays"
        raise DocumentError([graph.document.problem("delay-solver", "solver.method", message, method, hint)])
    if graph.body is None and any(part.shape.cls.advance for part in parts):
        message = "an adaptive solver cannot run units that remember from step to step"
        hint = "use rk4 or exponential_euler"
        raise DocumentError([graph.document.problem("memory-solver", "solver.method", message, method, hint)])
    return "rk4"


def _with_header(integers: Buffer, shape: Shape) -> "np.ndarray[tuple[int], np.dtype[np.int64]]":
    positions = shape.header()
    size = len(positions)
    values = integers.array(front=size)
    for name, position in positions.items():
        shifted = name in integers.sections
        values[position] = integers.header[name] + (size if shifted else 0)
        integers.header[name] = int(values[position])
    return values


def _initial(parts: Iterable[Block], layout: Layout) -> Floats:
    values = np.zeros(layout.state_count)
    first = 0
    for part in parts:
        for state in part.shape.cls.states:
            values[first : first + part.count] = part.values(state.initial)
            first += part.count
    return values


def _threads(wanted: int | None, synapses: int) -> int:
    if wanted is not None:
        return wanted
    if synapses < _BREAK_EVEN:
        return 1
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
