"""The part of the ground that a moving body comes near, as meshes."""

from collections.abc import Iterator
from dataclasses import dataclass
from math import cos, log10, sin

import numpy as np

from neuromech.analyse.windows import Array
from neuromech.graph.terrain import Box, terrain
from neuromech.report.meshes import Mesh, box, sheet
from neuromech.report.replay import Poses
from neuromech.spec.world import Ground

_MARGIN = 8.0
"""How far the ground reaches beyond the body's way, in body sizes."""

_CELL = 2.0
"""Length of the rectangles that the ground is cut into, in body sizes; the renderer's shadows need small ones."""


LEVEL, RAISED = (1.0, 1.0, 1.0), (1.0, 0.93, 0.82)
"""Colours that tint level ground, and slopes and steps."""


@dataclass(frozen=True, slots=True)
class Piece:
    """A piece of the ground and its colour."""

    mesh: Mesh
    color: tuple[float, float, float]


def square(size: float) -> float:
    """Return the side (m) of the squares on the ground: 1, 2 or 5 times a power of ten, near a fifth of the size."""
    wanted = size / 5.0
    power = 10.0 ** np.floor(log10(wanted))
    return float(min((power * factor for factor in (1.0, 2.0, 5.0, 10.0)), key=lambda side: abs(log10(side / wanted))))


def ground_pieces(ground: Ground | None, poses: Poses, size: float) -> list[Piece]:
    """Return the pieces of the ground near a body's way, none without ground.

    Args:
        ground: of the world.
        poses: the way.
        size: of the body, in m.
    """
    if ground is None:
        return []
    way = poses.position[:, 0, :2]
    low, high = way.min(axis=0) - _MARGIN * size, way.max(axis=0) + _MARGIN * size
    return list(_pieces(ground, low, high, _CELL * size))


def _pieces(ground: Ground, low: Array, high: Array, cell: float) -> Iterator[Piece]:
    found = terrain(ground)
    if found.plane is not None:
        level = sheet((low[0], low[1]), (high[0], high[1]), cell)
        yield Piece(level.moved(np.eye(3), np.array([0.0, 0.0, found.plane[0]])), LEVEL)
    steps = {step.name for step in found.boxes[len(found.boxes) - len(ground.steps) :]}
    for piece in found.boxes:
        mesh = _clipped(piece, low, high, cell)
        if mesh is not None:
            yield Piece(mesh, LEVEL if piece.angle == 0.0 and piece.name not in steps else RAISED)


def _clipped(piece: Box, low: Array, high: Array, cell: float) -> Mesh | None:
    """Return what of a box lies between two corners x, y (m), None where nothing does."""
    center, half = np.array(piece.center), 0.5 * np.array(piece.size)
    along = np.array([cos(piece.angle), 0.0, sin(piece.angle)])
    ends = np.array([-half[:2], half[:2]])
    limits = (np.array([low, high]) - center[:2]) / np.array([along[0], 1.0])
    first, last = np.maximum(ends[0], limits[0]), np.minimum(ends[1], limits[1])
    if (last <= first).any():
        return None
    rotation = np.array([along, [0.0, 1.0, 0.0], [-along[2], 0.0, along[0]]]).T
    middle = 0.5 * (first + last)
    shift = center + rotation @ np.array([middle[0], middle[1], 0.0])
    return box(np.array([*(last - first), 2.0 * half[2]]), cell).moved(rotation, shift)
