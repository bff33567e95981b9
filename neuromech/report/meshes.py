"""Triangles of the simple solids that pictures are made of."""

from dataclasses import dataclass
from math import pi

import numpy as np
from numpy.typing import NDArray

from neuromech.analyse.windows import Array

_AROUND = 24
"""Corners of a circle."""

_ALONG = 7
"""Circles of half a sphere."""


@dataclass(frozen=True, slots=True)
class Mesh:
    """A surface of triangles, n corners.

    Args:
        vertices: (n, 3) in m.
        normals: (n, 3) unit vectors that point outward.
        triangles: (m, 3) corners of each triangle, counter-clockwise as seen from outside.
    """

    vertices: Array
    normals: Array
    triangles: NDArray[np.int64]

    def moved(self, rotation: Array, shift: Array) -> "Mesh":
        """Return the mesh turned by a (3, 3) rotation, then shifted by (3,) m."""
        return Mesh(self.vertices @ rotation.T + shift, self.normals @ rotation.T, self.triangles)

    def texture(self, tile: float) -> Array:
        """Return for each corner its place in a picture that repeats itself after `tile` (m), shape (n, 2).

        The picture is projected along the axis that a corner's normal is closest to, so that it passes without a break
        from one piece of level ground to the next.
        """
        across = np.array([[1, 2], [0, 2], [0, 1]])[np.argmax(np.abs(self.normals), axis=1)]
        return np.asarray(np.take_along_axis(self.vertices, across, axis=1) / tile)


def capsule(start: Array, end: Array, radius: float) -> Mesh:
    """Return a cylinder between two points (m) with half a sphere at each end; a sphere where they are the same."""
    start, end = np.asarray(start, dtype=np.float64), np.asarray(end, dtype=np.float64)
    length = float(np.linalg.norm(end - start))
    axes = _axes((end - start) / length if length > 0.0 else np.array([0.0, 0.0, 1.0]))
    quarter = np.linspace(0.0, pi / 2.0, _ALONG)
    latitude = np.concatenate((quarter - pi / 2.0, quarter))[:, None]
    longitude = np.linspace(0.0, 2.0 * pi, _AROUND, endpoint=False)[None, :]
    flat = np.cos(latitude)
    local = np.stack((flat * np.cos(longitude), flat * np.sin(longitude), np.sin(latitude) + 0.0 * longitude), axis=-1)
    base = np.where(np.arange(2 * _ALONG) < _ALONG, 0.0, length)[:, None]
    normals = (local @ axes).reshape(-1, 3)
    vertices = start + (radius * local @ axes + (base * axes[2])[:, None, :]).reshape(-1, 3)
    return Mesh(vertices, normals, _tube_triangles(2 * _ALONG))


def box(size: Array, cell: float) -> Mesh:
    """Return a box around the origin with sides along the axes.

    Args:
        size: along x, y and z in m.
        cell: faces are cut into rectangles not longer than this, in m.
    """
    faces = [_face(np.asarray(size, dtype=np.float64), axis, sign, cell) for axis in range(3) for sign in (-1, 1)]
    return _joined(faces)


def sheet(low: tuple[float, float], high: tuple[float, float], cell: float) -> Mesh:
    """Return a level rectangle at height zero between two corners x, y (m), seen from above; else as `box`."""
    x, y = (_cuts(low[axis], high[axis], cell) for axis in range(2))
    grid = np.stack(np.meshgrid(x, y, indexing="ij"), axis=-1).reshape(-1, 2)
    vertices = np.column_stack((grid, np.zeros(len(grid))))
    normals = np.tile([0.0, 0.0, 1.0], (len(grid), 1))
    return Mesh(vertices, normals, _grid_triangles(len(x), len(y)))


def _face(size: Array, axis: int, sign: int, cell: float) -> Mesh:
    """Return a face of a box: a sheet that is turned so that it looks along one axis."""
    first, second = ((axis + 1) % 3, (axis + 2) % 3)
    half = 0.5 * size
    flat = sheet((-half[first], -half[second]), (half[first], half[second]), cell)
    turned = np.zeros((3, 3))
    turned[first, 0] = sign
    turned[second, 1] = 1.0
    turned[axis, 2] = sign
    shift = np.zeros(3)
    shift[axis] = sign * half[axis]
    return flat.moved(turned, shift)


def _joined(meshes: list[Mesh]) -> Mesh:
    starts = np.cumsum([0, *(len(mesh.vertices) for mesh in meshes)])
    return Mesh(
        np.concatenate([mesh.vertices for mesh in meshes]),
        np.concatenate([mesh.normals for mesh in meshes]),
        np.concatenate([mesh.triangles + start for mesh, start in zip(meshes, starts, strict=False)]),
    )


def _cuts(low: float, high: float, cell: float) -> Array:
    return np.linspace(low, high, 1 + max(1, int(np.ceil((high - low) / cell))))


def _axes(along: Array) -> Array:
    """Return three orthogonal unit vectors as rows, the last of them the given one."""
    other = np.eye(3)[int(np.argmin(np.abs(along)))]
    first = np.cross(other, along)
    first /= np.linalg.norm(first)
    return np.array([first, np.cross(along, first), along])


def _tube_triangles(circles: int) -> NDArray[np.int64]:
    """Return the triangles between circles that stand one above the other."""
    ring, corner = np.meshgrid(np.arange(circles - 1), np.arange(_AROUND), indexing="ij")
    a, b = ring * _AROUND + corner, ring * _AROUND + (corner + 1) % _AROUND
    return np.stack((a, b, b + _AROUND, a, b + _AROUND, a + _AROUND), axis=-1).reshape(-1, 3)


def _grid_triangles(rows: int, columns: int) -> NDArray[np.int64]:
    """Return the triangles of a grid of points, rows along x and columns along y."""
    row, column = np.meshgrid(np.arange(rows - 1), np.arange(columns - 1), indexing="ij")
    a = row * columns + column
    b = a + columns
    return np.stack((a, b, b + 1, a, b + 1, a + 1), axis=-1).reshape(-1, 3)
