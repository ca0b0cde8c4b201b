"""A task with many robots at once, as a vector environment of gymnasium."""

from __future__ import annotations

from typing import Any, Dict, List, Literal, Optional, Sequence, Tuple, Union

import gymnasium as gym
import numpy as np
import numpy.typing as npt
from gymnasium import spaces
from gymnasium.utils.seeding import np_random
from gymnasium.vector import AutoresetMode, VectorEnv

from ..names import meant
from ..numbers import array_of, count
from .base import RENDER_OPTIONS, check_options, reset_options
from .picture import draw
from .sim import targets_of
from .tasks import TaskWorlds, task_of
from .viewer import PICTURES

__all__ = ["TaskVectorEnv", "make_many"]

_Array = npt.NDArray[Any]
MOST_WORLDS = 100_000
_Autoreset = Union[AutoresetMode, Literal["NextStep", "SameStep", "Disabled"]]


class TaskVectorEnv(VectorEnv):
    """A task with many different robots, simulated at once.

    Observations and actions have as many values as the robot with the most. A robot with fewer points observes zeros
    in their place, and the last targets of one with fewer actuators are ignored; `actuators` has their numbers. It can
    be pickled and copied.

    >>> import numpy as np
    >>> from nbc.evogym.envs import TaskVectorEnv
    >>> many = TaskVectorEnv("Walker-v0", [np.array([[3, 3], [4, 4]]), np.array([[3, 3, 3]])])
    >>> observations, info = many.reset(seed=1)
    >>> many.step(np.ones((2, 4)))[1].shape
    (2,)
    """

    def __init__(
        self,
        task: str,
        bodies: Sequence[npt.ArrayLike],
        autoreset_mode: _Autoreset = AutoresetMode.NEXT_STEP,
        render_mode: Optional[Literal["img", "rgb_array"]] = None,
        render_options: Optional[Dict[str, Any]] = None,
        max_episode_steps: Optional[int] = None,
        connections: Optional[Sequence[Optional[npt.ArrayLike]]] = None,
    ) -> None:
        """Puts each robot into a world of its own.

        Args:
            task: the name of the task.
            bodies: the structures of the robots.
            autoreset_mode: when a world that ended is reset: by the next step, by the same one, whose info then has
                the last observations as ``final_obs``, or by ``reset`` only.
            render_mode: ``"rgb_array"`` or ``"img"`` to draw pictures.
            render_options: what is not drawn: ``hide_background``, ``hide_grid``, ``hide_edges``, ``hide_voxels``.
            max_episode_steps: the env steps after which an episode is truncated; by default those of the task.
            connections: the connections of each robot, or None for a robot whose neighbors are all joined.
        """
        mode = AutoresetMode(autoreset_mode)
        if render_mode is not None and render_mode not in PICTURES:
            expected = ", ".join(map(repr, PICTURES))
            raise ValueError(f"the render mode is {render_mode!r}, expected {expected}{meant(render_mode, PICTURES)}")
        self.metadata = {"autoreset_mode": mode, "render_modes": list(PICTURES), "render_fps": 50}
        self.render_mode, self._options = render_mode, check_options(render_options, RENDER_OPTIONS[1:])
        self._mode, self.task = mode, task_of(task)
        self.max_episode_steps = (
            self.task.steps if max_episode_steps is None else count(max_episode_steps, "max_episode_steps", least=1)
        )
        count(len(bodies), "the number of bodies", least=1, most=MOST_WORLDS)
        joined = [None] * len(bodies) if connections is None else list(connections)
        if len(joined) != len(bodies):
            raise ValueError(f"there are connections of {len(joined)} bodies, expected {len(bodies)}")
        worlds = [self.task.make_world(body, own) for body, own in zip(bodies, joined)]
        self._worlds = TaskWorlds(self.task, worlds)
        self.actuators: npt.NDArray[np.int64] = self._worlds.actuators
        self.num_envs = len(self._worlds)
        most = int(self.actuators.max())
        self._is_used = np.arange(most) < self.actuators[:, None]
        self.single_action_space = spaces.Box(0.6, 1.6, (most,), np.float64)
        self.single_observation_space = spaces.Box(-100.0, 100.0, (self._worlds.observe().shape[1],), np.float64)
        self.action_space = gym.vector.utils.batch_space(self.single_action_space, self.num_envs)
        self.observation_space = gym.vector.utils.batch_space(self.single_observation_space, self.num_envs)
        self._randoms = [np_random(None) for _ in range(self.num_envs)]
        self._goals: List[Optional[Sequence[int]]] = [None] * self.num_envs
        self._steps = np.zeros(self.num_envs, dtype=np.int64)
        self._ended = np.zeros(self.num_envs, dtype=bool)

    @property  # type: ignore[misc]
    def np_random(self) -> Any:
        """The generator of each world."""
        return tuple(random for random, _ in self._randoms)

    @property
    def np_random_seed(self) -> Any:
        """The seed of each world."""
        return tuple(seed for _, seed in self._randoms)

    def reset(
        self,
        *,
        seed: Union[int, Sequence[Optional[int]], None] = None,
        options: Optional[Dict[str, Any]] = None,
    ) -> Tuple[_Array, Dict[str, Any]]:
        """Puts robots back to their start.

        Args:
            seed: a number for the first world, to which that of each other world adds 1, or a list with a seed or None
                for each world. World i is then as `TaskEnv` is with its seed. None goes on with the generators.
            options: ``goals`` are those of all worlds, or a list with the goals or None for each, as in
                `TaskEnv.reset`; worlds that are reset by themselves later keep them. ``reset_mask`` is an array of
                booleans, and worlds where it is False go on.
        """
        options = reset_options(options)
        chosen = self._mask(options.get("reset_mask"))
        goals = self._goals_of(options.get("goals"), chosen)
        randoms = list(self._randoms)
        for n, own in enumerate(self._seeds(seed)):
            if own is not None and chosen[n]:
                randoms[n] = np_random(own)
        before, self._goals, self._randoms = (self._goals, self._randoms), goals, randoms
        try:
            self._restart(chosen)
        except ValueError:
            self._goals, self._randoms = before
            raise
        return self._worlds.observe(), {}

    def step(self, actions: npt.ArrayLike) -> Tuple[_Array, _Array, _Array, _Array, Dict[str, Any]]:
        """Simulates an env step with a row of targets for each robot.

        Raises:
            ValueError: for actions of another shape, and where a world ended that only ``reset`` starts again.
        """
        targets = targets_of(actions)
        if targets.shape != self._is_used.shape:
            raise ValueError(f"the actions have the shape {targets.shape}, expected {self._is_used.shape}")
        resets = self._ended.copy()
        if resets.any() and self._mode == AutoresetMode.DISABLED:
            over = np.flatnonzero(resets).tolist()
            raise ValueError(f"the worlds {over} have ended; `reset` with a `reset_mask` starts them again")
        reward, terminated = self._worlds.step(targets[self._is_used])
        self._steps += 1
        if resets.any():
            self._restart(resets)
            reward[resets], terminated[resets] = 0.0, False
        truncated = ~terminated & (self._steps >= self.max_episode_steps)
        self._ended = terminated | truncated
        observed, info = self._worlds.observe(), {}
        if self._mode == AutoresetMode.SAME_STEP and self._ended.any():
            ended = self._ended.copy()
            final = np.full(self.num_envs, None, dtype=object)
            for n in np.flatnonzero(ended):
                final[n] = observed[n].copy()
            info = {"final_obs": final, "_final_obs": ended, "final_info": {}, "_final_info": ended}
            self._restart(ended)
            observed = self._worlds.observe()
        return observed, reward, terminated, truncated, info

    def render(self) -> Optional[Tuple[npt.NDArray[np.uint8], ...]]:
        """The world around each robot as a picture, shape (height, width, 3)."""
        if self.render_mode is None:
            return None
        worlds = self._worlds
        return tuple(draw(worlds.scenes, n, world, **self._options) for n, world in enumerate(worlds.worlds))

    def close_extras(self, **kwargs: Any) -> None:
        """Frees the simulation."""
        self._worlds.scenes.close()

    def _restart(self, chosen: npt.NDArray[np.bool_]) -> None:
        """Puts the chosen robots back to their start."""
        numbers = np.flatnonzero(chosen).tolist()
        self._worlds.reset(numbers, [self._randoms[n][0] for n in numbers], [self._goals[n] for n in numbers])
        self._steps[chosen], self._ended[chosen] = 0, False

    def _seeds(self, seed: Any) -> Sequence[Optional[int]]:
        if seed is None:
            return [None] * self.num_envs
        if isinstance(seed, (int, np.integer)):
            return [int(seed) + n for n in range(self.num_envs)]
        if len(seed) != self.num_envs:
            raise ValueError(f"there are {len(seed)} seeds, expected {self.num_envs}, one for each world")
        return [None if own is None else count(own, "the seed", most=2**64 - 1) for own in seed]

    def _mask(self, mask: Any) -> npt.NDArray[np.bool_]:
        if mask is None:
            return np.ones(self.num_envs, dtype=bool)
        array = array_of(mask)
        if array.dtype != bool:
            raise TypeError(f"the reset_mask has the dtype {array.dtype}, expected booleans")
        if array.shape != (self.num_envs,):
            raise ValueError(f"the reset_mask has the shape {array.shape}, expected ({self.num_envs},)")
        if not array.any():
            raise ValueError("the reset_mask has no True, so no world is reset")
        return array.copy()

    def _goals_of(self, goals: Any, chosen: npt.NDArray[np.bool_]) -> List[Optional[Sequence[int]]]:
        """The goals of each world after a reset of the chosen ones."""
        is_of_each = goals is not None and any(own is None or np.ndim(own) for own in goals)
        if is_of_each and len(goals) != self.num_envs:
            raise ValueError(f"there are goals for {len(goals)} worlds, expected {self.num_envs}")
        given = goals if is_of_each else [goals] * self.num_envs
        return [new if chosen[n] else old for n, (new, old) in enumerate(zip(given, self._goals))]


def make_many(
    task: str, num_envs: int, body: npt.ArrayLike, connections: Optional[npt.ArrayLike] = None, **options: Any
) -> TaskVectorEnv:
    """What ``gymnasium.make_vec`` makes: a task with robots of one body.

    Args:
        task: the name of the task.
        num_envs: how many robots there are.
        body: their structure.
        connections: their connections, or None if all neighbors are joined.
        options: the arguments of `TaskVectorEnv`.
    """
    number = count(num_envs, "num_envs", least=1, most=MOST_WORLDS)
    return TaskVectorEnv(task, [body] * number, connections=[connections] * number, **options)
