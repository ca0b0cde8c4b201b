"""A camera for a simulation, under the name of ``evogym``: `EvoViewer` draws pictures, or shows them in a window."""

from __future__ import annotations

import os
import time
from typing import Any, Dict, Literal, Optional, Tuple, Union

import numpy as np
import numpy.typing as npt

from ..names import meant
from ..numbers import real, whole
from .picture import Hidden, paint
from .sim import EvoSim
from .utils import Timer

__all__ = ["EvoViewer", "RenderMode"]

RenderMode = Literal["img", "rgb_array", "human", "screen"]
"""``"img"`` and ``"rgb_array"`` draw pictures, ``"human"`` and ``"screen"`` show them."""

PICTURES, WINDOWS = ("img", "rgb_array"), ("human", "screen")
# The share of its way to the tracked objects that the camera keeps in each env step.
_LAG = 0.95


def check_mode(mode: Any) -> None:
    """Refuses a word that is no render mode."""
    if mode not in PICTURES + WINDOWS:
        expected = ", ".join(map(repr, PICTURES + WINDOWS))
        raise ValueError(f"the render mode is {mode!r}, expected one of {expected}{meant(mode, PICTURES + WINDOWS)}")


class EvoViewer:
    """A camera, with the methods of ``evogym.EvoViewer``. Lengths are in voxels.

    >>> import numpy as np
    >>> from nbc.evogym import EvoSim, EvoViewer, EvoWorld
    >>> world = EvoWorld.of_task("Walker-v0")
    >>> world.add_from_array("robot", np.array([[3, 3], [4, 4]]), 1, 1)
    >>> viewer = EvoViewer(EvoSim(world), resolution=(300, 150))
    >>> viewer.track_objects("robot")
    >>> viewer.render("img").shape
    (150, 300, 3)
    """

    def __init__(
        self,
        sim_to_view: EvoSim,
        target_rps: Optional[int] = 50,
        pos: Tuple[float, float] = (12, 4),
        view_size: Tuple[float, float] = (40, 20),
        resolution: Tuple[int, int] = (1200, 600),
    ) -> None:
        """Looks at a simulation.

        Args:
            sim_to_view: the simulation.
            target_rps: pictures per second in a window; None for as many as there can be. Arrays are drawn at once.
            pos: the middle of what is seen.
            view_size: its width and height.
            resolution: the width and height of pictures in pixels.
        """
        self._sim = sim_to_view
        self._window: Optional[_Window] = None
        self._tracked: Tuple[str, ...] = ()
        self._padding, self._scale = (5.0, 3.0), (0.2, 0.2)
        self._locks: Dict[str, Union[bool, float]] = dict.fromkeys(("x", "y", "width", "height"), False)
        self._seen: Optional[int] = None
        self.set_target_rps(target_rps)
        self.set_pos(pos)
        self.set_view_size(view_size)
        self.set_resolution(resolution)

    def set_pos(self, pos: Tuple[float, float]) -> None:
        """Sets the middle of what is seen."""
        self.pos = _pair(pos, "pos")

    def set_view_size(self, view_size: Tuple[float, float]) -> None:
        """Sets the width and height of what is seen."""
        self.view_size = _pair(view_size, "view_size", least=1e-6)

    def set_resolution(self, resolution: Tuple[int, int]) -> None:
        """Sets the width and height of pictures in pixels."""
        width, height = whole(_pair(resolution, "resolution"), "resolution", least=1, most=10_000).tolist()
        self.resolution = (width, height)

    def set_target_rps(self, target_rps: Optional[int]) -> None:
        """Sets the pictures per second in a window, at least 2; None for as many as there can be."""
        if target_rps is not None and not target_rps > 1:
            raise ValueError(f"target_rps is {target_rps}, expected at least 2, or None")
        self._timer = Timer(target_rps)

    def track_objects(self, *objects: str) -> None:
        """Lets the camera follow objects; without names it stays where it is."""
        for name in objects:
            if name not in self._sim.world.objects:
                raise ValueError(f"the world has no object `{name}`{meant(name, self._sim.world.objects)}")
        self._tracked, self._seen = objects, None

    def set_tracking_settings(self, **settings: Any) -> None:
        """Says how the camera follows objects.

        Args:
            padding: voxels added on both sides of the tracked objects, across and up.
            scale: the share of the width and of the height that is added to that on both sides together.
            lock_x, lock_y, lock_width, lock_height: a number keeps the camera there, False does not.
        """
        for name, value in settings.items():
            if name in ("padding", "scale"):
                setattr(self, f"_{name}", _pair(value, name))
            elif name.startswith("lock_") and name[5:] in self._locks:
                if value is True or not isinstance(value, (bool, int, float)) or not np.isfinite(value):
                    raise ValueError(f"{name} is {value!r}, expected a finite number or False")
                self._locks[name[5:]] = value
            else:
                known = ("padding", "scale", *(f"lock_{each}" for each in self._locks))
                raise ValueError(f"there is no setting `{name}`, expected {', '.join(known)}")
        self._seen = None

    def render(
        self,
        mode: RenderMode = "screen",
        verbose: bool = False,
        hide_background: bool = False,
        hide_grid: bool = False,
        hide_edges: bool = False,
        hide_voxels: bool = False,
    ) -> Optional[npt.NDArray[np.uint8]]:
        """Draws the world of now.

        Args:
            mode: ``"img"`` or ``"rgb_array"`` for an array, ``"human"`` or ``"screen"`` for a window.
            verbose: whether to print how many pictures there are in a second.
            hide_background, hide_grid, hide_edges, hide_voxels: what is not drawn.

        Returns:
            A picture of shape (height, width, 3), or None after it was shown.

        Raises:
            ImportError: for a window, where pygame is not installed.
            RuntimeError: for a window, where there is no display.
            SystemExit: after the window was closed, by its button or by a signal that pygame took.
        """
        check_mode(mode)
        self._track()
        scale = min(self.resolution[0] / self.view_size[0], self.resolution[1] / self.view_size[1])
        corner = (self.pos[0] - self.resolution[0] / scale / 2, self.pos[1] - self.resolution[1] / scale / 2)
        hidden = Hidden(hide_background, hide_grid, hide_edges, hide_voxels)
        picture = paint(self._sim.scenes, 0, self._sim.world, corner, scale, self.resolution, hidden)
        if mode in PICTURES:
            self._timer.step(verbose)
            return picture
        self.show_debug_window()
        assert self._window is not None
        while not self._timer.should_step():
            time.sleep(0.001)
        self._timer.step(verbose)
        self._window.show(picture)
        return None

    def show_debug_window(self) -> None:
        """Opens the window."""
        if self._window is None or self._window.size != self.resolution:
            self.hide_debug_window()
            self._window = _Window(self.resolution)

    def hide_debug_window(self) -> None:
        """Closes the window; the next picture for it opens it again."""
        if self._window is not None:
            self._window.close()
            self._window = None

    def close(self) -> None:
        """Closes the window."""
        self.hide_debug_window()

    def __getstate__(self) -> Dict[str, Any]:
        return {**self.__dict__, "_window": None}

    def _track(self) -> None:
        """Moves the camera for the env steps since the last picture."""
        if not self._tracked:
            return
        now = self._sim.get_time()
        points = np.concatenate([self._sim.object_pos_at_time(now, name) for name in self._tracked], axis=1)
        least, most = points.min(axis=1), points.max(axis=1)
        size = (most - least + 2 * np.array(self._padding)) * (1 + np.array(self._scale))
        wanted = np.array([*(least + most) / 2, *size])
        for place, lock in enumerate(self._locks.values()):
            if lock is not False:
                wanted[place] = lock
        # What is too narrow or too low for the pictures is made wider or higher.
        shape = self.resolution[0] / self.resolution[1]
        wanted[2], wanted[3] = max(wanted[2], wanted[3] * shape), max(wanted[3], wanted[2] / shape)
        kept = 0.0 if self._seen is None or now < self._seen else _LAG ** (now - self._seen)
        camera = kept * np.array([*self.pos, *self.view_size]) + (1 - kept) * wanted
        self.set_pos((float(camera[0]), float(camera[1])))
        self.set_view_size((float(camera[2]), float(camera[3])))
        self._seen = now


class _Window:
    """A window of pygame."""

    def __init__(self, size: Tuple[int, int]) -> None:
        try:
            import pygame
        except ImportError:
            raise ImportError(
                'a window needs pygame, which is not installed: `pip install pygame`; the render mode "rgb_array" '
                "draws pictures without it"
            ) from None
        self.size, self._pygame = size, pygame
        # SIGTERM ends the process; SDL would make an event of it.
        os.environ.setdefault("SDL_NO_SIGNAL_HANDLERS", "1")
        try:
            pygame.display.init()
            self._surface = pygame.display.set_mode(size)
        except pygame.error as error:
            raise RuntimeError(
                f'a window cannot be opened: {error}; the render mode "rgb_array" draws pictures without a display'
            ) from None
        pygame.display.set_caption("nbc")

    def show(self, picture: npt.NDArray[np.uint8]) -> None:
        self._pygame.surfarray.blit_array(self._surface, picture.swapaxes(0, 1))
        self._pygame.display.flip()
        # Looking for events keeps the desktop from taking the window for one that hangs. Others are left to the script.
        if self._pygame.event.get(self._pygame.QUIT):
            self.close()
            raise SystemExit("the window was closed")

    def close(self) -> None:
        self._pygame.display.quit()


def _pair(value: Any, name: str, least: Optional[float] = None) -> Tuple[float, float]:
    """Two numbers."""
    if not isinstance(value, tuple):
        raise TypeError(f"{name} is of type {type(value).__name__}, expected a tuple of two numbers")
    if len(value) != 2:
        raise TypeError(f"{name} has {len(value)} values, expected two")
    first, second = real(value, name).tolist()
    if not np.isfinite([first, second]).all() or (least is not None and min(first, second) < least):
        raise ValueError(f"{name} is {value}, expected finite numbers{'' if least is None else ' above 0'}")
    return first, second
