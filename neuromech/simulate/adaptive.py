"""SciPy's solvers through the same compiled derivative as the fixed-step methods; imported when one is asked for."""

from collections.abc import Callable
from math import ceil

import numpy as np

from neuromech.compiler.numerics import Floats
from neuromech.compiler.program import Memory, Program
from neuromech.errors import RunError

_SCIPY_NAMES = {"lsoda": "LSODA", "radau": "Radau", "dop853": "DOP853"}


def is_adaptive(program: Program) -> bool:
    """Return whether the document asks for one of SciPy's solvers."""
    return program.graph.document.experiment.solver.method in _SCIPY_NAMES


def integrate(program: Program, memory: Memory, start: float, end: float, times: Floats | None = None) -> Floats:
    """Integrate the network from `memory.x` over an interval in which every parameter moves smoothly.

    Args:
        program: from `lower`.
        memory: its buffers; `x` holds the states at the start.
        start: s.
        end: s. What a parameter becomes at the end belongs to the next interval.
        times: of the interval (s), increasing, the end not among them; none where not given.

    Returns:
        The states at these times and, last, at the end; shape (times + 1, states).

    Raises:
        RunError: the solver gave up; its message is passed on.
    """
    from scipy.integrate import solve_ivp

    solver = program.graph.document.experiment.solver
    inner = np.empty(0) if times is None else np.clip(times, start, end)
    # Steps that are tried and refused may overflow.
    with np.errstate(over="ignore", invalid="ignore"):
        found = solve_ivp(
            _derivative(program, memory, float(np.nextafter(end, start))),
            (start, end),
            memory.x.copy(),
            method=_SCIPY_NAMES[solver.method],
            t_eval=np.append(inner, end),
            rtol=float(solver.relative_tolerance),
            atol=float(solver.absolute_tolerance),
        )
    if not found.success:
        raise RunError(f"{_SCIPY_NAMES[solver.method]} gave up at {found.t[-1]:g} s: {found.message}")
    return np.ascontiguousarray(found.y.T)


def breakpoints(program: Program, end: float) -> list[float]:
    """Return the times from 0 to `end` between which every parameter moves smoothly."""
    protocol = program.graph.document.experiment.protocol
    inner = {float(event.at) for event in protocol.events.values()}
    inner |= {float(time) for ramp in protocol.ramps.values() for time in (ramp.start, ramp.end)}
    return [0.0, *sorted(time for time in inner if 0.0 < time < end), end]


def ticks_from(time: float, tick: float) -> int:
    """Return the number of the first tick at a time or after it, both in s; rounding errors of clocks are forgiven."""
    return ceil(time / tick * (1.0 - 1e-12))


def _derivative(program: Program, memory: Memory, latest: float) -> Callable[[float, Floats], Floats]:
    compiled = program.module.derivative
    _, s, u, p, work, offsets = memory.buffers

    def derivative(t: float, x: Floats) -> Floats:
        slope = np.zeros_like(x)
        compiled(min(t, latest), x, slope, s, u, p, work, offsets)
        return slope

    return derivative
