"""The one array that a body and the compiled step exchange, and where its parts stand."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class BodyState:
    """Layout of the body's state: a contiguous float64 array of 2 n + 13 + 3 m + 9 w numbers, SI units, world axes.

    In this order: joint angles (n), joint velocities (n), position of the root segment's frame (3), its orientation as
    a unit quaternion x, y, z, w (4), velocity of the frame's origin (3), angular velocity (3), force of the ground on
    each contact during the last step (m × 3; zero before the first); then for each weight on a string its position
    (3), its velocity (3), and its force on the body during the last step (3).

    Args:
        joints: n, the number of joints.
        contacts: m, the number of contacts.
        weights: w, the number of weights.
    """

    joints: int
    contacts: int
    weights: int = 0

    @property
    def size(self) -> int:
        """Length of the array."""
        return 2 * self.joints + 13 + 3 * self.contacts + 9 * self.weights

    @property
    def angles(self) -> slice:
        """Joint angles in rad; of slides, displacements in m."""
        return slice(0, self.joints)

    @property
    def velocities(self) -> slice:
        """Joint velocities in rad/s; of slides in m/s."""
        return slice(self.joints, 2 * self.joints)

    @property
    def root_pose(self) -> slice:
        """Position of the root frame in m, then its unit quaternion x, y, z, w."""
        return self._from_root(0, 7)

    @property
    def root_velocity(self) -> slice:
        """Velocity of the root frame's origin in m/s, then its angular velocity in rad/s."""
        return self._from_root(7, 13)

    @property
    def contact_forces(self) -> slice:
        """Force of the ground on each contact in N, x, y and z after each other."""
        return self._from_root(13, 13 + 3 * self.contacts)

    @property
    def hanging(self) -> slice:
        """Position in m, velocity in m/s and force in N of each weight, one weight after the other."""
        return self._from_root(13 + 3 * self.contacts, 13 + 3 * self.contacts + 9 * self.weights)

    def _from_root(self, start: int, end: int) -> slice:
        return slice(2 * self.joints + start, 2 * self.joints + end)
