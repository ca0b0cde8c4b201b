"""The bases of environments of one's own: `EvoGymBase` counts in voxels, `BenchmarkBase` in meters."""

from __future__ import annotations

from importlib.util import find_spec
from typing import Any, Dict, List, Optional, Sequence

import gymnasium as gym
import numpy as np
import numpy.typing as npt

from ..names import meant
from .sim import VOXEL_SIZE, EvoSim, targets_of
from .viewer import PICTURES, WINDOWS, EvoViewer, RenderMode, check_mode
from .world import DATA_PATH, EvoWorld

__all__ = ["BenchmarkBase", "EvoGymBase", "RENDER_OPTIONS"]

_Floats = npt.NDArray[np.float64]
RENDER_OPTIONS = ("verbose", "hide_background", "hide_grid", "hide_edges", "hide_voxels")


def check_options(options: Optional[Dict[str, Any]], known: Sequence[str]) -> Dict[str, Any]:
    """A copy of render options.

    Raises:
        ValueError: when one is not known.
    """
    if options is not None and not isinstance(options, dict):
        raise TypeError(f"the render options are of type {type(options).__name__}, expected a dictionary")
    for name in options or {}:
        if name not in known:
            raise ValueError(f"there is no render option `{name}`, expected {', '.join(known)}{meant(name, known)}")
    return dict(options or {})


def reset_options(options: Optional[Dict[str, Any]]) -> Dict[str, Any]:
    """The options of a reset.

    Raises:
        TypeError: when they are not a dictionary.
    """
    if options is not None and not isinstance(options, dict):
        raise TypeError(f"the options are of type {type(options).__name__}, expected a dictionary")
    return options or {}


class EvoGymBase(gym.Env):
    """The base of environments of one's own, with the methods of ``evogym.envs.EvoGymBase``. Lengths are in voxels."""

    # Those that can be used here: `check_env` of gymnasium tries them all.
    metadata = {"render_modes": [*(WINDOWS if find_spec("pygame") else ()), *PICTURES], "render_fps": 50}

    def __init__(
        self,
        world: EvoWorld,
        render_mode: Optional[RenderMode] = None,
        render_options: Optional[Dict[str, Any]] = None,
    ) -> None:
        """Simulates a world.

        Args:
            world: the world.
            render_mode: ``"rgb_array"`` or ``"img"`` to draw pictures, ``"human"`` or ``"screen"`` to show each env
                step in a window.
            render_options: ``verbose``, ``hide_background``, ``hide_grid``, ``hide_edges`` and ``hide_voxels``; see
                `EvoViewer.render`.
        """
        self._open(self._simulation(world), render_mode, render_options)

    def _simulation(self, world: EvoWorld) -> EvoSim:
        return EvoSim(world)

    def _open(self, sim: EvoSim, render_mode: Optional[RenderMode], options: Optional[Dict[str, Any]]) -> None:
        if render_mode is not None:
            check_mode(render_mode)
        self._render_mode: Optional[RenderMode] = render_mode
        self.render_mode, self._render_options = render_mode, check_options(options, RENDER_OPTIONS)
        self._sim, self._default_viewer = sim, EvoViewer(sim)

    @property
    def sim(self) -> EvoSim:
        """The simulation."""
        return self._sim

    @property
    def default_viewer(self) -> EvoViewer:
        """The camera of `render`."""
        return self._default_viewer

    def step(self, action: Dict[str, npt.ArrayLike]) -> Any:
        """Simulates an env step with the targets of each robot by its name, clipped to 0.6 to 1.6. Returns whether a
        robot became unstable."""
        if not isinstance(action, dict):
            raise TypeError(f"the action is of type {type(action).__name__}, expected targets by the names of robots")
        for name, targets in action.items():
            self._sim.set_action(name, np.clip(targets_of(targets), 0.6, 1.6))
        is_unstable = self._sim.step()
        self._show()
        return is_unstable

    def reset(self, seed: Optional[int] = None, options: Optional[Dict[str, Any]] = None) -> Any:
        """Goes back to the start."""
        super().reset(seed=seed)
        self._sim.reset()

    def render(self) -> Optional[npt.NDArray[np.uint8]]:
        """The world as a picture, shape (height, width, 3); None without a render mode, and after a window showed
        it."""
        if self._render_mode is None:
            return None
        return self._default_viewer.render(self._render_mode, **self._render_options)

    def close(self) -> None:
        """Closes the window. The simulation can still be used."""
        self._default_viewer.close()

    def _show(self) -> None:
        if self._render_mode in WINDOWS:
            self.render()

    def get_time(self) -> int:
        """Env steps since the start."""
        return self._sim.get_time()

    def get_actuator_indices(self, robot_name: str) -> npt.NDArray[np.int64]:
        """The places of a robot's actuators in its flattened structure."""
        return self._sim.get_actuator_indices(robot_name)

    def get_dim_action_space(self, robot_name: str) -> int:
        """The number of a robot's actuators."""
        return self._sim.get_dim_action_space(robot_name)

    def pos_at_time(self, time: int) -> _Floats:
        """The positions of all points, shape (2, P)."""
        return self._sim.pos_at_time(time)

    def vel_at_time(self, time: int) -> _Floats:
        """The velocities of all points, shape (2, P)."""
        return self._sim.vel_at_time(time)

    def object_pos_at_time(self, time: int, object_name: str) -> _Floats:
        """The positions of an object's points, shape (2, P)."""
        return self._sim.object_pos_at_time(time, object_name)

    def object_vel_at_time(self, time: int, object_name: str) -> _Floats:
        """The velocities of an object's points, shape (2, P)."""
        return self._sim.object_vel_at_time(time, object_name)

    def object_orientation_at_time(self, time: int, object_name: str) -> float:
        """How far an object has turned since the start."""
        return self._sim.object_orientation_at_time(time, object_name)

    def get_pos_com_obs(self, object_name: str) -> _Floats:
        """The center of mass of an object."""
        center: _Floats = self._sim.object_pos_at_time(self.get_time(), object_name).mean(axis=1)
        return center

    def get_vel_com_obs(self, object_name: str) -> _Floats:
        """The velocity of an object's center of mass."""
        speed: _Floats = self._sim.object_vel_at_time(self.get_time(), object_name).mean(axis=1)
        return speed

    def get_relative_pos_obs(self, object_name: str) -> _Floats:
        """The points of an object from its center of mass: first x, then y."""
        points = self._sim.object_pos_at_time(self.get_time(), object_name)
        relative: _Floats = (points - points.mean(axis=1, keepdims=True)).flatten()
        return relative

    def get_ort_obs(self, object_name: str) -> _Floats:
        """How far an object has turned, shape (1,)."""
        return np.array([self.object_orientation_at_time(self.get_time(), object_name)])

    def get_floor_obs(
        self, object_name: str, terrain_list: List[str], sight_dist: int, sight_range: float = 5
    ) -> _Floats:
        """How far the terrain is below an object's center of mass.

        Args:
            object_name: the object.
            terrain_list: the objects that are terrain.
            sight_dist: the columns to the left and to the right of that in the middle.
            sight_range: the most that is seen, and what is said of a column without terrain.

        Returns:
            A distance for each column, shape (2 * sight_dist + 1,).
        """
        return self._depths(object_name, terrain_list, sight_dist, sight_range, above=False)

    def get_ceil_obs(
        self, object_name: str, terrain_list: List[str], sight_dist: int, sight_range: float = 5
    ) -> _Floats:
        """How far the terrain is above an object's center of mass; see `get_floor_obs`."""
        return self._depths(object_name, terrain_list, sight_dist, sight_range, above=True)

    def _depths(self, name: str, terrain: List[str], sight: int, reach: float, above: bool) -> _Floats:
        found: _Floats = self._sim.scenes.surface([0], name, terrain, sight, reach, above)[0].copy()
        return found


class BenchmarkBase(EvoGymBase):
    """The base of the tasks: lengths are in meters, a voxel is 0.1 m, and the camera follows the robot, which is called
    ``robot``. `EvoWorld.of_task` has the worlds of tasks, and `EvoWorld.from_json` reads them as files of
    ``DATA_PATH``."""

    DATA_PATH = DATA_PATH
    VOXEL_SIZE = VOXEL_SIZE

    def _open(self, sim: EvoSim, render_mode: Optional[RenderMode], options: Optional[Dict[str, Any]]) -> None:
        super()._open(sim, render_mode, options)
        self._default_viewer.track_objects("robot")

    def pos_at_time(self, time: int) -> _Floats:
        return super().pos_at_time(time) * self.VOXEL_SIZE

    def vel_at_time(self, time: int) -> _Floats:
        return super().vel_at_time(time) * self.VOXEL_SIZE

    def object_pos_at_time(self, time: int, object_name: str) -> _Floats:
        return super().object_pos_at_time(time, object_name) * self.VOXEL_SIZE

    def object_vel_at_time(self, time: int, object_name: str) -> _Floats:
        return super().object_vel_at_time(time, object_name) * self.VOXEL_SIZE

    def get_pos_com_obs(self, object_name: str) -> _Floats:
        return super().get_pos_com_obs(object_name) * self.VOXEL_SIZE

    def get_vel_com_obs(self, object_name: str) -> _Floats:
        return super().get_vel_com_obs(object_name) * self.VOXEL_SIZE

    def get_relative_pos_obs(self, object_name: str) -> _Floats:
        return super().get_relative_pos_obs(object_name) * self.VOXEL_SIZE

    def _depths(self, name: str, terrain: List[str], sight: int, reach: float, above: bool) -> _Floats:
        return super()._depths(name, terrain, sight, reach, above) * self.VOXEL_SIZE
