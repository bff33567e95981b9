"""What lowering gives: flat arrays, the names of their places, and the module that steps them."""

from dataclasses import dataclass
from pathlib import Path
from types import ModuleType

import numpy as np

from neuromech.compiler.cache import import_file
from neuromech.compiler.layout import Layout
from neuromech.compiler.memory import apart
from neuromech.compiler.numerics import Floats, Integers
from neuromech.compiler.records import RecordGroup
from neuromech.compiler.shape import Shape
from neuromech.compiler.tree import Tree
from neuromech.graph.model import ModelGraph


@dataclass(frozen=True)
class Program:
    """A lowered model.

    Args:
        graph: the model it was lowered from.
        shape: kinds in use and method.
        source: text of the generated module.
        module_file: where that module is kept.
        layout: names to positions.
        header: name -> offset or count, as it stands at the front of `integers`.
        integers: the integer buffer I.
        parameters: the parameter buffer p at time zero.
        work_size: length of the work buffer F.
        tree: the body as a tree, None without a body.
        path_points: most points that one straight-line path has.
        initial: (states,) values at time zero as the components give them, SI units.
        substeps: network steps in one tick; a tick is a body step, or a network step where there is no body.
        threads: how many share the synapses.
        records: what is recorded.
    """

    graph: ModelGraph
    shape: Shape
    source: str
    module_file: Path
    layout: Layout
    header: dict[str, int]
    integers: Integers
    parameters: Floats
    work_size: int
    tree: Tree | None
    path_points: int
    initial: Floats
    substeps: int
    threads: int
    records: tuple[RecordGroup, ...]

    @property
    def module(self) -> ModuleType:
        """The generated module."""
        return import_file(self.module_file)

    @property
    def tick(self) -> float:
        """Seconds between two readings of the body, or one network step where there is no body."""
        solver = self.graph.document.experiment.solver
        return float(solver.body_step if self.tree else solver.step)

    def memory(self) -> "Memory":
        """Return fresh buffers for one run."""
        return Memory(self)


class Memory:
    """The buffers of one run: x states, s signals, u inputs, p parameters, F work, I offsets, T tree, D kinematics."""

    def __init__(self, program: Program) -> None:
        self.x = apart(program.initial)
        self.s = apart(np.zeros(program.layout.signal_count))
        self.u = apart(np.zeros(program.layout.input_count))
        self.p = apart(program.parameters)
        self.F = apart(np.zeros(program.work_size))
        self.I = apart(program.integers)
        if program.tree is not None:
            self.T, self.D = _kinematics(program.tree, program.path_points)
            first = program.header["last_torque"]
            self.F[first : first + len(program.tree.joints)] = np.nan

    @property
    def buffers(self) -> tuple[Floats, Floats, Floats, Floats, Floats, Integers]:
        """The six buffers that every function of the module takes, in order."""
        return self.x, self.s, self.u, self.p, self.F, self.I


def _kinematics(tree: Tree, path_points: int) -> tuple[tuple[Integers | Floats, ...], tuple[Floats, ...]]:
    segments, joints = len(tree.segments), len(tree.joints)
    fixed = (tree.topology, tree.geometry, tree.contact_segment, tree.contact_position)
    moving = (
        np.zeros((segments, 3, 3)),
        np.zeros((segments, 3)),
        np.zeros((segments, 3)),
        np.zeros((segments, 3)),
        np.zeros((len(tree.contacts), 3)),
        np.zeros((joints, 3)),
        np.zeros((path_points, 3)),
        tree.new_work(),
        np.zeros((joints + tree.root, joints + tree.root)),
        np.zeros((joints, joints)),
    )
    return fixed, tuple(map(apart, moving))
