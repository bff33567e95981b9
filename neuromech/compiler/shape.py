"""The shape of a step: everything that decides its code, and nothing that only decides its numbers."""

import inspect
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal

from neuromech.components.base import Component

FixedStep = Literal["rk4", "exponential_euler", "rush_larsen"]

# Offsets and counts at the front of the integer buffer, by name; the generated code reads them from there.
COMMON = (
    "states", "inputs", "base", "stages", "row_start", "row_source", "weights",
    "segment_start", "segment_first", "segment_last", "segment_weight", "segment_source",
    "delayed", "delayed_row", "delayed_source", "delayed_weight", "delay_steps",
    "history", "history_length", "history_width", "history_slot",
    "network_order", "network_ordered", "network_members",
    "mechanics_order", "mechanics_ordered", "mechanics_members",
    "driven", "driven_start", "breakpoint_time", "breakpoint_value", "bound_start", "bound_slot",
    "groups", "group_every", "group_start", "group_row", "group_stretch", "stretch_start", "stretch_array", "place",
    "mean_first", "mean_count", "team", "substeps",
    "joints", "segments", "contacts", "muscles", "tracked", "body", "torque", "point", "segment_signal",
    "track", "path_first", "path_joint", "path_kind", "path_length", "path_reference", "path_arm",
    "path_point", "path_point_first", "path_segment", "moved", "length_signal", "velocity_signal",
    "force_slot", "stiffness_slot", "damping_slot", "damping", "joint_stiffness", "rest_angle", "arms", "work",
    "last_velocity", "last_torque", "explicit", "child", "slide", "root", "coupled", "inputs_recorded",
    "soft_lower", "soft_upper", "soft_stiffness", "soft_velocity",
    "path_factor", "path_form", "path_peak", "path_zero", "advanced", "muscle_step",
    "slot_tables", "slot_order", "slot_source", "slot_weights", "slot_sums",
)  # fmt: skip


@dataclass(frozen=True)
class KindShape:
    """One component class in use.

    Args:
        cls: the class.
        uniform: parameters that are one number for all its instances.
        turn: when one loop evaluates all of a muscle or sensor class, after the classes that it needs; None where its
            instances need each other, and for all else.
    """

    cls: type[Component]
    uniform: frozenset[str]
    turn: int | None

    @property
    def name(self) -> str:
        """The word that generated code uses for the class."""
        return self.cls.kind_name()

    def header(self) -> tuple[str, ...]:
        """Return the names of this kind's offsets in the integer buffer."""
        fixed = ("count", "states", "inputs", "outputs", "table")
        return tuple(f"{self.name}.{part}" for part in (*fixed, *parameter_names(self.cls)))


@dataclass(frozen=True)
class Shape:
    """What the generated module depends on: kinds in use, method, and which parts there are."""

    kinds: tuple[KindShape, ...]
    method: FixedStep
    has_body: bool
    has_delays: bool
    has_shared_weights: bool
    has_short_rows: bool
    has_threads: bool

    def header(self) -> dict[str, int]:
        """Return name -> position in the integer buffer for every offset and count."""
        names = [*COMMON, *(name for kind in self.kinds for name in kind.header())]
        return {name: position for position, name in enumerate(names)}


def argument_names(function: Callable[..., Any]) -> tuple[str, ...]:
    """Return the argument names of an equation."""
    return tuple(inspect.signature(function).parameters)


def parameter_names(cls: type[Component]) -> tuple[str, ...]:
    """Return the parameters that the equations of a class use, in field order."""
    functions = (cls.output, cls.flow, cls.advance)
    used = {name for function in functions if function for name in argument_names(function)}
    return tuple(name for name in cls.model_fields if name in used)


def has_feedthrough(cls: type[Component]) -> bool:
    """Return whether an output of the class depends directly on an input."""
    ports = {port.name for port in cls.inputs}
    return cls.output is not None and not ports.isdisjoint(argument_names(cls.output))


def evaluated_with_body(cls: type[Component]) -> bool:
    """Return whether outputs are evaluated once per body step: muscles and sensors are."""
    return cls.family in ("muscle", "sensor")


def is_commanded(cls: type[Component]) -> bool:
    """Return whether an output of a muscle or sensor class depends at once on what a neuron tells it."""
    if not evaluated_with_body(cls) or cls.output is None:
        return False
    told = {port for reference in cls.references().values() if reference.to == "neuron" for _, port in reference.wires}
    return not told.isdisjoint(argument_names(cls.output))


def is_divided(cls: type[Component]) -> bool:
    """Return whether the states of a class advance by parts of a body step, all instances by one part after another."""
    return cls.advance is not None and "duration" in argument_names(cls.advance)


def is_scheduled(kind: KindShape) -> bool:
    """Return whether instances are evaluated one by one, in an order; all of another kind are evaluated in one loop."""
    return kind.turn is None if evaluated_with_body(kind.cls) else has_feedthrough(kind.cls)
