"""Pictures of a body and its ground, by the software renderer of PyBullet, which needs neither screen nor GPU.

The scene stands around the origin and moves under the camera, because the renderer's shadows reach as far as its light.
"""

from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from types import TracebackType
from typing import Any, Self

import numpy as np
from matplotlib.image import imsave
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from neuromech.analyse.windows import Array
from neuromech.bodies.pybullet_import import pybullet
from neuromech.report.camera import FIELD_OF_VIEW, Camera
from neuromech.report.ground import ground_pieces, square
from neuromech.report.meshes import Mesh
from neuromech.report.replay import Poses
from neuromech.report.shot import Shot
from neuromech.report.solids import LIFTED, LOADED, Color, contact_meshes, segment_solids, weight_solids

Image = NDArray[np.uint8]

_PALE, _DARK = 244, 214
"""Greys of the squares of the ground."""

_LIGHT = {
    "lightColor": (1.0, 1.0, 1.0),
    "lightAmbientCoeff": 0.62,
    "lightDiffuseCoeff": 0.45,
    "lightSpecularCoeff": 0.02,
    "shadow": 1,
}
_DRAWN_SIZE = 0.5
"""Size of every body in the scene; the renderer tells shadow from light by a fixed difference in depth."""

_NEAR, _FAR, _LIGHT_DISTANCE = 0.05, 20.0, 2.0
"""Distances in the scene: what the camera sees, and the light. The wider shadows reach, the coarser they are."""

_OUT_OF_SIGHT = np.array([0.0, 0.0, -1e3])
"""Place (m) under the ground of what is not to be seen."""

_CLEAR, _GONE = 1.6, 5.0
"""How far behind the body the ground begins to fade, and is gone, in body sizes."""


@dataclass(frozen=True, slots=True)
class Picture:
    """Size of a picture in pixels; it is drawn `finer` times as large and averaged, which smooths its edges."""

    width: int
    height: int
    finer: int = 1


class Scene:
    """A body on its ground, to be used in a `with` block."""

    def __init__(self, shot: Shot, picture: Picture) -> None:
        """Build the scene.

        Args:
            shot: what shall be shown.
            picture: size of the pictures.
        """
        self._shot, self._picture = shot, picture
        self._scale = _DRAWN_SIZE / shot.size
        self._client: int = pybullet.connect(pybullet.DIRECT)
        solids = segment_solids(shot.body, shot.poses, shot.size)
        self._segments = [(solid.segment, self._add(solid.mesh, solid.color)) for solid in solids]
        self._contacts = [self._add(mesh, LIFTED) for mesh in contact_meshes(shot.body)]
        self._weights = [self._add(mesh, color) for swing in shot.swings for mesh, color in weight_solids(swing)]
        self._shown_loaded = [False] * len(self._contacts)
        tile = 2.0 * square(shot.size)
        pieces = ground_pieces(shot.body.world.ground, shot.poses, shot.size)
        self._ground = [self._add(piece.mesh, piece.color, piece.mesh.texture(tile)) for piece in pieces]
        self._pave()

    def __enter__(self) -> Self:
        """Return the scene; it is freed at the end of the `with` block."""
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Free the renderer."""
        pybullet.disconnect(physicsClientId=self._client)

    def image(self, number: int) -> Image:
        """Return one picture of the shot, shape (height, width, 3), with the loaded contacts in yellow."""
        camera = self._shot.cameras[number]
        self._pose(self._shot.poses, number, camera.target)
        self._show_loads(self._shot.loaded[number])
        self._show_weights(float(self._shot.poses.time[number]), camera.target)
        finer = self._picture.finer
        width, height = finer * self._picture.width, finer * self._picture.height
        colors, distance = self._rendered(width, height, camera)
        shown = _faded(colors, distance - self._scale * camera.distance)
        return _averaged(shown, finer)

    def _add(self, mesh: Mesh, color: Color, texture: Array | None = None) -> int:
        options: dict[str, Any] = {} if texture is None else {"uvs": texture.tolist()}
        shape = pybullet.createVisualShape(
            pybullet.GEOM_MESH,
            vertices=(self._scale * mesh.vertices).tolist(),
            indices=mesh.triangles.ravel().tolist(),
            normals=mesh.normals.tolist(),
            rgbaColor=[*color, 1.0],
            physicsClientId=self._client,
            **options,
        )
        added: int = pybullet.createMultiBody(0.0, -1, shape, physicsClientId=self._client)
        return added

    def _pave(self) -> None:
        """Put squares on the ground."""
        light, dark = np.full((32, 32), _PALE), np.full((32, 32), _DARK)
        squares = np.block([[light, dark], [dark, light]]).astype(np.uint8)
        with TemporaryDirectory(prefix="neuromech-") as folder:
            file = Path(folder, "squares.png")
            imsave(file, np.repeat(squares[:, :, None], 3, axis=2))
            texture = pybullet.loadTexture(str(file), physicsClientId=self._client)
        for piece in self._ground:
            pybullet.changeVisualShape(piece, -1, textureUniqueId=texture, physicsClientId=self._client)

    def _pose(self, poses: Poses, number: int, target: Array) -> None:
        turns = Rotation.from_matrix(poses.rotation[number]).as_quat()
        for segment, piece in self._segments:
            self._put(piece, poses.position[number, segment] - target, turns[segment])
        still = np.array([0.0, 0.0, 0.0, 1.0])
        for row, piece in enumerate(self._contacts):
            self._put(piece, poses.contact[number, row] - target, still)
        for piece in self._ground:
            self._put(piece, -target, still)

    def _put(self, piece: int, position: Array, quaternion: Array) -> None:
        pybullet.resetBasePositionAndOrientation(
            piece, (self._scale * position).tolist(), quaternion.tolist(), physicsClientId=self._client
        )

    def _show_loads(self, loaded: NDArray[np.bool_]) -> None:
        for row, (piece, is_loaded) in enumerate(zip(self._contacts, loaded, strict=True)):
            if is_loaded != self._shown_loaded[row]:
                color = [*(LOADED if is_loaded else LIFTED), 1.0]
                pybullet.changeVisualShape(piece, -1, rgbaColor=color, physicsClientId=self._client)
                self._shown_loaded[row] = bool(is_loaded)

    def _show_weights(self, time: float, target: Array) -> None:
        for swing, *pieces in zip(self._shot.swings, self._weights[::2], self._weights[1::2], strict=True):
            (place,), (swings,) = swing.at(np.array([time]))
            for piece in pieces:
                turn = Rotation.align_vectors([place - swing.pivot], [[0.0, 0.0, -1.0]])[0].as_quat()
                self._put(piece, place - target if swings else _OUT_OF_SIGHT, turn)

    def _rendered(self, width: int, height: int, camera: Camera) -> tuple[Image, Array]:
        """Return colours, shape (height, width, 3), and distances in the scene from the camera, (height, width)."""
        eye = (self._scale * (camera.eye - camera.target)).tolist()
        view = pybullet.computeViewMatrix(eye, (0.0, 0.0, 0.0), (0.0, 0.0, 1.0))
        lens = pybullet.computeProjectionMatrixFOV(FIELD_OF_VIEW, width / height, _NEAR, _FAR)
        _, _, colors, depth, _ = pybullet.getCameraImage(
            width,
            height,
            view,
            lens,
            lightDirection=(_LIGHT_DISTANCE * camera.light).tolist(),
            lightDistance=_LIGHT_DISTANCE,
            renderer=pybullet.ER_TINY_RENDERER,
            flags=pybullet.ER_NO_SEGMENTATION_MASK,
            physicsClientId=self._client,
            **_LIGHT,
        )
        buffer = np.reshape(depth, (height, width))
        return np.reshape(colors, (height, width, 4))[:, :, :3], _FAR * _NEAR / (_FAR - (_FAR - _NEAR) * buffer)


def _faded(colors: Image, behind: Array) -> Array:
    """Return colours that turn white where what is seen is too far behind the body to be of interest."""
    part = np.clip((behind / _DRAWN_SIZE - _CLEAR) / (_GONE - _CLEAR), 0.0, 1.0)[:, :, None]
    return np.asarray(colors + (255.0 - colors) * part)


def _averaged(colors: Array, finer: int) -> Image:
    height, width = colors.shape[0] // finer, colors.shape[1] // finer
    return np.asarray(colors.reshape(height, finer, width, finer, 3).mean(axis=(1, 3)) + 0.5, dtype=np.uint8)
