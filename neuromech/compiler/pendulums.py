"""Pendulums as compiled loops lead them: waiting, swinging on the string, taken away after they hit.

The string keeps the weight within its length L of the pivot p. With the position x, the velocity v and gravity g alone
the engine would step to y = x + dt v + dt² g. Where |y − p| > L, the tension is the force along the string that brings
the weight to the distance L, as in SHAKE (doi:10.1016/0021-9991(77)90098-5) for a symplectic Euler step.
"""

from dataclasses import dataclass
from math import atan2, cos, sin, sqrt

import numpy as np

from neuromech.compiler.numerics import Floats, Integers, exact_part, exactly
from neuromech.graph.model import BodyModel
from neuromech.graph.swing import HEADINGS, aimed, first_pivot, first_place

_aimed = exact_part(aimed)

# Columns of `Pendulums.numbers`.
_MASS, _STRING, _RADIUS, _HEADING, _RELEASE, _TAKEN_AWAY, _IS_AIMED, _STAYS, _TARGET = range(9)
# Columns of `Pendulums.now`.
_PHASE, _SINCE, _PIVOT, _WATCHED, _SEEN, PLACE = 0, 1, 2, 5, 6, 8
_WAITING, _SWINGING, _HIT, _TAKEN = 0.0, 1.0, 2.0, 3.0

_WATCH = 1.0
"""For how long (s) before its release a weight watches how fast its target goes: some strides, in which it sways."""


@dataclass(frozen=True)
class Pendulums:
    """The pendulums of a world.

    Args:
        numbers: (pendulums, 11) mass, string, radius, heading, release, time until it is taken away, whether it aims
            and whether it stays (1 or 0), target in the segment's frame (3).
        segments: (pendulums,) row of the segment that each hits.
        now: (pendulums, 11) phase, time since its first touch in s, pivot in m, the time in s at which its target was
            seen, x and y of the target then in m, and place of release in m. Changes in a run.
        gravity: in m/s².
    """

    numbers: Floats
    segments: Integers
    now: Floats
    gravity: float

    @classmethod
    def of(cls, body: BodyModel) -> "Pendulums":
        """Return the pendulums around a body at time zero."""
        every = list(body.world.pendulums.values())
        rows = list(body.segments)
        numbers = [
            (
                *map(float, (one.mass, one.string, one.radius, HEADINGS[one.side], one.release, one.taken_away)),
                float(one.pivot is None),
                float(one.stays),
                *map(float, one.target or (0.0, 0.0, 0.0)),
            )
            for one in every
        ]
        now = [(_WAITING, 0.0, *first_pivot(body, one), 0.0, 0.0, 0.0, *first_place(body, one)) for one in every]
        return cls(
            np.array(numbers).reshape(-1, 11),
            np.array([rows.index(one.segment) for one in every], dtype=np.int64),
            np.array(now).reshape(-1, 11),
            float(body.world.gravity),
        )


NO_PENDULUMS = Pendulums(np.zeros((0, 11)), np.zeros(0, dtype=np.int64), np.zeros((0, 11)), 0.0)


@exactly
def lead(
    number: int,
    dt: float,
    gravity: float,
    pendulum: Floats,
    segment: int,
    now: Floats,
    weight: Floats,
    root_velocity: Floats,
    rotation: Floats,
    position: Floats,
    acting: Floats,
) -> bool:
    """Fill the force on a weight during body step `number`; return whether it is to be put to its place of release.

    Args:
        number: of the body step.
        dt: length of the step in s.
        gravity: in m/s².
        pendulum: row of `Pendulums.numbers`.
        segment: row of the segment that it hits.
        now: row of `Pendulums.now`, which changes.
        weight: (9,) position in m and velocity in m/s of the weight, force in N on the segment.
        root_velocity: (6,) of the root in m/s and rad/s, for a weight that is released at once.
        rotation: of all segments; (segments, 3, 3).
        position: of all segments in m; (segments, 3).
        acting: (9,) filled as in `Body.push`.
    """
    put = False
    if now[_PHASE] == _WAITING and (number == 0 or number * dt <= pendulum[_RELEASE] - _WATCH):
        now[_WATCHED] = number * dt
        now[_SEEN], now[_SEEN + 1], _ = _target(pendulum, segment, rotation, position)
    x, y, z, vx, vy, vz = weight[0], weight[1], weight[2], weight[3], weight[4], weight[5]
    if now[_PHASE] == _WAITING and number * dt >= pendulum[_RELEASE] - 0.5 * dt:
        if pendulum[_IS_AIMED] > 0.0:
            _aim(number * dt, gravity, pendulum, segment, now, root_velocity, rotation, position)
        now[_PHASE] = _SWINGING
        put = True
    elif now[_PHASE] == _SWINGING and (weight[6] != 0.0 or weight[7] != 0.0 or weight[8] != 0.0):
        now[_PHASE] = _HIT
    elif now[_PHASE] == _HIT:
        now[_SINCE] += dt
        if now[_SINCE] >= pendulum[_TAKEN_AWAY] and pendulum[_STAYS] == 0.0:
            now[_PHASE] = _TAKEN
            put = True
    if put:
        x, y, z, vx, vy, vz = now[PLACE], now[PLACE + 1], now[PLACE + 2], 0.0, 0.0, 0.0
    acting[0], acting[1], acting[2] = 0.0, 0.0, pendulum[_MASS] * gravity
    acting[3], acting[4], acting[5] = x, y, z
    acting[6], acting[7], acting[8] = x, y, z
    if now[_PHASE] == _SWINGING or now[_PHASE] == _HIT:
        _tension(dt, gravity, pendulum, now, acting, vx, vy, vz)
    return put


@exact_part
def _target(pendulum: Floats, segment: int, rotation: Floats, position: Floats) -> tuple[float, float, float]:
    axes, place = rotation[segment], position[segment]
    a, b, c = pendulum[_TARGET], pendulum[_TARGET + 1], pendulum[_TARGET + 2]
    x = place[0] + axes[0, 0] * a + axes[0, 1] * b + axes[0, 2] * c
    y = place[1] + axes[1, 0] * a + axes[1, 1] * b + axes[1, 2] * c
    z = place[2] + axes[2, 0] * a + axes[2, 1] * b + axes[2, 2] * c
    return x, y, z


@exact_part
def _aim(
    time: float,
    gravity: float,
    pendulum: Floats,
    segment: int,
    now: Floats,
    root_velocity: Floats,
    rotation: Floats,
    position: Floats,
) -> None:
    x, y, z = _target(pendulum, segment, rotation, position)
    heading = atan2(rotation[segment, 1, 0], rotation[segment, 0, 0]) + pendulum[_HEADING]
    vx, vy, string = root_velocity[0], root_velocity[1], pendulum[_STRING]
    watched = time - now[_WATCHED]
    if watched > 0.0:
        vx, vy = (x - now[_SEEN]) / watched, (y - now[_SEEN + 1]) / watched
    px, py, pz = _aimed(x, y, z, heading, vx, vy, string, pendulum[_RADIUS], gravity)
    now[_PIVOT], now[_PIVOT + 1], now[_PIVOT + 2] = px, py, pz
    now[PLACE], now[PLACE + 1], now[PLACE + 2] = px + string * cos(heading), py + string * sin(heading), pz


@exact_part
def _tension(
    dt: float, gravity: float, pendulum: Floats, now: Floats, acting: Floats, vx: float, vy: float, vz: float
) -> None:
    ax, ay, az = acting[3] - now[_PIVOT], acting[4] - now[_PIVOT + 1], acting[5] - now[_PIVOT + 2]
    bx, by, bz = ax + dt * vx, ay + dt * vy, az + dt * vz - dt * dt * gravity
    acting[2] = 0.0
    excess = bx * bx + by * by + bz * bz - pendulum[_STRING] ** 2
    if excess <= 0.0:
        return
    length = sqrt(ax * ax + ay * ay + az * az)
    ax, ay, az = ax / length, ay / length, az / length
    along = bx * ax + by * ay + bz * az
    # The weight moves by less than the length of the string in a step, or there is no solution and no run to save.
    shift = along - sqrt(max(0.0, along * along - excess))
    pull = pendulum[_MASS] * shift / (dt * dt)
    acting[0], acting[1], acting[2] = -pull * ax, -pull * ay, -pull * az
