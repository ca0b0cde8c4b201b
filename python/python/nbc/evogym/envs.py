"""Evolution Gym's tasks as environments of gymnasium: one robot, or many at once.

``gymnasium.make("nbc/Walker-v0", body=body)`` makes `TaskEnv`, ``TaskVectorEnv("Walker-v0", bodies)`` many. Names,
observations, rewards and ends are Evolution Gym's.
"""

from __future__ import annotations

from typing import Any, Dict, List, Optional, Sequence, Tuple

import gymnasium as gym
import numpy as np
import numpy.typing as npt
from gymnasium import spaces
from gymnasium.vector import AutoresetMode, VectorEnv

from ..numbers import array_of
from .picture import draw
from .tasks import TASKS, TaskWorlds, task_of
from .sim import EvoSim
from .world import EvoWorld

__all__ = ["EvoGymBase", "TaskEnv", "TaskVectorEnv", "register_tasks"]

_Array = npt.NDArray[Any]


class TaskEnv(gym.Env):
    """A task with one robot.

    >>> import gymnasium, numpy as np
    >>> env = gymnasium.make("nbc/Walker-v0", body=np.array([[3, 3, 3], [3, 0, 3]]))
    >>> observation, info = env.reset(seed=1)
    >>> observation, reward, terminated, truncated, info = env.step(np.full(5, 1.2))
    """

    metadata = {"render_modes": ["rgb_array", "img"], "render_fps": 50}

    def __init__(
        self,
        task: str,
        body: npt.ArrayLike,
        connections: Optional[npt.ArrayLike] = None,
        render_mode: Optional[str] = None,
        render_options: Optional[Dict[str, Any]] = None,
    ) -> None:
        """Puts a robot into the world of a task.

        Args:
            task: the name of the task.
            body: the structure of the robot, shape (H, W).
            connections: its connections, or None if all neighbors are joined.
            render_mode: ``"rgb_array"`` (or Evolution Gym's ``"img"``) to draw pictures.
            render_options: arguments of `draw`, such as ``{"hide_grid": True}``.
        """
        self.task = task_of(task)
        self.world = self.task.make_world(body, connections)
        self._worlds = TaskWorlds(self.task, [self.world])
        self.render_mode, self._options = render_mode, dict(render_options or {})
        self.action_space = spaces.Box(0.6, 1.6, (int(self._worlds.actuators[0]),), np.float64)
        self.observation_space = spaces.Box(-100.0, 100.0, (self._worlds.observe().shape[1],), np.float64)

    def step(self, action: npt.ArrayLike) -> Tuple[_Array, float, bool, bool, Dict[str, Any]]:
        """Simulates an env step with a target for each actuator."""
        reward, done = self._worlds.step(action)
        return self._worlds.observe()[0], float(reward[0]), bool(done[0]), False, {}

    def reset(
        self, *, seed: Optional[int] = None, options: Optional[Dict[str, Any]] = None
    ) -> Tuple[_Array, Dict[str, Any]]:
        """Goes back to the start. ``options={"goals": [...]}`` sets the goals of BidirectionalWalker-v0, or by how many
        voxels the package of Catcher-v0 begins to the right of its usual place and above it."""
        super().reset(seed=seed)
        self._worlds.reset([0], self.np_random, (options or {}).get("goals"))
        return self._worlds.observe()[0], {}

    def render(self) -> Optional[_Array]:
        """The world around the robot as a picture, shape (height, width, 3)."""
        if self.render_mode is None:
            return None
        return draw(self._worlds.scenes, 0, self._worlds.worlds[0], **self._options)

    def close(self) -> None:
        """Frees the simulation."""
        self._worlds.scenes.close()


class TaskVectorEnv(VectorEnv):
    """A task with many different robots, simulated at once.

    Observations and actions have as many values as the robot with the most. A robot with fewer points observes zeros
    in their place, and the last targets of one with fewer actuators are ignored; `actuators` has their numbers.
    """

    def __init__(
        self,
        task: str,
        bodies: Sequence[npt.ArrayLike],
        autoreset_mode: AutoresetMode = AutoresetMode.NEXT_STEP,
    ) -> None:
        """Puts each robot into a world of its own.

        Args:
            task: the name of the task.
            bodies: the structures of the robots.
            autoreset_mode: when a world that ended is reset: by the next step, or by the same one, whose info then has
                the last observations as ``final_obs``.
        """
        if autoreset_mode not in (AutoresetMode.NEXT_STEP, AutoresetMode.SAME_STEP):
            raise ValueError(f"autoreset_mode is {autoreset_mode}, expected NEXT_STEP or SAME_STEP")
        self.metadata = {"autoreset_mode": autoreset_mode}
        self._is_same_step = autoreset_mode == AutoresetMode.SAME_STEP
        self.task = task_of(task)
        self._worlds = TaskWorlds(self.task, [self.task.make_world(body) for body in bodies])
        self.actuators: npt.NDArray[np.int64] = self._worlds.actuators
        self.num_envs = len(self._worlds)
        most = int(self.actuators.max())
        self._is_used = np.arange(most) < self.actuators[:, None]
        self.single_action_space = spaces.Box(0.6, 1.6, (most,), np.float64)
        self.single_observation_space = spaces.Box(-100.0, 100.0, (self._worlds.observe().shape[1],), np.float64)
        self.action_space = gym.vector.utils.batch_space(self.single_action_space, self.num_envs)
        self.observation_space = gym.vector.utils.batch_space(self.single_observation_space, self.num_envs)
        self._steps = np.zeros(self.num_envs, dtype=np.int64)
        self._ended = np.zeros(self.num_envs, dtype=bool)

    def reset(
        self, *, seed: Any = None, options: Optional[Dict[str, Any]] = None
    ) -> Tuple[_Array, Dict[str, Any]]:
        """Puts all robots back to their start."""
        super().reset(seed=seed)
        self._worlds.reset(range(self.num_envs), self.np_random, (options or {}).get("goals"))
        self._steps[:], self._ended[:] = 0, False
        return self._worlds.observe(), {}

    def step(self, actions: npt.ArrayLike) -> Tuple[_Array, _Array, _Array, _Array, Dict[str, Any]]:
        """Simulates an env step with a row of targets for each robot."""
        targets = np.asarray(array_of(actions), dtype=np.float64)
        if targets.shape != self._is_used.shape:
            raise ValueError(f"the actions have the shape {targets.shape}, expected {self._is_used.shape}")
        resets = self._ended
        reward, terminated = self._worlds.step(targets[self._is_used])
        self._steps += 1
        if resets.any():
            self._worlds.reset(np.flatnonzero(resets).tolist(), self.np_random)
            reward[resets], terminated[resets], self._steps[resets] = 0.0, False, 0
        truncated = ~terminated & (self._steps >= self.task.steps)
        ended, observed, info = terminated | truncated, self._worlds.observe(), {}
        if not self._is_same_step:
            self._ended = ended
        elif ended.any():
            final = np.full(self.num_envs, None, dtype=object)
            for n in np.flatnonzero(ended):
                final[n] = observed[n]
            info = {"final_obs": final, "_final_obs": ended}
            self._worlds.reset(np.flatnonzero(ended).tolist(), self.np_random)
            self._steps[ended], observed = 0, self._worlds.observe()
        return observed, reward, terminated, truncated, info

    def close_extras(self, **kwargs: Any) -> None:
        """Frees the simulation."""
        self._worlds.scenes.close()


class EvoGymBase(gym.Env):
    """The base of environments of one's own, with the methods of ``evogym.envs.EvoGymBase``. Lengths are in voxels."""

    metadata = {"render_modes": ["rgb_array", "img"], "render_fps": 50}

    def __init__(
        self, world: EvoWorld, render_mode: Optional[str] = None, render_options: Optional[Dict[str, Any]] = None
    ) -> None:
        self._world, self._sim = world.copy(), EvoSim(world)
        self.render_mode, self._options = render_mode, dict(render_options or {})

    @property
    def sim(self) -> EvoSim:
        """The simulation."""
        return self._sim

    def step(self, action: Dict[str, npt.ArrayLike]) -> bool:  # type: ignore[override]
        """Simulates an env step with the targets of each robot by its name, clipped to 0.6 to 1.6. Returns whether a
        robot became unstable."""
        for name, targets in action.items():
            self._sim.set_action(name, np.clip(np.asarray(array_of(targets), dtype=np.float64), 0.6, 1.6))
        return self._sim.step()

    def reset(  # type: ignore[override]
        self, *, seed: Optional[int] = None, options: Optional[Dict[str, Any]] = None
    ) -> None:
        """Goes back to the start."""
        super().reset(seed=seed)
        self._sim.reset()

    def render(self) -> Optional[_Array]:
        """The world as a picture, shape (height, width, 3)."""
        return None if self.render_mode is None else draw(self._sim._scenes, 0, self._world, **self._options)

    def get_time(self) -> int:
        """Env steps since the start."""
        return self._sim.get_time()

    def get_actuator_indices(self, robot_name: str) -> _Array:
        """The places of a robot's actuators in its flattened structure."""
        return self._sim.get_actuator_indices(robot_name)

    def get_dim_action_space(self, robot_name: str) -> int:
        """The number of a robot's actuators."""
        return self._sim.get_dim_action_space(robot_name)

    def object_pos_at_time(self, time: int, object_name: str) -> _Array:
        """The positions of an object's points, shape (2, P)."""
        return self._sim.object_pos_at_time(time, object_name)

    def object_vel_at_time(self, time: int, object_name: str) -> _Array:
        """The velocities of an object's points, shape (2, P)."""
        return self._sim.object_vel_at_time(time, object_name)

    def object_orientation_at_time(self, time: int, object_name: str) -> float:
        """How far an object has turned since the start."""
        return self._sim.object_orientation_at_time(time, object_name)

    def get_pos_com_obs(self, object_name: str) -> _Array:
        """The center of mass of an object."""
        center: _Array = self.object_pos_at_time(self.get_time(), object_name).mean(axis=1)
        return center

    def get_vel_com_obs(self, object_name: str) -> _Array:
        """The velocity of an object's center of mass."""
        speed: _Array = self.object_vel_at_time(self.get_time(), object_name).mean(axis=1)
        return speed

    def get_relative_pos_obs(self, object_name: str) -> _Array:
        """The points of an object from its center of mass: first x, then y."""
        points = self.object_pos_at_time(self.get_time(), object_name)
        relative: _Array = (points - points.mean(axis=1, keepdims=True)).ravel()
        return relative

    def get_ort_obs(self, object_name: str) -> _Array:
        """How far an object has turned, shape (1,)."""
        return np.array([self.object_orientation_at_time(self.get_time(), object_name)])


def register_tasks() -> None:
    """Makes the tasks known to gymnasium; done when this module is imported."""
    known: List[str] = list(gym.registry)
    for name, task in TASKS.items():
        if f"nbc/{name}" not in known:
            made = "nbc.evogym.envs:TaskEnv"
            gym.register(f"nbc/{name}", entry_point=made, max_episode_steps=task.steps, kwargs={"task": name})


register_tasks()
