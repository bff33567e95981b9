"""An MP4 film of a body as it was recorded."""

import importlib
import os
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.font_manager import findfont
from PIL import Image as Pillow
from PIL import ImageDraw, ImageFont

from neuromech.analyse.windows import Array
from neuromech.errors import MissingExtraError
from neuromech.report.camera import Angle
from neuromech.report.replay import Motion
from neuromech.report.scene import Image, Picture, Scene
from neuromech.report.shot import Shot, shoot

FRAMES_PER_SECOND = 30
SIZE = Picture(1280, 720)
_QUALITY = "20"
"""Constant rate factor of H.264: 18 looks like the original, every 6 more halve the file."""

_FEWEST_FOR_PROCESSES = 30
"""Number of pictures from which starting further processes pays."""


@dataclass(frozen=True, slots=True)
class Film:
    """How a film is made.

    Args:
        angle: where the camera stands.
        picture: size; both sides even, as H.264 wants it.
        frames_per_second: of the film.
        slower: by which factor the film is slower than the body.
        start: time of the run (s) at which it begins.
        end: time of the run (s) at which it ends, the end of the recording where None is given.
    """

    angle: Angle = "side"
    picture: Picture = SIZE
    frames_per_second: int = FRAMES_PER_SECOND
    slower: float = 1.0
    start: float = 0.0
    end: float | None = None

    def times(self, last: float) -> Array:
        """Return the time (s) of each picture of a film of a recording that ends at `last` (s)."""
        rate = self.frames_per_second * self.slower
        end = last if self.end is None else min(self.end, last)
        count = max(1, round((end - self.start) * rate))
        return np.minimum(self.start + np.arange(count) / rate, last)


def load_av() -> Any:
    """Import the package `av`, which is an extra.

    Raises:
        MissingExtraError: it is not installed.
    """
    try:
        return importlib.import_module("av")
    except ModuleNotFoundError as error:
        raise MissingExtraError("av", "video") from error


def write_video(motion: Motion, file: Path, film: Film, progress: Callable[[int, int], None] | None = None) -> None:
    """Write a film of a motion.

    Args:
        motion: what was recorded.
        file: MP4 file to write.
        film: how it is made.
        progress: is told after each picture how many there are, and how many there will be.

    Raises:
        MissingExtraError: the package that writes films is not installed.
        OSError: the file cannot be written.
    """
    av = load_av()
    shot = shoot(motion, film.angle, film.times(motion.end))
    with (
        av.open(str(file), "w", options={"movflags": "faststart"}) as container,
        _pictures(shot, film.picture) as images,
    ):
        stream = container.add_stream("libx264", rate=film.frames_per_second, options={"crf": _QUALITY})
        stream.width, stream.height, stream.pix_fmt = film.picture.width, film.picture.height, "yuv420p"
        for number, image in enumerate(images, start=1):
            labelled = _labelled(image, _clock(float(shot.poses.time[number - 1]), film.slower))
            container.mux(stream.encode(av.VideoFrame.from_ndarray(labelled, format="rgb24")))
            if progress is not None:
                progress(number, len(shot.poses))
        container.mux(stream.encode())


@contextmanager
def _pictures(shot: Shot, picture: Picture) -> Iterator[Iterator[Image]]:
    """Give the pictures of a shot one after the other, drawn by as many processes as there are cores."""
    numbers = range(len(shot.poses))
    if len(numbers) < _FEWEST_FOR_PROCESSES:
        with Scene(shot, picture) as scene:
            yield map(scene.image, numbers)
        return
    pool = ProcessPoolExecutor(os.cpu_count(), get_context("spawn"), _open_scene, (shot, picture))
    try:
        yield pool.map(_image, numbers)
    finally:
        pool.shutdown(cancel_futures=True)


_scenes: list[Scene] = []
"""The one scene of a process that draws for another one."""


def _open_scene(shot: Shot, picture: Picture) -> None:
    _scenes.append(Scene(shot, picture))


def _image(number: int) -> Image:
    return _scenes[0].image(number)


def _clock(time: float, slower: float) -> str:
    """Return the words for a time of the run (s) in a film that is slower than the run."""
    if slower == 1.0:
        return f"{time:.2f} s"
    return f"{time:.2f} s    {slower:g} × slower" if slower > 1.0 else f"{time:.2f} s    {1.0 / slower:g} × faster"


def _labelled(image: Image, text: str) -> Image:
    """Return a picture with a text in its upper left corner."""
    drawn = Pillow.fromarray(image)
    height = max(10, image.shape[0] // 28)
    font = ImageFont.truetype(findfont("DejaVu Sans"), height)
    ImageDraw.Draw(drawn).text((height, height), text, fill=(60, 60, 60), font=font)
    return np.asarray(drawn)
