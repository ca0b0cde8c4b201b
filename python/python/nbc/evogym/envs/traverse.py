"""The names of ``evogym.envs.traverse``."""

from __future__ import annotations

from typing import Any, Dict, Optional, Tuple

import numpy as np
import numpy.typing as npt

from .base import *
from .base import __all__ as _base
from .task import NamedTask

__all__ = [
    "BlockSoup",
    "FloatingPlatform",
    "Gaps",
    "StairsBase",
    "StepsDown",
    "StepsUp",
    "VerticalBarrier",
    "WalkingBumpy",
    "WalkingBumpy2",
    *_base,
]


class StairsBase(BenchmarkBase):
    """The base of environments of one's own in which a robot walks over a ground that it sees. The tasks here do not
    inherit it."""

    sight_dist: int = 5
    """The columns to the left and to the right of that in the middle that the robot sees."""

    def get_reward(self, robot_pos_init: npt.NDArray[np.float64], robot_pos_final: npt.NDArray[np.float64]) -> float:
        """How far to the right the robot came between two positions of its points, shape (2, P)."""
        return float(robot_pos_final[0].mean() - robot_pos_init[0].mean())

    def reset(self, seed: Optional[int] = None, options: Optional[Dict[str, Any]] = None) -> Tuple[Any, Dict[str, Any]]:
        """Goes back to the start, and observes velocity, turn, points and ground."""
        super().reset(seed=seed, options=options)
        parts = (self.get_vel_com_obs, self.get_ort_obs, self.get_relative_pos_obs)
        seen = [part("robot") for part in parts] + [self.get_floor_obs("robot", ["ground"], self.sight_dist)]
        return np.concatenate(seen), {}


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


class FloatingPlatform(NamedTask):
    """PlatformJumper-v0."""

    TASK = "PlatformJumper-v0"


class Gaps(NamedTask):
    """GapJumper-v0."""

    TASK = "GapJumper-v0"


class BlockSoup(NamedTask):
    """Traverser-v0."""

    TASK = "Traverser-v0"
