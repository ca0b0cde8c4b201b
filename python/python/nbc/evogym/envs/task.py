"""A task of Evolution Gym as an environment."""

from __future__ import annotations

from typing import Any, ClassVar, Dict, Optional, Tuple

import numpy as np
import numpy.typing as npt
from gymnasium import spaces

from ..base import BenchmarkBase, reset_options
from ..sim import EvoSim, targets_of
from ..tasks import TaskWorlds, task_of
from ..viewer import RenderMode
from ..world import EvoWorld

__all__ = ["NamedTask", "TaskEnv"]

_Floats = npt.NDArray[np.float64]


class TaskEnv(BenchmarkBase):
    """A task with one robot. It can be pickled and copied, and goes on from where it is.

    What Evolution Gym's classes keep is here under their names: ``sight_dist`` of tasks that observe terrain, ``goals``
    and ``current_goal`` of BidirectionalWalker-v0, ``num_flips`` of Flipper-v0, ``offsetx`` and ``offsety`` of
    Catcher-v0.

    >>> import gymnasium, numpy as np
    >>> env = gymnasium.make("nbc/Walker-v0", body=np.array([[3, 3, 3], [3, 0, 3]]))
    >>> observation, info = env.reset(seed=1)
    >>> observation, reward, terminated, truncated, info = env.step(np.full(5, 1.2))
    """

    def __init__(
        self,
        task: str,
        body: npt.ArrayLike,
        connections: Optional[npt.ArrayLike] = None,
        render_mode: Optional[RenderMode] = None,
        render_options: Optional[Dict[str, Any]] = None,
    ) -> None:
        """Puts a robot into the world of a task.

        Args:
            task: the name of the task.
            body: the structure of the robot, shape (H, W).
            connections: its connections, or None if all neighbors are joined.
            render_mode, render_options: see `EvoGymBase`.
        """
        self.task = task_of(task)
        self.world = self.task.make_world(body, connections)
        super().__init__(self.world, render_mode, render_options)
        self.action_space = spaces.Box(0.6, 1.6, (int(self._worlds.actuators[0]),), np.float64)
        self.observation_space = spaces.Box(-100.0, 100.0, self._observe().shape, np.float64)

    def _simulation(self, world: EvoWorld) -> EvoSim:
        self._worlds = TaskWorlds(self.task, [world])
        return EvoSim.of(world, self._worlds.scenes)

    def __getattr__(self, name: str) -> Any:
        # A script may set them, too.
        kept = self._worlds.kept() if "_worlds" in self.__dict__ else {}
        if name not in kept:
            raise AttributeError(f"`{type(self).__name__}` has no attribute `{name}`")
        return kept[name]

    def step(  # type: ignore[override]
        self, action: npt.ArrayLike
    ) -> Tuple[_Floats, float, bool, bool, Dict[str, Any]]:
        """Simulates an env step with a target for each actuator, clipped to 0.6 to 1.6."""
        targets = targets_of(action)
        if targets.size != self._worlds.actuators[0]:
            raise ValueError(f"the action has {targets.size} values, expected {self._worlds.actuators[0]}")
        reward, done = self._worlds.step(targets.ravel())
        self._sim.keep()
        self._show()
        return self._observe(), float(reward[0]), bool(done[0]), False, {}

    def reset(
        self, seed: Optional[int] = None, options: Optional[Dict[str, Any]] = None
    ) -> Tuple[_Floats, Dict[str, Any]]:
        """Goes back to the start. ``options={"goals": [...]}`` sets the goals of BidirectionalWalker-v0, or by how many
        voxels the package of Catcher-v0 begins to the right of its usual place and above it."""
        goals = reset_options(options).get("goals")
        super().reset(seed=seed)
        self._worlds.reset([0], [self.np_random], [goals])
        self.world = self._worlds.worlds[0]
        self._sim.follow(self.world, self._worlds.scenes)
        self._show()
        return self._observe(), {}

    def _observe(self) -> _Floats:
        # An array of its own, which a script may resize.
        observed: _Floats = self._worlds.observe()[0].copy()
        return observed


class NamedTask(TaskEnv):
    """A task with a class of its own, as Evolution Gym has them. A subclass may put its robot into a world of its own
    and call ``BenchmarkBase.__init__``: it has the observations and rewards of the task there."""

    TASK: ClassVar[str]
    """The name of the task."""

    def __init__(
        self,
        body: npt.ArrayLike,
        connections: Optional[npt.ArrayLike] = None,
        render_mode: Optional[RenderMode] = None,
        render_options: Optional[Dict[str, Any]] = None,
    ) -> None:
        """Puts a robot into the world; see `TaskEnv`."""
        super().__init__(self.TASK, body, connections, render_mode, render_options)

    def _simulation(self, world: EvoWorld) -> EvoSim:
        self.task = task_of(self.TASK)
        return super()._simulation(world)
