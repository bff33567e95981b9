"""Reading and stepping a MuJoCo body from compiled code, without allocation.

`engine` is what `MujocoBody.native` returns:

    addresses: (3,) of the C function `mj_step`, the model and the data.
    root: (8,) how many ways the root moves, see `neuromech.compiler.tree`; then the pose that it starts with.
    places: (2, joints) where each joint stands in `positions` and in `velocities`.
    positions, velocities, applied: MuJoCo's qpos, qvel and qfrc_applied.
    forces: (3 contacts,) forces of the ground.
    warnings: how often MuJoCo warned, by kind.
    pushed: (bodies, 6) MuJoCo's xfrc_applied, force and torque about the centre of mass.
    rows: (segments + weights,) row of each segment in `pushed`, then of each weight on a string.
    weights: (2, weights) where the first coordinate of each weight stands in `positions` and in `velocities`.
    hits: (3 weights,) forces of the weights on the body.
"""

from math import cos, sin
from typing import Any

from neuromech.compiler.foreign import ADDRESS, NOTHING, foreign_function
from neuromech.compiler.numerics import Floats, exact_part, exactly
from neuromech.compiler.tree import FREE_ROOT, PLANAR_ROOT

_call = foreign_function(NOTHING, ADDRESS, ADDRESS)


@exactly
def read(engine: tuple[Any, ...], state: Floats) -> int:
    """Fill the state array; (2 n + 13 + 3 m,), see `BodyState`. Returns 0."""
    _, root, places, positions, velocities, _, forces, _, _, _, weights, hits = engine
    n = places.shape[1]
    for joint in range(n):
        state[joint] = positions[places[0, joint]]
        state[n + joint] = velocities[places[1, joint]]
    pose, velocity = state[2 * n : 2 * n + 7], state[2 * n + 7 : 2 * n + 13]
    if root[0] == FREE_ROOT:
        _read_free_root(positions, velocities, pose, velocity)
    else:
        for k in range(13):
            state[2 * n + k] = root[1 + k] if k < 7 else 0.0
        if root[0] == PLANAR_ROOT:
            _read_planar_root(positions, velocities, pose, velocity)
    hanging = 2 * n + 13 + forces.shape[0]
    for k in range(forces.shape[0]):
        state[2 * n + 13 + k] = forces[k]
    for k in range(weights.shape[1]):
        for c in range(3):
            state[hanging + 9 * k + c] = positions[weights[0, k] + c]
            state[hanging + 9 * k + 3 + c] = velocities[weights[1, k] + c]
            state[hanging + 9 * k + 6 + c] = hits[3 * k + c]
    return 0


@exactly
def step(engine: tuple[Any, ...], torque: Floats) -> int:
    """Apply joint torques (joints,) and advance by one step. Returns the number of warnings, 0 where all is well."""
    addresses, _, places, _, _, applied, _, warnings, pushed, _, _, _ = engine
    for joint in range(places.shape[1]):
        applied[places[1, joint]] = torque[joint]
    _call(addresses[0], (addresses[1], addresses[2]))
    pushed[:] = 0.0
    total = 0
    for kind in range(warnings.shape[0]):
        total += warnings[kind]
    return total


@exactly
def push(engine: tuple[Any, ...], segment: int, acting: Floats) -> int:
    """Let a force act on a segment during the next step; `acting` (9,) as in `Body.push`. Returns 0."""
    row = engine[8][engine[9][segment]]
    x, y, z = acting[3] - acting[6], acting[4] - acting[7], acting[5] - acting[8]
    a, b, c = acting[0], acting[1], acting[2]
    row[0] += a
    row[1] += b
    row[2] += c
    row[3] += y * c - z * b
    row[4] += z * a - x * c
    row[5] += x * b - y * a
    return 0


@exactly
def place(engine: tuple[Any, ...], weight: int, position: Floats) -> int:
    """Put a weight to a place (3,), at rest. Returns 0."""
    positions, velocities, weights = engine[3], engine[4], engine[10]
    for c in range(3):
        positions[weights[0, weight] + c] = position[c]
        velocities[weights[1, weight] + c] = 0.0
    return 0


@exact_part
def _read_planar_root(positions: Floats, velocities: Floats, pose: Floats, velocity: Floats) -> None:
    pose[0], pose[2] = positions[0], positions[1]
    pose[4], pose[6] = sin(positions[2] / 2.0), cos(positions[2] / 2.0)
    velocity[0], velocity[2], velocity[4] = velocities[0], velocities[1], velocities[2]


@exact_part
def _read_free_root(positions: Floats, velocities: Floats, pose: Floats, velocity: Floats) -> None:
    for c in range(3):
        pose[c] = positions[c]
        pose[3 + c] = positions[4 + c]
        velocity[c] = velocities[c]
    pose[6] = positions[3]
    # MuJoCo gives the angular velocity in the segment's axes.
    x, y, z, w = pose[3], pose[4], pose[5], pose[6]
    a, b, c = velocities[3], velocities[4], velocities[5]
    d, e, f = 2.0 * (y * c - z * b), 2.0 * (z * a - x * c), 2.0 * (x * b - y * a)
    velocity[3] = a + w * d + y * f - z * e
    velocity[4] = b + w * e + z * d - x * f
    velocity[5] = c + w * f + x * e - y * d
