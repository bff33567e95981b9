"""Muscle and joint torques, and the linearly implicit coupling with the body. Derived in docs/numerics.md."""

from neuromech.compiler.numerics import Floats, Integers, equation
from neuromech.compiler.solving import solve_symmetric, solve_under_free_root
from neuromech.compiler.tree import FREE_ROOT


@equation
def muscle_torque(force: Floats, arms: Floats, first: Integers, joint: Integers, torque: Floats) -> None:
    """Add to `torque` (n,) what the muscles exert: τ_j = Σ_m r_mj F_m, with moment arm r = −dl/dq (m).

    `first` (m + 1,) says where the joints and arms of each muscle start in `joint` and `arms`.
    """
    for m in range(force.shape[0]):
        for k in range(first[m], first[m + 1]):
            torque[joint[k]] += arms[k] * force[m]


@equation
def muscle_damping(slope: Floats, arms: Floats, first: Integers, joint: Integers, matrix: Floats) -> None:
    """Add to the lower triangle of `matrix` (n, n) the joint damping of the muscles, Rᵀ diag(slope) R.

    `slope` (m,) in N s/m, `arms` in m; `first` and `joint` as for `muscle_torque`, joints of a muscle ascending.
    """
    for m in range(slope.shape[0]):
        for k in range(first[m], first[m + 1]):
            for h in range(first[m], k + 1):
                matrix[joint[k], joint[h]] += arms[k] * slope[m] * arms[h]


@equation
def soft_limit(angle: float, velocity: float, lower: float, upper: float, reference: float) -> tuple[float, float]:
    """Return torque and damping of a soft limit over its stiffness: rad, and s; Dzeladini 2013 eq. 2.38.

    Beyond the range the torque is the excess times 1 + ω/ω_ref, with ω positive when the joint moves on, and none when
    it comes back faster than ω_ref. That is a damper, excess/ω_ref, of up to hundreds of N m s/rad: it is
    `observer_implicit` that keeps it stable.
    """
    if angle > upper and velocity > -reference:
        return (upper - angle) * (1.0 + velocity / reference), (angle - upper) / reference
    if angle < lower and velocity < reference:
        return (lower - angle) * (1.0 - velocity / reference), (lower - angle) / reference
    return 0.0, 0.0


@equation
def observer_implicit(
    dt: float,
    mass: Floats,
    damping: Floats,
    first: Integers,
    torque: Floats,
    velocity: Floats,
    last_velocity: Floats,
    last_torque: Floats,
    acceleration: Floats,
) -> None:
    """Replace `torque` (n,) by τ − dt B a, with (M + dt B) a = τ − τ_last + M (v − v_last)/dt.

    M (n + r, n + r) is `mass`, whose last r rows are those of a root that moves and feels no torque; B (n, n) is
    `damping`. Their lower triangles are read, from column `first` (n + r,) on; M and `last_velocity` are overwritten.
    M a_last − τ_last is what acted on the joints from outside during the last step (contact, gravity, coupling), so
    that a static load causes no bias. What is solved for is a − (v − v_last)/dt, which needs no product with M.
    """
    n = torque.shape[0]
    for i in range(n):
        last_velocity[i] = (velocity[i] - last_velocity[i]) / dt
        acceleration[i] = torque[i] - last_torque[i] - dt * damping[i, i] * last_velocity[i]
        mass[i, i] += dt * damping[i, i]
        for j in range(first[i], i):
            drag = dt * damping[i, j]
            acceleration[i] -= drag * last_velocity[j]
            acceleration[j] -= drag * last_velocity[i]
            mass[i, j] += drag
    for i in range(n, acceleration.shape[0]):
        acceleration[i] = 0.0
    if acceleration.shape[0] - n == FREE_ROOT:
        solve_under_free_root(mass, first, acceleration)
    else:
        solve_symmetric(mass, first, acceleration)
    for i in range(n):
        acceleration[i] += last_velocity[i]
    for i in range(n):
        torque[i] -= dt * damping[i, i] * acceleration[i]
        for j in range(first[i], i):
            torque[i] -= dt * damping[i, j] * acceleration[j]
            torque[j] -= dt * damping[i, j] * acceleration[i]
