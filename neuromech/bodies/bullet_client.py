"""What building a world asks of Bullet, however it is called."""

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final


class BulletError(Exception):
    """Bullet refused a command."""


@dataclass(frozen=True, slots=True)
class BulletJoint:
    """A joint by Bullet's numbers.

    Args:
        number: of the joint and of the link that it moves.
        name: of the joint.
        link: name of the link that it moves.
        moves: False for a fixed joint.
        position: place of its angle among the positions of the robot, which begin with the root's seven.
        velocity: place of its velocity among the velocities of the robot, which begin with the root's six.
    """

    number: int
    name: str
    link: str
    moves: bool
    position: int
    velocity: int


@dataclass(frozen=True, slots=True)
class BulletBox:
    """A box: sides and centre in m, orientation as a unit quaternion x, y, z, w."""

    size: Sequence[float]
    position: Sequence[float]
    quaternion: Sequence[float]


MOST_BOXES: Final = 16
"""Shapes that Bullet takes in one command."""


class BulletClient(ABC):
    """A physics client with a world of its own. Links are counted from 0; −1 is the root link of a robot."""

    @abstractmethod
    def set_engine(self, step: float, iterations: int, gravity: float) -> None:
        """Set time step in s, iterations of the solver, gravity along −z in m/s²; pairs in a fixed order."""

    @abstractmethod
    def load(self, file: Path, fixed: bool) -> int:
        """Load a URDF file with the inertias that stand in it and return the robot.

        Raises:
            BulletError: Bullet cannot load it.
        """

    @abstractmethod
    def joints(self, robot: int) -> list[BulletJoint]:
        """Return the joints of a robot, fixed ones included."""

    @abstractmethod
    def add_plane(self, height: float) -> int:
        """Add a level plane at a height in m and return it."""

    @abstractmethod
    def add_boxes(self, boxes: Sequence[BulletBox]) -> int:
        """Add at most `MOST_BOXES` boxes that never move, as one thing, and return it."""

    @abstractmethod
    def add_ball(self, radius: float, mass: float, position: Sequence[float]) -> int:
        """Add a homogeneous ball that moves freely, its middle at a place in m, and return it."""

    @abstractmethod
    def set_partners(self, thing: int, link: int, group: int, partners: int) -> None:
        """Let a link collide only with links of the groups of which `partners` has the bits; its own is `group`."""

    @abstractmethod
    def stop_motors(self, robot: int, joints: Sequence[BulletJoint]) -> None:
        """Take away the force of the motors with which joints are born."""

    @abstractmethod
    def set_dynamics(self, robot: int, link: int, settings: Mapping[str, float]) -> None:
        """Set properties of a link, by the names of PyBullet's `changeDynamics`."""

    @abstractmethod
    def inertia(self, robot: int, link: int) -> tuple[float, float, float, float]:
        """Return mass in kg and principal moments of inertia in kg m² that Bullet gave a link."""

    @abstractmethod
    def put_root(
        self, robot: int, position: Sequence[float], quaternion: Sequence[float], velocity: Sequence[float]
    ) -> None:
        """Put the root link's centre of mass to a place, with a velocity in m/s and without turning."""

    @abstractmethod
    def put_joint(self, robot: int, joint: int, position: float, velocity: float) -> None:
        """Give a joint its angle and velocity."""

    @abstractmethod
    def close(self) -> None:
        """Free the client and its world."""
