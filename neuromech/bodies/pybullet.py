"""Bodies moved by PyBullet: by compiled code through Bullet's C functions, or by PyBullet's portable Python functions.

Both paths build the same world and give the same bits. A world is built anew for every opening and every reset: Bullet
repeats a run bit for bit only in a fresh world (https://github.com/bulletphysics/bullet3/issues/3099).
"""

from collections.abc import Sequence
from threading import Lock
from typing import ClassVar, Literal, Protocol

from neuromech.bodies.base import Body, Engine, Floats, initial_motion
from neuromech.bodies.bullet_c import CClient, bullet_library
from neuromech.bodies.bullet_client import BulletClient
from neuromech.bodies.bullet_native import BulletEngine, NativeMotion
from neuromech.bodies.bullet_python import PythonClient, PythonMotion
from neuromech.bodies.pybullet_world import BulletWorld, build_world, check_pybullet, put
from neuromech.bodies.versions import package_version
from neuromech.compiler.body_state import BodyState
from neuromech.errors import RunError
from neuromech.graph.model import BodyModel

Path = Literal["native", "python"]

# Loading of models shares memory between clients; stepping does not.
_BUILDING = Lock()


class _Motion(Protocol):
    @property
    def client(self) -> BulletClient: ...

    def read(self, state: Floats) -> None: ...

    def step(self, torque: Floats) -> None: ...

    def push(self, segment: int, acting: Floats) -> None: ...

    def place(self, weight: int, position: Floats) -> None: ...

    def check(self) -> None: ...

    def native(self) -> BulletEngine | None: ...


def usual_path() -> Path:
    """Return `native` where Bullet's C functions can be called, else `python`."""
    return "python" if bullet_library() is None else "native"


class PyBulletBody(Body):
    """A body in a Bullet world of its own."""

    native_module: ClassVar[str | None] = "neuromech.bodies.bullet_native"

    def __init__(self, body: BodyModel, step: float, path: Path | None = None) -> None:
        """Build the world.

        Args:
            body: the body.
            step: in seconds.
            path: through Bullet's C functions or through PyBullet's Python functions; `usual_path()` where not given.

        Raises:
            DocumentError: Bullet cannot move this body.
            RunError: the native path is asked for, and Bullet's C functions cannot be called.
        """
        check_pybullet(body)
        self._path: Path = path or usual_path()
        self.joints = tuple(body.joints)
        self.contacts = tuple(body.contacts)
        self.step_seconds = step
        self.engine = Engine("pybullet", package_version("pybullet"), self._path)
        self.layout = BodyState(len(body.joints), len(body.contacts), len(body.world.pendulums))
        self._body = body
        self._motion: _Motion | None = None
        self._start(*initial_motion(body))

    def read(self, state: Floats) -> None:
        """Fill the state array."""
        self._opened().read(state)

    def step(self, torque: Floats) -> None:
        """Apply joint torques and advance by one step."""
        self._opened().step(torque)

    def push(self, segment: int, acting: Floats) -> None:
        """Let a force act on a segment during the next step."""
        self._opened().push(segment, acting)

    def place(self, weight: int, position: Floats) -> None:
        """Put the weight of a pendulum to a place, at rest."""
        self._opened().place(weight, position)

    def reset(self, angles: Sequence[float] | Floats, velocities: Sequence[float] | Floats | None = None) -> None:
        """Build the world anew and put the joints as told."""
        self._opened()
        self.close()
        self._start(angles, [0.0] * len(self.joints) if velocities is None else velocities)

    def native(self) -> BulletEngine | None:
        """Return the world for the compiled functions; None on the portable path."""
        return self._opened().native()

    def check(self) -> None:
        """Raise what a compiled function could only report."""
        self._opened().check()

    def close(self) -> None:
        """Disconnect the physics client."""
        if self._motion is not None:
            with _BUILDING:
                self._motion.client.close()
            self._motion = None

    def _opened(self) -> _Motion:
        if self._motion is None:
            raise RunError("the body is closed")
        return self._motion

    def _start(self, angles: Sequence[float] | Floats, velocities: Sequence[float] | Floats) -> None:
        with _BUILDING:
            client = _connect(self._path)
            try:
                world = build_world(client, self._body, self.step_seconds)
                put(client, world, self._body, angles, velocities)
            except BaseException:
                client.close()
                raise
        self._motion = _motion(client, world, self.layout)


def _connect(path: Path) -> CClient | PythonClient:
    if path == "python":
        return PythonClient()
    library = bullet_library()
    if library is None:
        raise RunError("this PyBullet does not offer the C functions that the native path calls")
    return CClient(library)


def _motion(client: CClient | PythonClient, world: BulletWorld, layout: BodyState) -> _Motion:
    if isinstance(client, PythonClient):
        return PythonMotion(client, world, layout)
    return NativeMotion(client, world)
