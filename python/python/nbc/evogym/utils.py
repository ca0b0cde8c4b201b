"""Helpers under the names of ``evogym.utils``: random bodies, and what can be said of a body."""

from __future__ import annotations

import random
from typing import Any, Dict, List, Optional, Tuple

import numpy as np
import numpy.typing as npt

from .exchange import connections

__all__ = [
    "BASELINE_ENV_NAMES",
    "VOXEL_TYPES",
    "draw",
    "get_full_connectivity",
    "get_uniform",
    "has_actuator",
    "hashable",
    "is_connected",
    "sample_robot",
]

VOXEL_TYPES: Dict[str, int] = {"EMPTY": 0, "RIGID": 1, "SOFT": 2, "H_ACT": 3, "V_ACT": 4, "FIXED": 5}
"""The codes of voxels."""

BASELINE_ENV_NAMES: List[str] = [
    f"{name}-v{version}"
    for name, versions in (
        ("Walker", 1), ("BridgeWalker", 1), ("BidirectionalWalker", 1), ("Carrier", 2), ("Pusher", 2), ("Thrower", 1),
        ("Catcher", 1), ("BeamToppler", 1), ("BeamSlider", 1), ("Lifter", 1), ("Climber", 3), ("UpStepper", 1),
        ("DownStepper", 1), ("ObstacleTraverser", 2), ("Hurdler", 1), ("PlatformJumper", 1), ("GapJumper", 1),
        ("Traverser", 1), ("CaveCrawler", 1), ("AreaMaximizer", 1), ("AreaMinimizer", 1), ("WingspanMazimizer", 1),
        ("HeightMaximizer", 1), ("Flipper", 1), ("Jumper", 1), ("Balancer", 2),
    )
    for version in range(versions)
]
"""The names of Evolution Gym's tasks; `nbc.evogym.TASKS` has those that are here."""


def get_uniform(x: int) -> npt.NDArray[np.float64]:
    """A uniform distribution over ``x`` values."""
    if x <= 0:
        raise ValueError(f"x is {x}, expected a positive number")
    return np.full(x, 1 / x)


def draw(pd: npt.ArrayLike) -> int:
    """A number drawn from a distribution, which need not add up to 1, by Python's ``random``."""
    weights = np.asarray(pd, dtype=float)
    if weights.size == 0 or (weights < 0).any() or weights.sum() <= 0:
        raise ValueError(f"the distribution is {weights.tolist()}, expected weights from 0 on, not all 0")
    drawn, total = random.uniform(0, 1), 0.0
    for value, share in enumerate(weights / weights.sum()):
        total += share
        if drawn <= total:
            return value
    return int(np.flatnonzero(weights)[-1])


def sample_robot(
    robot_shape: Tuple[int, int], pd: Optional[npt.ArrayLike] = None
) -> Tuple[npt.NDArray[np.float64], npt.NDArray[np.int64]]:
    """A random body in one piece with an actuator, and its connections. With the same ``random.seed`` it is Evolution
    Gym's.

    Args:
        robot_shape: rows and columns.
        pd: the weights of the five codes; by default 0.6 for empty and 0.2 for the others.
    """
    weights = np.array([0.6, 0.2, 0.2, 0.2, 0.2]) if pd is None else np.asarray(pd, dtype=float)
    if weights.shape != (5,):
        raise ValueError(f"pd has the shape {weights.shape}, expected (5,)")
    if weights[3] + weights[4] <= 0:
        raise ValueError("pd gives no actuator")
    if min(robot_shape) < 1:
        raise ValueError(f"robot_shape is {tuple(robot_shape)}, expected at least one row and one column")
    while True:
        robot = np.zeros(robot_shape)
        for place in np.ndindex(*robot_shape):
            robot[place] = draw(weights)
        if is_connected(robot) and has_actuator(robot):
            return robot, get_full_connectivity(robot)


def is_connected(robot: npt.NDArray[Any]) -> bool:
    """Whether a body has a voxel and all its voxels are joined by their sides."""
    left = {(int(row), int(column)) for row, column in np.argwhere(np.asarray(robot) != 0)}
    if not left:
        return False
    open_places = [left.pop()]
    while open_places:
        row, column = open_places.pop()
        for place in ((row - 1, column), (row + 1, column), (row, column - 1), (row, column + 1)):
            if place in left:
                left.remove(place)
                open_places.append(place)
    return not left


def has_actuator(robot: npt.NDArray[Any]) -> bool:
    """Whether a body has an actuator."""
    return bool(np.isin(robot, (3, 4)).any())


def get_full_connectivity(robot: npt.NDArray[Any]) -> npt.NDArray[np.int64]:
    """The connections of all neighbors, shape (2, edges)."""
    return connections(np.asarray(robot))


def hashable(robot: npt.NDArray[Any]) -> str:
    """The codes of a body as a text."""
    return "".join(str(int(code)) for code in np.asarray(robot).flat)
