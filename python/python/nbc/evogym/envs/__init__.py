"""Evolution Gym's tasks as environments of gymnasium: one robot, or many at once.

``gymnasium.make("nbc/Walker-v0", body=body)`` makes `TaskEnv`, ``TaskVectorEnv("Walker-v0", bodies)`` many. After the
import of this module ``"Walker-v0"`` is known, too, unless Evolution Gym has made it. Names, observations, rewards and
ends are Evolution Gym's, and so are the names of the classes: `WalkingFlat` is Walker-v0.
"""

from __future__ import annotations

from typing import Any, ClassVar, Dict, Optional, Tuple

import numpy as np
import numpy.typing as npt
from gymnasium import spaces

from ... import evogym
from ...evogym import *  # noqa: F403
from ...registration import register_tasks
from ..base import BenchmarkBase, EvoGymBase, reset_options
from ..sim import EvoSim, targets_of
from ..tasks import TaskWorlds, task_of
from ..vector import TaskVectorEnv, make_many
from ..viewer import RenderMode
from ..world import EvoWorld

_Floats = npt.NDArray[np.float64]


class TaskEnv(BenchmarkBase):
    """A task with one robot. It can be pickled and copied, and goes on from where it is.

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
        self._worlds = TaskWorlds(self.task, [self.task.make_world(body, connections)])
        self._open(EvoSim.of(self.world, self._worlds.scenes), render_mode, render_options)
        self.action_space = spaces.Box(0.6, 1.6, (int(self._worlds.actuators[0]),), np.float64)
        self.observation_space = spaces.Box(-100.0, 100.0, self._observe().shape, np.float64)

    @property
    def world(self) -> EvoWorld:
        """The world with the robot."""
        return self._worlds.worlds[0]

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
        self._sim.follow(self.world, self._worlds.scenes)
        self._show()
        return self._observe(), {}

    def _observe(self) -> _Floats:
        # An array of its own, which a script may resize.
        observed: _Floats = self._worlds.observe()[0].copy()
        return observed


class NamedTask(TaskEnv):
    """A task with a class of its own, as Evolution Gym has them."""

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


class WalkingFlat(NamedTask):
    """Walker-v0."""

    TASK = "Walker-v0"


class SoftBridge(NamedTask):
    """BridgeWalker-v0."""

    TASK = "BridgeWalker-v0"


class Duck(NamedTask):
    """CaveCrawler-v0."""

    TASK = "CaveCrawler-v0"


class StationaryJump(NamedTask):
    """Jumper-v0."""

    TASK = "Jumper-v0"


class Flipping(NamedTask):
    """Flipper-v0."""

    TASK = "Flipper-v0"


class Balance(NamedTask):
    """Balancer-v0."""

    TASK = "Balancer-v0"


class BalanceJump(NamedTask):
    """Balancer-v1."""

    TASK = "Balancer-v1"


class StepsUp(NamedTask):
    """UpStepper-v0."""

    TASK = "UpStepper-v0"


class StepsDown(NamedTask):
    """DownStepper-v0."""

    TASK = "DownStepper-v0"


class WalkingBumpy(NamedTask):
    """ObstacleTraverser-v0."""

    TASK = "ObstacleTraverser-v0"


class WalkingBumpy2(NamedTask):
    """ObstacleTraverser-v1."""

    TASK = "ObstacleTraverser-v1"


class VerticalBarrier(NamedTask):
    """Hurdler-v0."""

    TASK = "Hurdler-v0"


class Gaps(NamedTask):
    """GapJumper-v0."""

    TASK = "GapJumper-v0"


class FloatingPlatform(NamedTask):
    """PlatformJumper-v0."""

    TASK = "PlatformJumper-v0"


class BlockSoup(NamedTask):
    """Traverser-v0."""

    TASK = "Traverser-v0"


class LiftSmallRect(NamedTask):
    """Lifter-v0."""

    TASK = "Lifter-v0"


class CarrySmallRect(NamedTask):
    """Carrier-v0."""

    TASK = "Carrier-v0"


class CarrySmallRectToTable(NamedTask):
    """Carrier-v1."""

    TASK = "Carrier-v1"


class PushSmallRect(NamedTask):
    """Pusher-v0."""

    TASK = "Pusher-v0"


class PushSmallRectOnOppositeSide(NamedTask):
    """Pusher-v1."""

    TASK = "Pusher-v1"


class ToppleBeam(NamedTask):
    """BeamToppler-v0."""

    TASK = "BeamToppler-v0"


class SlideBeam(NamedTask):
    """BeamSlider-v0."""

    TASK = "BeamSlider-v0"


class ThrowSmallRect(NamedTask):
    """Thrower-v0."""

    TASK = "Thrower-v0"


class CatchSmallRect(NamedTask):
    """Catcher-v0."""

    TASK = "Catcher-v0"


class MaximizeShape(NamedTask):
    """AreaMaximizer-v0."""

    TASK = "AreaMaximizer-v0"


class MinimizeShape(NamedTask):
    """AreaMinimizer-v0."""

    TASK = "AreaMinimizer-v0"


class MaximizeXShape(NamedTask):
    """WingspanMazimizer-v0."""

    TASK = "WingspanMazimizer-v0"


class MaximizeYShape(NamedTask):
    """HeightMaximizer-v0."""

    TASK = "HeightMaximizer-v0"


class Climb0(NamedTask):
    """Climber-v0."""

    TASK = "Climber-v0"


class Climb1(NamedTask):
    """Climber-v1."""

    TASK = "Climber-v1"


class Climb2(NamedTask):
    """Climber-v2."""

    TASK = "Climber-v2"


class BiWalk(NamedTask):
    """BidirectionalWalker-v0."""

    TASK = "BidirectionalWalker-v0"


__all__ = [
    "Balance",
    "BalanceJump",
    "BenchmarkBase",
    "BiWalk",
    "BlockSoup",
    "CarrySmallRect",
    "CarrySmallRectToTable",
    "CatchSmallRect",
    "Climb0",
    "Climb1",
    "Climb2",
    "Duck",
    "EvoGymBase",
    "Flipping",
    "FloatingPlatform",
    "Gaps",
    "LiftSmallRect",
    "MaximizeShape",
    "MaximizeXShape",
    "MaximizeYShape",
    "MinimizeShape",
    "NamedTask",
    "PushSmallRect",
    "PushSmallRectOnOppositeSide",
    "SlideBeam",
    "SoftBridge",
    "StationaryJump",
    "StepsDown",
    "StepsUp",
    "TaskEnv",
    "TaskVectorEnv",
    "ThrowSmallRect",
    "ToppleBeam",
    "VerticalBarrier",
    "WalkingBumpy",
    "WalkingBumpy2",
    "WalkingFlat",
    "make_many",
    "register_tasks",
]

# As `from evogym.envs import *` has those of ``evogym``, too.
__all__ += evogym.__all__

register_tasks()
# As after `import evogym.envs`; where that comes first or later, these names are Evolution Gym's own.
register_tasks(namespace="")
