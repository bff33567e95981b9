"""Joint-space inertia of a tree by the composite-rigid-body algorithm. Compiled, without allocation.

Everything is expressed in world axes about the origin of the root frame, so that composite inertias simply add.

Source: Featherstone 2008, Rigid Body Dynamics Algorithms, section 6.2, doi:10.1007/978-1-4899-7560-7.
"""

import numpy as np

from neuromech.compiler.kinematics import world_axis
from neuromech.compiler.numerics import Floats, Integers, compiled, part
from neuromech.compiler.tree import (
    ARMATURE,
    CENTER,
    FIXED_ROOT,
    FREE_ROOT,
    HINGE,
    INERTIA,
    JOINT,
    KIND,
    MASS,
    PARENT,
    Tree,
)

# Columns of a work row: mass, mass × centre (3), inertia xx yy zz xy xz yz, joint motion (angular, linear), and the
# force that this motion needs from the segment and all beyond it (moment, force).
_MOMENT = 1
_SECOND = 4
_MOTION = 10
_FORCE = 16


@part
def inertia_of_all(
    topology: Integers, geometry: Floats, root: int, rotation: Floats, position: Floats, work: Floats, inertia: Floats
) -> None:
    """Fill the matrix that maps accelerations of joints and root to what acts on them, armature included.

    The root's rows come last, so that limbs that only the root joins do not touch each other when the matrix is
    factorised from the front. A planar root must be turned about y only.

    Args:
        topology: see `Tree`.
        geometry: see `Tree`.
        root: see `Tree`.
        rotation: from `forward_kinematics`.
        position: from `forward_kinematics`.
        work: from `Tree.new_work`.
        inertia: its lower triangle is filled; (joints + root, joints + root) in kg m², kg m and kg. The rows of the
            root are rotation about x, y, z and motion along them, those of a planar root rotation about y, then
            motion along x and z.
    """
    count = topology.shape[0]
    for i in range(count):
        _segment_inertia(geometry, rotation, position, i, work[i])
    for i in range(count - 1, 0, -1):
        for k in range(_MOTION):
            work[topology[i, PARENT], k] += work[i, k]
    for i in range(1, count):
        _joint_motion(topology, geometry, rotation, position, i, work[i])
    _clear(inertia, inertia.shape[0])
    for i in range(1, count):
        _joint_row(topology, geometry, i, work, inertia)
    if root != FIXED_ROOT:
        _root_rows(topology, root, work, inertia)


_fill_inertia = compiled(inertia_of_all.py_func)


def mass_matrix(tree: Tree, rotation: Floats, position: Floats) -> Floats:
    """Return the matrix that maps joint accelerations to joint torques when nothing else acts, armature included.

    For a root that moves this is the Schur complement that eliminates the root's motion. A planar root must be turned
    about y only.

    Args:
        tree: the body.
        rotation: from `forward_kinematics`.
        position: from `forward_kinematics`.

    Returns:
        (joints, joints) in kg m².
    """
    n = len(tree.joints)
    lower = np.zeros((n + tree.root, n + tree.root))
    _fill_inertia(tree.topology, tree.geometry, tree.root, rotation, position, tree.new_work(), lower)
    joints = lower[:n, :n] + np.tril(lower[:n, :n], -1).T
    if tree.root == FIXED_ROOT:
        return joints
    own = lower[n:, n:] + np.tril(lower[n:, n:], -1).T
    shared: Floats = np.linalg.solve(np.linalg.cholesky(own), lower[n:, :n])
    return np.asarray(joints - shared.T @ shared)


@part
def _clear(matrix: Floats, size: int) -> None:
    for i in range(size):
        for j in range(size):
            matrix[i, j] = 0.0


@part
def _segment_inertia(geometry: Floats, rotation: Floats, position: Floats, i: int, row: Floats) -> None:
    mass = geometry[i, MASS]
    for k in range(_SECOND + 6):
        row[k] = 0.0
    for k in range(3):
        center = position[i, k] - position[0, k]
        for axis in range(3):
            center += rotation[i, k, axis] * geometry[i, CENTER + axis]
        row[_MOMENT + k] = mass * center
        _add_moment(row, geometry[i, INERTIA + k], rotation[i, 0, k], rotation[i, 1, k], rotation[i, 2, k])
    row[0] = mass
    x = row[_MOMENT] / mass
    y = row[_MOMENT + 1] / mass
    z = row[_MOMENT + 2] / mass
    for k in range(3):
        row[_SECOND + k] += mass * (x * x + y * y + z * z)
    _add_moment(row, -mass, x, y, z)


@part
def _add_moment(row: Floats, moment: float, x: float, y: float, z: float) -> None:
    row[_SECOND] += moment * x * x
    row[_SECOND + 1] += moment * y * y
    row[_SECOND + 2] += moment * z * z
    row[_SECOND + 3] += moment * x * y
    row[_SECOND + 4] += moment * x * z
    row[_SECOND + 5] += moment * y * z


@part
def _joint_motion(
    topology: Integers, geometry: Floats, rotation: Floats, position: Floats, i: int, row: Floats
) -> None:
    for k in range(3):
        row[_MOTION + 3 + k] = world_axis(geometry, rotation, i, k)
    a = row[_MOTION + 3]
    b = row[_MOTION + 4]
    c = row[_MOTION + 5]
    if topology[i, KIND] == HINGE:
        x = position[i, 0] - position[0, 0]
        y = position[i, 1] - position[0, 1]
        z = position[i, 2] - position[0, 2]
        _store(row, _MOTION, a, b, c, y * c - z * b, z * a - x * c, x * b - y * a)
    else:
        _store(row, _MOTION, 0.0, 0.0, 0.0, a, b, c)
    _apply_inertia(row)


@part
def _store(row: Floats, at: int, a: float, b: float, c: float, x: float, y: float, z: float) -> None:
    row[at] = a
    row[at + 1] = b
    row[at + 2] = c
    row[at + 3] = x
    row[at + 4] = y
    row[at + 5] = z


@part
def _apply_inertia(row: Floats) -> None:
    # Spatial inertia times motion: moment = I ω + h × v, force = m v − h × ω.
    m, hx, hy, hz = row[0], row[1], row[2], row[3]
    xx, yy, zz, xy, xz, yz = row[4], row[5], row[6], row[7], row[8], row[9]
    a, b, c, x, y, z = row[10], row[11], row[12], row[13], row[14], row[15]
    _store(
        row,
        _FORCE,
        xx * a + xy * b + xz * c + hy * z - hz * y,
        xy * a + yy * b + yz * c + hz * x - hx * z,
        xz * a + yz * b + zz * c + hx * y - hy * x,
        m * x - (hy * c - hz * b),
        m * y - (hz * a - hx * c),
        m * z - (hx * b - hy * a),
    )


@part
def _joint_row(topology: Integers, geometry: Floats, i: int, work: Floats, inertia: Floats) -> None:
    row = topology[i, JOINT]
    j = i
    while j > 0:
        value = 0.0
        for k in range(6):
            value += work[j, _MOTION + k] * work[i, _FORCE + k]
        column = topology[j, JOINT]
        inertia[max(row, column), min(row, column)] = value
        j = topology[j, PARENT]
    inertia[row, row] += geometry[i, ARMATURE]


@part
def _root_rows(topology: Integers, root: int, work: Floats, inertia: Floats) -> None:
    count = topology.shape[0]
    n = inertia.shape[0] - root
    own = work[count : count + 6]
    _root_inertia(work[0], own)
    if root != FREE_ROOT:
        _keep_planar(work, count, own)
    for i in range(1, count):
        for k in range(root):
            inertia[n + k, topology[i, JOINT]] = work[i, _FORCE + k]
    for i in range(root):
        for j in range(i + 1):
            inertia[n + i, n + j] = own[i, j]


@part
def _root_inertia(row: Floats, factor: Floats) -> None:
    _clear(factor, 6)
    m, hx, hy, hz = row[0], row[1], row[2], row[3]
    factor[0, 0], factor[1, 1], factor[2, 2] = row[4], row[5], row[6]
    factor[1, 0] = row[7]
    factor[2, 0] = row[8]
    factor[2, 1] = row[9]
    factor[3, 3] = factor[4, 4] = factor[5, 5] = m
    factor[3, 1] = hz
    factor[3, 2] = -hy
    factor[4, 0] = -hz
    factor[4, 2] = hx
    factor[5, 0] = hy
    factor[5, 1] = -hx


@part
def _keep_planar(work: Floats, count: int, factor: Floats) -> None:
    # Rows and columns of rotation about y and motion along x and z move to the front.
    yy, xy, zy, m = factor[1, 1], factor[3, 1], factor[5, 1], factor[3, 3]
    _clear(factor, 3)
    factor[0, 0] = yy
    factor[1, 0] = xy
    factor[2, 0] = zy
    factor[1, 1] = m
    factor[2, 2] = m
    for i in range(1, count):
        work[i, _FORCE] = work[i, _FORCE + 1]
        work[i, _FORCE + 1] = work[i, _FORCE + 3]
        work[i, _FORCE + 2] = work[i, _FORCE + 5]
