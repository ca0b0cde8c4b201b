"""Pictures of worlds as arrays, without a display, and films of them."""

from __future__ import annotations

import os
from typing import Any, Iterable, NamedTuple, Optional, Tuple, Union

import numpy as np
import numpy.typing as npt

from ..numbers import amount, array_of, count
from .sim import Scenes
from .world import EvoWorld

__all__ = ["draw", "save_gif"]

# Rigid, soft, horizontal and vertical actuator, fixed.
_COLORS = np.array(
    [[38, 38, 38], [180, 190, 200], [230, 125, 60], [80, 150, 210], [120, 110, 100]], dtype=np.float64
)
_SKY, _GRID, _EDGE = np.array([255, 251, 240.0]), np.array([238, 233, 220.0]), np.array([25, 25, 25.0])


def draw(
    scenes: Scenes,
    scene: int,
    world: EvoWorld,
    *,
    width: int = 640,
    height: int = 360,
    view: float = 32.0,
    follow: str = "robot",
    hide_background: bool = False,
    hide_grid: bool = False,
    hide_edges: bool = False,
    hide_voxels: bool = False,
) -> npt.NDArray[np.uint8]:
    """A world as a picture, shape (height, width, 3).

    Args:
        scenes: the simulation.
        scene: the number of the world in it.
        world: its objects.
        width, height: pixels.
        view: the voxels across.
        follow: the object that is in the middle.
        hide_background, hide_grid, hide_edges, hide_voxels: what is not drawn.
    """
    pixels = count(width, "width", 1, 10_000), count(height, "height", 1, 10_000)
    across = amount(view, "view", 1e-6, 1e6)
    if follow in world.objects:
        middle = scenes.points([scene], follow)[0].mean(axis=0)
    else:
        middle = np.array([across / 2, across / 4])
    corner = (float(middle[0]) - across / 2, float(middle[1]) - pixels[1] * across / pixels[0] / 2.5)
    hidden = Hidden(hide_background, hide_grid, hide_edges, hide_voxels)
    return paint(scenes, scene, world, corner, pixels[0] / across, pixels, hidden)


class Hidden(NamedTuple):
    """What is not drawn."""

    background: bool = False
    grid: bool = False
    edges: bool = False
    voxels: bool = False


def paint(
    scenes: Scenes,
    scene: int,
    world: EvoWorld,
    corner: Tuple[float, float],
    scale: float,
    size: Tuple[int, int],
    hidden: Hidden,
) -> npt.NDArray[np.uint8]:
    """A part of a world as a picture: from its lower left corner in voxels, with so many pixels for a voxel, and a
    width and a height in pixels."""
    width, height = size
    image = np.empty((height, width, 3), dtype=np.float32)
    image[:] = 255.0 if hidden.background else _SKY
    x = corner[0] + (np.arange(width) + 0.5) / scale
    y = corner[1] + (height - np.arange(height) - 0.5) / scale
    if not hidden.grid:
        image[:, np.mod(x, 1) < 1.2 / scale] = _GRID
        image[np.mod(y, 1) < 1.2 / scale] = _GRID
    for each in world.ordered():
        codes = each.structure[each.structure > 0]
        points = scenes.points([scene], each.name)[0]
        for corners, code in zip(points[scenes.voxels(scene, each.name)], codes):
            color = None if hidden.voxels else _COLORS[code - 1]
            _fill(image, corners, color, not hidden.edges, corner, scale)
    return image.round().astype(np.uint8)


def save_gif(path: Union[str, os.PathLike[str]], pictures: Iterable[npt.NDArray[np.uint8]], fps: float = 50) -> None:
    """Writes pictures as a film that repeats, by Pillow.

    Args:
        path: the file.
        pictures: arrays of one shape (height, width, 3), such as those that ``render`` returns.
        fps: pictures per second. A GIF counts in hundredths of a second, and many programs show at most 50.

    Raises:
        ImportError: where Pillow is not installed.
        ValueError: when there is no picture.
    """
    try:
        from PIL import Image
    except ImportError:
        raise ImportError("Pillow writes films, and is not installed: `pip install pillow`") from None
    path = os.fspath(path)
    frames = [Image.fromarray(array_of(each)) for each in pictures]
    if not frames:
        raise ValueError("the film has no pictures")
    pause = max(1, round(100 / amount(fps, "fps", least=0.01))) * 10
    frames[0].save(path, format="GIF", save_all=True, append_images=frames[1:], duration=pause, loop=0)


def _fill(
    image: npt.NDArray[np.float32],
    corners: npt.NDArray[np.float64],
    color: Optional[npt.NDArray[np.float64]],
    has_edges: bool,
    origin: Tuple[float, float],
    scale: float,
) -> None:
    """Paints a voxel with these corners, given clockwise in voxels. Each pixel is blended by how far inside it is."""
    height, width = image.shape[:2]
    across = (corners[:, 0] - origin[0]) * scale
    down = height - (corners[:, 1] - origin[1]) * scale
    left, right = int(max(np.floor(across.min()) - 1, 0)), int(min(np.ceil(across.max()) + 1, width))
    top, bottom = int(max(np.floor(down.min()) - 1, 0)), int(min(np.ceil(down.max()) + 1, height))
    if left >= right or top >= bottom:
        return
    px, py = np.meshgrid(np.arange(left, right) + 0.5, np.arange(top, bottom) + 0.5)
    inside: Any = np.full(px.shape, np.inf)
    for a in range(4):
        b = (a + 1) % 4
        ex, ey = across[b] - across[a], down[b] - down[a]
        length = max(float(np.hypot(ex, ey)), 1e-9)
        inside = np.minimum(inside, (ex * (py - down[a]) - ey * (px - across[a])) / length)
    part = image[top:bottom, left:right]
    if color is not None:
        share = np.clip(inside + 0.5, 0, 1)[..., None]
        part[:] = part * (1 - share) + color * share
    if has_edges:
        share = 0.6 * np.clip(1 - np.abs(inside - 0.5), 0, 1)[..., None]
        part[:] = part * (1 - share) + _EDGE * share
