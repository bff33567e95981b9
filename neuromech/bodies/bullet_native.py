"""A Bullet world read and stepped by compiled code, through the addresses of Bullet's C functions.

The arithmetic is compiled as it is written, without the liberties that equations have, so that it gives the bits that
the portable path gives. A failure is remembered in `world[FAILED]`.
"""

from math import cos, sin
from typing import Final, NamedTuple

import numpy as np

from neuromech.bodies.base import Floats
from neuromech.bodies.bullet_c import CClient
from neuromech.bodies.pybullet_world import BulletWorld
from neuromech.compiler.foreign import (
    ADDRESS,
    DOUBLE,
    INT,
    NOTHING,
    foreign_function,
    load_address,
    load_double,
    load_int,
)
from neuromech.compiler.memory import apart
from neuromech.compiler.numerics import Integers, exact_part, exactly
from neuromech.errors import RunError

CLIENT, ROBOT, GROUND, ROOT, FAILED = range(5)
FIXED, FREE, PLANAR = range(3)

_CALLS: Final = (
    "b3RequestActualStateCommandInit",
    "b3GetStatusActualState2",
    "b3InitRequestContactPointInformation",
    "b3SetContactFilterBodyA",
    "b3SetContactFilterBodyB",
    "b3GetContactPointInformation",
    "b3JointControlCommandInit2",
    "b3JointControlSetDesiredForceTorque",
    "b3InitStepSimulationCommand",
    "b3CreatePoseCommandInit",
    "b3CreatePoseCommandSetBasePosition",
    "b3CreatePoseCommandSetBaseOrientation",
    "b3CreatePoseCommandSetBaseLinearVelocity",
    "b3CreatePoseCommandSetBaseAngularVelocity",
    "b3ApplyExternalForceCommandInit",
    "b3ApplyExternalForce",
    "b3SubmitClientCommand",
    "b3ProcessServerStatus",
    "b3GetStatusType",
)
(
    _REQUEST_STATE,
    _STATE,
    _REQUEST_CONTACTS,
    _FILTER_A,
    _FILTER_B,
    _CONTACTS,
    _CONTROL,
    _SET_TORQUE,
    _STEP,
    _POSE,
    _SET_PLACE,
    _SET_TURN,
    _SET_VELOCITY,
    _SET_SPIN,
    _PUSH,
    _SET_PUSH,
    _SUBMIT,
    _ANSWER,
    _STATUS,
) = range(len(_CALLS))
_TORQUE_CONTROL: Final = 1
_WORLD_FRAME: Final = 2
_HAS_STATE: Final = 21
_STEPPED: Final = 26

# Where the zeros in `BulletEngine.answer` begin: as floats the coordinates of nowhere.
_NOWHERE: Final = 3

# The pose of a link, in bytes.
_POSE_SIZE: Final = 56
_HEIGHT: Final = 16

# b3ContactPointData, in bytes.
_POINT_SIZE: Final = 176
_THING: Final = 4
_LINK: Final = 12
_OTHER_LINK: Final = 16
_NORMAL: Final = 72
_NORMAL_FORCE: Final = 104
_FRICTION: Final = (112, 120)
_FRICTION_DIRECTION: Final = (128, 152)

_of_client = foreign_function(ADDRESS, ADDRESS)
_of_robot = foreign_function(ADDRESS, ADDRESS, INT)
_control = foreign_function(ADDRESS, ADDRESS, INT, INT)
_set_torque = foreign_function(INT, ADDRESS, INT, DOUBLE)
_set_push = foreign_function(NOTHING, ADDRESS, INT, INT, ADDRESS, ADDRESS, INT)
_set_place = foreign_function(INT, ADDRESS, DOUBLE, DOUBLE, DOUBLE)
_set_turn = foreign_function(INT, ADDRESS, DOUBLE, DOUBLE, DOUBLE, DOUBLE)
_set_velocity = foreign_function(INT, ADDRESS, ADDRESS)
_filter = foreign_function(NOTHING, ADDRESS, INT)
_submit = foreign_function(INT, ADDRESS, ADDRESS)
_status = foreign_function(INT, ADDRESS)
_state = foreign_function(INT, *[ADDRESS] * 13)
_contacts = foreign_function(NOTHING, ADDRESS, ADDRESS)


class BulletEngine(NamedTuple):
    """A world as compiled code sees it.

    Args:
        calls: addresses of Bullet's functions, in the order of `_CALLS`.
        world: the client's handle, the numbers of robot and plane (−1 where the ground is something else), the kind
            of root, and whether Bullet failed.
        positions: place of each joint among the robot's positions; those of a planar root follow.
        velocities: place of each joint among the robot's velocities; those of a planar root follow.
        rows: Bullet's link number -> row of the contact, −1 for other links.
        constants: first pose of the root frame (7), centre of mass of the root segment in its frame (3), height
            above which each contact is clear of the ground.
        answer: room for what Bullet answers, then three zeros.
        links: (segments + weights, 2) robot and Bullet's link number of each segment, −1 of a root link; then the
            weights on strings.
        weights: (weights,) Bullet's numbers of the weights.
    """

    calls: Integers
    world: Integers
    positions: Integers
    velocities: Integers
    rows: Integers
    constants: Floats
    answer: Integers
    links: Integers
    weights: Integers


class NativeMotion:
    """Reads and steps a world through the compiled functions.

    Attributes:
        client: the client.
        world: what it built.
    """

    def __init__(self, client: CClient, world: BulletWorld) -> None:
        """Take the numbers of joints from the world."""
        self.client = client
        self.world = world
        self._engine = _engine(client, world)

    def read(self, state: Floats) -> None:
        """Fill the state array."""
        if read(self._engine, state):
            self.check()

    def step(self, torque: Floats) -> None:
        """Apply joint torques and advance by one step."""
        if step(self._engine, torque):
            self.check()

    def push(self, segment: int, acting: Floats) -> None:
        """Let a force act on a segment during the next step."""
        push(self._engine, segment, acting)

    def place(self, weight: int, position: Floats) -> None:
        """Put the weight of a pendulum to a place, at rest."""
        place(self._engine, weight, position)

    def native(self) -> BulletEngine:
        """Return what the compiled functions take."""
        return self._engine

    def check(self) -> None:
        """Raise a RunError if a compiled function failed."""
        if self._engine.world[FAILED]:
            raise RunError("PyBullet failed: it does not answer for the body any more")


def _engine(client: CClient, world: BulletWorld) -> BulletEngine:
    joints = world.joints + world.root
    rows = np.full(max(world.contact_row, default=-1) + 1, -1, dtype=np.int64)
    for link, row in world.contact_row.items():
        rows[link] = row
    ground = -1 if world.plane is None else world.plane
    kind = PLANAR if world.root else FREE if world.free else FIXED
    return BulletEngine(
        calls=np.array([client.address(name) for name in _CALLS], dtype=np.int64),
        world=apart(np.array([client.handle, world.robot, ground, kind, 0], dtype=np.int64)),
        positions=np.array([joint.position for joint in joints], dtype=np.int64),
        velocities=np.array([joint.velocity for joint in joints], dtype=np.int64),
        rows=rows,
        constants=np.array([*world.root_pose, *world.center, *world.clear_heights]),
        answer=apart(np.zeros(_NOWHERE + 3, dtype=np.int64)),
        links=np.array(world.links, dtype=np.int64),
        weights=np.array(world.weights, dtype=np.int64),
    )


@exactly
def read(engine: BulletEngine, state: Floats) -> int:
    """Fill the state array, see `BodyState`, and return 0; 1 when Bullet failed."""
    calls, world, answer = engine.calls, engine.world, engine.answer
    status = _answered(engine, _of_robot(calls[_REQUEST_STATE], (world[CLIENT], world[ROBOT])))
    if _status(calls[_STATUS], (status,)) != _HAS_STATE:
        world[FAILED] = 1
        return 1
    into = answer.ctypes.data
    _state(calls[_STATE], (status, 0, 0, 0, 0, 0, into, into + 8, 0, 0, 0, into + 16, 0))
    q, v = answer[0], answer[1]
    n = engine.positions.shape[0] - (3 if world[ROOT] == PLANAR else 0)
    for joint in range(n):
        state[joint] = load_double(q + 8 * engine.positions[joint])
        state[n + joint] = load_double(v + 8 * engine.velocities[joint])
    if world[ROOT] == PLANAR:
        _read_planar_root(engine, n, q, v, state)
    elif world[ROOT] == FREE:
        _read_free_root(engine.constants, q, v, state, 2 * n)
    else:
        for k in range(13):
            state[2 * n + k] = engine.constants[k] if k < 7 else 0.0
    hanging = state.shape[0] - 9 * engine.weights.shape[0]
    _read_contacts(engine, answer[2], state[:hanging], 2 * n + 13)
    for k in range(engine.weights.shape[0]):
        _read_weight(engine, k, state[hanging + 9 * k : hanging + 9 * k + 9])
    return 0


@exact_part
def advance(engine: BulletEngine) -> int:
    """Advance by one step and return 0; 1 when Bullet failed. What Bullet itself costs."""
    status = _answered(engine, _of_client(engine.calls[_STEP], (engine.world[CLIENT],)))
    if _status(engine.calls[_STATUS], (status,)) != _STEPPED:
        engine.world[FAILED] = 1
    return int(engine.world[FAILED])


@exactly
def step(engine: BulletEngine, torque: Floats) -> int:
    """Apply joint torques, advance by one step and return 0; 1 when Bullet failed."""
    calls, world = engine.calls, engine.world
    if torque.shape[0]:
        command = _control(calls[_CONTROL], (world[CLIENT], world[ROBOT], _TORQUE_CONTROL))
        for joint in range(torque.shape[0]):
            _set_torque(calls[_SET_TORQUE], (command, engine.velocities[joint], torque[joint]))
        _submit(calls[_SUBMIT], (world[CLIENT], command))
    return int(advance(engine))


@exactly
def push(engine: BulletEngine, segment: int, acting: Floats) -> int:
    """Let a force act on a segment during the next step; `acting` (9,) as in `Body.push`. Returns 0."""
    calls, world, force = engine.calls, engine.world, acting.ctypes.data
    command = _of_client(calls[_PUSH], (world[CLIENT],))
    thing, link = engine.links[segment, 0], engine.links[segment, 1]
    _set_push(calls[_SET_PUSH], (command, thing, link, force, force + 24, _WORLD_FRAME))
    _answered(engine, command)
    return 0


@exactly
def place(engine: BulletEngine, weight: int, position: Floats) -> int:
    """Put the weight of a pendulum to a place (3,), at rest. Returns 0."""
    calls, nowhere = engine.calls, engine.answer.ctypes.data + 8 * _NOWHERE
    command = _of_robot(calls[_POSE], (engine.world[CLIENT], engine.weights[weight]))
    _set_place(calls[_SET_PLACE], (command, position[0], position[1], position[2]))
    _set_turn(calls[_SET_TURN], (command, 0.0, 0.0, 0.0, 1.0))
    _set_velocity(calls[_SET_VELOCITY], (command, nowhere))
    _set_velocity(calls[_SET_SPIN], (command, nowhere))
    _answered(engine, command)
    return 0


@exact_part
def _answered(engine: BulletEngine, command: int) -> int:
    calls, client = engine.calls, engine.world[CLIENT]
    _submit(calls[_SUBMIT], (client, command))
    return int(_of_client(calls[_ANSWER], (client,)))


@exact_part
def _read_planar_root(engine: BulletEngine, n: int, q: int, v: int, state: Floats) -> None:
    root = 2 * n
    for k in range(13):
        state[root + k] = 0.0
    pitch = load_double(q + 8 * engine.positions[n + 2])
    state[root] = load_double(q + 8 * engine.positions[n])
    state[root + 1] = engine.constants[1]
    state[root + 2] = load_double(q + 8 * engine.positions[n + 1])
    state[root + 4] = sin(pitch / 2)
    state[root + 6] = cos(pitch / 2)
    state[root + 7] = load_double(v + 8 * engine.velocities[n])
    state[root + 9] = load_double(v + 8 * engine.velocities[n + 1])
    state[root + 11] = load_double(v + 8 * engine.velocities[n + 2])


@exact_part
def _read_free_root(constants: Floats, q: int, v: int, state: Floats, root: int) -> None:
    for k in range(7):
        state[root + k] = load_double(q + 8 * k)
    for k in range(6):
        state[root + 7 + k] = load_double(v + 8 * k)
    x, y, z, w = state[root + 3], state[root + 4], state[root + 5], state[root + 6]
    x, y, z = _rotated(x, y, z, w, constants[7], constants[8], constants[9])
    state[root] -= x
    state[root + 1] -= y
    state[root + 2] -= z
    wx, wy, wz = state[root + 10], state[root + 11], state[root + 12]
    state[root + 7] -= wy * z - wz * y
    state[root + 8] -= wz * x - wx * z
    state[root + 9] -= wx * y - wy * x


@exact_part
def _rotated(x: float, y: float, z: float, w: float, a: float, b: float, c: float) -> tuple[float, float, float]:
    first, second, third = 2.0 * (y * c - z * b), 2.0 * (z * a - x * c), 2.0 * (x * b - y * a)
    return (
        a + w * first + y * third - z * second,
        b + w * second + z * first - x * third,
        c + w * third + x * second - y * first,
    )


@exact_part
def _read_contacts(engine: BulletEngine, links: int, state: Floats, start: int) -> None:
    calls, world, answer = engine.calls, engine.world, engine.answer
    for place in range(start, state.shape[0]):
        state[place] = 0.0
    if _clear(engine, links):
        return
    command = _of_client(calls[_REQUEST_CONTACTS], (world[CLIENT],))
    if world[GROUND] >= 0:
        _filter(calls[_FILTER_A], (command, world[ROBOT]))
        _filter(calls[_FILTER_B], (command, world[GROUND]))
    _answered(engine, command)
    _contacts(calls[_CONTACTS], (world[CLIENT], answer.ctypes.data))
    for number in range(load_int(answer.ctypes.data)):
        point = load_address(answer.ctypes.data + 8) + _POINT_SIZE * number
        _add_contact(engine, point, state, start)


@exact_part
def _read_weight(engine: BulletEngine, weight: int, into: Floats) -> None:
    calls, world, answer, number = engine.calls, engine.world, engine.answer, engine.weights[weight]
    room = answer.ctypes.data
    status = _answered(engine, _of_robot(calls[_REQUEST_STATE], (world[CLIENT], number)))
    _state(calls[_STATE], (status, 0, 0, 0, 0, 0, room, room + 8, 0, 0, 0, room + 16, 0))
    for c in range(3):
        into[c] = load_double(answer[0] + 8 * c)
        into[3 + c] = load_double(answer[1] + 8 * c)
        into[6 + c] = 0.0
    command = _of_client(calls[_REQUEST_CONTACTS], (world[CLIENT],))
    _filter(calls[_FILTER_A], (command, number))
    _filter(calls[_FILTER_B], (command, world[ROBOT]))
    _answered(engine, command)
    _contacts(calls[_CONTACTS], (world[CLIENT], room))
    for found in range(load_int(room)):
        point = load_address(room + 8) + _POINT_SIZE * found
        for c in range(3):
            into[6 + c] -= load_double(point + _NORMAL_FORCE) * load_double(point + _NORMAL + 8 * c)


@exact_part
def _add_contact(engine: BulletEngine, point: int, state: Floats, start: int) -> None:
    # Bullet tells the force on the first thing of a couple, and the order of a couple with boxes is Bullet's choice.
    # (Where it is asked for the robot as the first, it turns the normal round but not the friction.)
    first = load_int(point + _THING) == engine.world[ROBOT]
    link = load_int(point + (_LINK if first else _OTHER_LINK))
    if 0 <= link < engine.rows.shape[0] and engine.rows[link] >= 0:
        _add_force(point, 1.0 if first else -1.0, state, start + 3 * engine.rows[link])


@exact_part
def _clear(engine: BulletEngine, links: int) -> bool:
    # Bullet leaves the poses of links as they were when it last looked for contacts.
    for link in range(engine.rows.shape[0]):
        row = engine.rows[link]
        if row >= 0 and not load_double(links + _POSE_SIZE * link + _HEIGHT) > engine.constants[10 + row]:
            return False
    return True


@exact_part
def _add_force(point: int, sign: float, state: Floats, start: int) -> None:
    normal = sign * load_double(point + _NORMAL_FORCE)
    first, second = sign * load_double(point + _FRICTION[0]), sign * load_double(point + _FRICTION[1])
    for k in range(3):
        along = normal * load_double(point + _NORMAL + 8 * k)
        along += first * load_double(point + _FRICTION_DIRECTION[0] + 8 * k)
        state[start + k] += along + second * load_double(point + _FRICTION_DIRECTION[1] + 8 * k)
