"""Helpers under the names of ``evogym.utils``: random bodies, and what can be said of a body."""

from __future__ import annotations

import operator
import random
import time
from bisect import bisect_left
from itertools import accumulate
from typing import Any, Callable, Dict, List, NamedTuple, Optional, Tuple, Union

import numpy as np
import numpy.typing as npt

from ..numbers import amount, array_of, count, real, whole
from .exchange import connections

__all__ = [
    "BASELINE_ENV_NAMES",
    "VOXEL_TYPES",
    "Pair",
    "Timer",
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


MOST_DRAWN = 300_000
"""The voxels that `sample_robot` draws before it gives up."""


def get_uniform(x: int) -> npt.NDArray[np.float64]:
    """A uniform distribution over ``x`` values."""
    size = count(x, "x", least=1)
    return np.full(size, 1 / size)


def draw(pd: npt.ArrayLike) -> int:
    """A number drawn from a distribution, which need not add up to 1, by Python's ``random``."""
    return _drawn(_sums(real(pd, "the distribution")))


def _sums(weights: npt.NDArray[np.float64]) -> List[float]:
    """The sums of a distribution up to each value."""
    if weights.size == 0 or not (weights >= 0).all() or not 0 < weights.sum() < np.inf:
        raise ValueError(f"the distribution is {weights.tolist()}, expected weights from 0 on, not all 0")
    shares = (weights / weights.sum()).ravel().tolist()
    sums = list(accumulate(shares))
    # What rounding leaves belongs to the last value that has a weight.
    return sums[: max(n for n, share in enumerate(shares) if share > 0)] + [1.0]


def _drawn(sums: List[float]) -> int:
    return bisect_left(sums, random.uniform(0, 1))


def sample_robot(
    robot_shape: Tuple[int, int], pd: Optional[npt.ArrayLike] = None
) -> Tuple[npt.NDArray[np.float64], npt.NDArray[np.int64]]:
    """A random body in one piece with an actuator, and its connections. With the same ``random.seed`` it is Evolution
    Gym's.

    Args:
        robot_shape: rows and columns.
        pd: the weights of the codes 0 to 4, or 0 to 5 with fixed voxels; by default 0.6 for empty and 0.2 for the
            others.

    Raises:
        ValueError: for wrong arguments, and when no body in one piece is found after `MOST_DRAWN` drawn voxels, because
            the shape is too large for so many empty ones.
    """
    weights = np.array([0.6, 0.2, 0.2, 0.2, 0.2]) if pd is None else real(pd, "pd")
    if weights.shape not in ((5,), (6,)):
        raise ValueError(f"pd has the shape {weights.shape}, expected (5,), or (6,) with fixed voxels")
    if weights[3] + weights[4] <= 0:
        raise ValueError("pd gives no actuator")
    rows, columns = (count(side, "a side of robot_shape", least=1, most=1000) for side in robot_shape)
    sums = _sums(weights)
    for _ in range(1 + MOST_DRAWN // (rows * columns)):
        robot = np.zeros((rows, columns))
        for place in np.ndindex(rows, columns):
            robot[place] = _drawn(sums)
        if is_connected(robot) and has_actuator(robot):
            return robot, get_full_connectivity(robot)
    raise ValueError(f"no body of the shape ({rows}, {columns}) in one piece was found; give fewer empty voxels in pd")


def is_connected(robot: npt.NDArray[Any]) -> bool:
    """Whether a body has a voxel and all its voxels are joined by their sides."""
    left = {(int(row), int(column)) for row, column in np.argwhere(array_of(robot) != 0)}
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
    return bool(np.isin(array_of(robot), (3, 4)).any())


def get_full_connectivity(robot: npt.NDArray[Any]) -> npt.NDArray[np.int64]:
    """The connections of all neighbors, shape (2, edges)."""
    return connections(array_of(robot))


def hashable(robot: npt.NDArray[Any]) -> str:
    """The codes of a body as a text."""
    return "".join(map(str, whole(robot, "the robot").flat))


class Pair(NamedTuple):
    """Two whole numbers, such as a column and a row. Sums, differences, products, quotients and remainders are those of
    each number, with another pair or with one number. Unlike Evolution Gym's it is a tuple, so it cannot be changed.

    >>> Pair(3, 1) + Pair(1, 1), Pair(5, 4) // 2, Pair(2, 2) == 2
    (Pair(4, 2), Pair(2, 2), True)
    """

    x: int
    """The first."""
    y: int
    """The second."""

    def __add__(self, other: Union[Pair, int]) -> Pair:  # type: ignore[override]
        return self._with(other, operator.add)

    def __sub__(self, other: Union[Pair, int]) -> Pair:
        return self._with(other, operator.sub)

    def __mul__(self, other: Union[Pair, int]) -> Pair:  # type: ignore[override]
        return self._with(other, operator.mul)

    def __floordiv__(self, other: Union[Pair, int]) -> Pair:
        return self._with(other, operator.floordiv)

    def __truediv__(self, other: Union[Pair, int]) -> Pair:
        return self // other

    def __mod__(self, other: Union[Pair, int]) -> Pair:
        return self._with(other, operator.mod)

    def __eq__(self, other: object) -> bool:
        return tuple(self) == ((other, other) if isinstance(other, int) else other)

    def __ne__(self, other: object) -> bool:
        return not self == other

    def __hash__(self) -> int:
        return hash(tuple(self))

    def __repr__(self) -> str:
        return f"Pair({self.x}, {self.y})"

    def abs(self) -> Pair:
        """Both without their signs."""
        return Pair(abs(self.x), abs(self.y))

    def each_max(self, other: Pair) -> Pair:
        """The larger of each."""
        return self._with(other, max)

    def each_min(self, other: Pair) -> Pair:
        """The smaller of each."""
        return self._with(other, min)

    def copy(self) -> Pair:
        """The pair itself."""
        return self

    def _with(self, other: Union[Pair, int], of: Callable[[int, int], int]) -> Pair:
        x, y = (other, other) if isinstance(other, int) else other
        return Pair(of(self.x, x), of(self.y, y))


class Timer:
    """A clock that keeps a loop at a number of rounds per second."""

    def __init__(self, target_step_frequency: Optional[int] = None) -> None:
        """Args:
            target_step_frequency: rounds per second; None for as many as there can be.
        """
        often = np.inf if target_step_frequency is None else target_step_frequency
        self._period = 1 / amount(often, "target_step_frequency", 1e-6)
        self._last = self._second = time.monotonic()
        self._rounds = 0

    def should_step(self) -> bool:
        """Whether the time for the next round has come."""
        return time.monotonic() - self._last >= self._period

    def step(self, verbose: bool = False) -> None:
        """Begins a round, and prints how many there were in each second if that is wanted."""
        self._last = time.monotonic()
        self._rounds += 1
        passed = self._last - self._second
        if passed >= 1:
            if verbose:
                print(f"{self._rounds / passed:.1f} rounds per second")
            self._second, self._rounds = self._last, 0
