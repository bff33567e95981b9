"""Every rule that a graph must obey, and the function that runs them all."""

from collections.abc import Callable, Iterable

from neuromech.errors import DocumentError, Problem
from neuromech.graph.checks.body import (
    angle_outside_range,
    contact_without_ground,
    engine_refusal,
    hinge_engine,
    hinge_engine_knows_no_contact,
    inertia_of_no_body,
    range_upside_down,
    zero_axis,
)
from neuromech.graph.checks.definitions import synapse_defined_twice
from neuromech.graph.checks.loops import algebraic_loop
from neuromech.graph.checks.network import idle_motoneuron, sensor_without_target, unreachable_motoneuron
from neuromech.graph.checks.paths import (
    arms_and_angles_differ,
    joints_off_one_chain,
    path_crosses_no_joint,
    path_turns_back,
)
from neuromech.graph.checks.pendulums import (
    hinge_engine_knows_no_pendulum,
    pendulum_after_the_end,
    pendulum_in_the_body,
    pendulum_without_place,
)
from neuromech.graph.checks.populations import (
    too_few_senders,
    too_many_synapses,
    two_ways_of_wiring,
    varied_parameter,
)
from neuromech.graph.checks.ports import port_missing, unit_clash
from neuromech.graph.checks.pushes import (
    hinge_engine_knows_no_push,
    one_distribution,
    push_after_the_end,
    series_that_never_advances,
)
from neuromech.graph.checks.signals import (
    initial_matches_nothing,
    initial_outside_bounds,
    measure_of_unrecorded,
    record_matches_nothing,
)
from neuromech.graph.checks.start import angle_starts_outside_range, start_below_ground, two_heights
from neuromech.graph.checks.timing import delay_below_step
from neuromech.graph.checks.world import (
    ends_upside_down,
    hinge_engine_knows_no_ground,
    slope_misplaced,
    step_misplaced,
    two_grounds,
    wave_without_length,
)
from neuromech.graph.model import ModelGraph

Rule = Callable[[ModelGraph], Iterable[Problem]]

VALUE_RULES: tuple[Rule, ...] = (
    range_upside_down,
    angle_outside_range,
    zero_axis,
    inertia_of_no_body,
    contact_without_ground,
    ends_upside_down,
    slope_misplaced,
    step_misplaced,
    two_grounds,
    wave_without_length,
    one_distribution,
    push_after_the_end,
    pendulum_without_place,
    pendulum_after_the_end,
    series_that_never_advances,
    delay_below_step,
    varied_parameter,
    two_ways_of_wiring,
    too_few_senders,
    too_many_synapses,
)
"""Rules that look at one element at a time, and so hold in a graph with missing edges too."""

START_RULES: tuple[Rule, ...] = (angle_starts_outside_range, two_heights, start_below_ground)
"""Rules about how a body starts."""

RULES: tuple[Rule, ...] = (
    *VALUE_RULES,
    hinge_engine,
    hinge_engine_knows_no_contact,
    hinge_engine_knows_no_ground,
    hinge_engine_knows_no_push,
    hinge_engine_knows_no_pendulum,
    engine_refusal,
    synapse_defined_twice,
    port_missing,
    unit_clash,
    arms_and_angles_differ,
    joints_off_one_chain,
    path_crosses_no_joint,
    path_turns_back,
    unreachable_motoneuron,
    idle_motoneuron,
    sensor_without_target,
    algebraic_loop,
    record_matches_nothing,
    measure_of_unrecorded,
    initial_matches_nothing,
    initial_outside_bounds,
    *START_RULES,
    pendulum_in_the_body,
)


def check(graph: ModelGraph) -> None:
    """Check a graph against every rule.

    Raises:
        DocumentError: with every problem found.
    """
    _refuse(graph, RULES)


def check_start(graph: ModelGraph) -> None:
    """Check how the body of a graph starts; all else is known to be right.

    Raises:
        DocumentError: with every problem found.
    """
    _refuse(graph, START_RULES)


def broken(graph: ModelGraph, rules: Iterable[Rule]) -> list[Problem]:
    """Return what is wrong by some rules."""
    return [problem for rule in rules for problem in rule(graph)]


def _refuse(graph: ModelGraph, rules: Iterable[Rule]) -> None:
    problems = broken(graph, rules)
    if problems:
        raise DocumentError(problems)
