"""SciPy's solvers through the same compiled derivative as the fixed-step methods."""

from collections.abc import Callable

import numpy as np
from scipy.integrate import solve_ivp

from neuromech.compiler.numerics import Floats
from neuromech.compiler.program import Memory, Program
from neuromech.errors import RunError

_SCIPY_NAMES = {"lsoda": "LSODA", "radau": "Radau", "dop853": "DOP853"}


def is_adaptive(program: Program) -> bool:
    """Return whether the document asks for one of SciPy's solvers."""
    return program.graph.document.experiment.solver.method in _SCIPY_NAMES


def integrate(program: Program, memory: Memory, times: Floats) -> Floats:
    """Integrate the network from `memory.x` at times[0]; return the states at all times, shape (len(times), states).

    Raises:
        RunError: the solver gave up; its message is passed on.
    """
    solver = program.graph.document.experiment.solver
    found = solve_ivp(
        _derivative(program, memory),
        (times[0], times[-1]),
        memory.x.copy(),
        method=_SCIPY_NAMES[solver.method],
        t_eval=times,
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


def _derivative(program: Program, memory: Memory) -> Callable[[float, Floats], Floats]:
    compiled = program.module.derivative
    _, s, u, p, work, offsets = memory.buffers

    def derivative(t: float, x: Floats) -> Floats:
        slope = np.empty_like(x)
        compiled(t, x, slope, s, u, p, work, offsets)
        return slope

    return derivative
