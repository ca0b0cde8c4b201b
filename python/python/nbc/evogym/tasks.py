"""Evolution Gym's tasks: worlds, observations and rewards, for any number of robots at once.

Lengths are in meters here, as in Evolution Gym's benchmark environments: a voxel is 0.1 m. Arrays have a row for each
world.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial
from math import pi
from typing import Any, Callable, Dict, List, NamedTuple, Optional, Sequence, Tuple

import numpy as np
import numpy.typing as npt

from ..registration import EPISODES
from ..names import unknown
from ..numbers import array_of, whole
from .sim import VOXEL_SIZE, Scenes
from .world import EvoWorld

__all__ = ["TASKS", "Task", "TaskWorlds", "WalkToX", "task_of"]

_Floats = npt.NDArray[np.float64]
_Bools = npt.NDArray[np.bool_]


class Thing:
    """An object in some worlds at one time."""

    def __init__(self, means: _Floats, turn: Optional[_Floats], extents: Optional[_Floats]) -> None:
        self.com, self._means, self._turn, self._extents = means[:, 2:4], means, turn, extents

    @property
    def velocity(self) -> _Floats:
        """Velocities of the centers of mass, shape (N, 2)."""
        return self._means[:, 4:6] * VOXEL_SIZE

    @property
    def mean_velocity(self) -> _Floats:
        """The means of the velocities of the points, shape (N, 2): the same but for its last bit."""
        return self._means[:, 6:8]

    @property
    def turn(self) -> _Floats:
        """How far they have turned since the start, shape (N,)."""
        assert self._turn is not None, "a task that needs turns says so"
        return self._turn

    @property
    def span(self) -> _Floats:
        """Widths and heights, shape (N, 2)."""
        assert self._extents is not None, "a task that needs extents says so"
        return self._extents[:, :2] * VOXEL_SIZE

    @property
    def area(self) -> _Floats:
        """Areas of the convex hulls, shape (N,)."""
        assert self._extents is not None, "a task that needs extents says so"
        return self._extents[:, 2] * VOXEL_SIZE**2


@dataclass
class Moment:
    """All worlds at one time."""

    robot: Thing
    others: Dict[str, Thing]
    worlds: TaskWorlds

    def object(self, name: str) -> Thing:
        """An object beside the robot."""
        return self.others[name]


_Part = Callable[[Moment], _Floats]
_Judge = Callable[[Moment, Moment], Tuple[_Floats, _Bools]]


# ---- what is observed ----


def velocity(now: Moment) -> _Floats:
    """The velocity of the robot."""
    return now.robot.velocity


def turn(now: Moment) -> _Floats:
    """How far the robot has turned."""
    return now.robot.turn[:, None]


def shape(now: Moment) -> _Floats:
    """The points of the robot from its center of mass: first x, then y, zeros where a world has fewer points than the
    most."""
    return now.worlds.shape()


def surface(now: Moment, names: Tuple[str, ...], sight: int, above: bool = False, reach: float = 5.0) -> _Floats:
    """How far below (or above) the robot's center of mass the terrain is in each column, up to ``reach`` voxels."""
    return now.worlds.surface(names, sight, above, reach)


def pair(now: Moment, name: str) -> _Floats:
    """Velocities of the robot and of an object, and the way from one to the other."""
    other = now.object(name)
    return np.concatenate((now.robot.mean_velocity, other.com - now.robot.com, other.mean_velocity), axis=1)


def way_to(now: Moment, name: str) -> _Floats:
    """The way from the robot to an object."""
    return now.object(name).com - now.robot.com


def velocity_of(now: Moment, name: str) -> _Floats:
    """The velocity of an object."""
    return now.object(name).velocity


def turn_of(now: Moment, name: str) -> _Floats:
    """How far an object has turned."""
    return now.object(name).turn[:, None]


def goal(now: Moment) -> _Floats:
    """The number of the goal, its place, and how far it is. A goal that is passed in an env step is observed once more,
    as Evolution Gym does it."""
    sought = now.worlds.sought
    places = now.worlds.goal_places(sought) * 0.1
    return np.stack((sought, places, places - now.robot.com[:, 0]), axis=1)


# ---- what is rewarded ----


def _way(before: Moment, after: Moment, x: float = 0.0, y: float = 0.0) -> _Floats:
    way: _Floats = (after.robot.com - before.robot.com) @ np.array([x, y])
    return way


def _no(after: Moment) -> _Bools:
    return np.zeros(len(after.robot.com), dtype=bool)


def walks(
    before: Moment,
    after: Moment,
    x: float = 1.0,
    y: float = 0.0,
    goal: Optional[Tuple[int, float, float]] = None,
    tilt: Optional[Tuple[float, float]] = None,
    lowest: Optional[float] = None,
) -> Tuple[_Floats, _Bools]:
    """The way of the robot. ``goal`` is an axis, a place in voxels beyond which the task is done, and its reward; a
    robot that turns into ``tilt``, or falls below ``lowest``, loses 3 and ends."""
    reward, done = _way(before, after, x, y), _no(after)
    if goal is not None:
        axis, place, bonus = goal
        arrived = after.robot.com[:, axis] > place * VOXEL_SIZE
        reward, done = reward + bonus * arrived, done | arrived
    if lowest is not None:
        fallen = after.robot.com[:, 1] < lowest
        reward, done = reward - 3.0 * fallen, done | fallen
    if tilt is not None:
        turned = after.robot.turn
        over = (turned > tilt[0]) & (turned < tilt[1])
        reward, done = reward - 3.0 * over, done | over
    return reward, done


def jumps(before: Moment, after: Moment) -> Tuple[_Floats, _Bools]:
    """Up, and not aside."""
    way = after.robot.com - before.robot.com
    return way[:, 1] * 10 - np.abs(way[:, 0]) * 5, _no(after)


def flips(before: Moment, after: Moment) -> Tuple[_Floats, _Bools]:
    """Turns counterclockwise, over many turns."""
    one, two = before.robot.turn, after.robot.turn
    turns = (one > 5 * pi / 3) & (two < pi / 3)
    back = (one < pi / 3) & (two > 5 * pi / 3)
    more = turns.astype(np.int64) - back
    after.worlds.flips += more
    reward = two - one + 2 * pi * more
    return reward, after.robot.com[:, 0] < VOXEL_SIZE


def balances(before: Moment, after: Moment, x: float, y: float) -> Tuple[_Floats, _Bools]:
    """Comes nearer to a place, in voxels, along each axis."""
    place = np.array([x, y]) * VOXEL_SIZE
    return (np.abs(place - before.robot.com) - np.abs(place - after.robot.com)).sum(axis=1), _no(after)


def changes_area(before: Moment, after: Moment, sign: int) -> Tuple[_Floats, _Bools]:
    """The area of the convex hull grows or shrinks."""
    return (after.robot.area - before.robot.area) * 10 * sign, _no(after)


def changes_span(before: Moment, after: Moment, axis: int) -> Tuple[_Floats, _Bools]:
    """The width or the height grows."""
    return after.robot.span[:, axis] - before.robot.span[:, axis], _no(after)


def carries(before: Moment, after: Moment) -> Tuple[_Floats, _Bools]:
    """Robot and package go to the right, and the package does not fall."""
    one, two = before.object("package").com, after.object("package").com
    reward = (two - one)[:, 0] * 0.5 + _way(before, after, 0.5)
    reward += np.where(two[:, 1] < 3.0 * VOXEL_SIZE, 10 * (two - one)[:, 1], 0)
    arrived = after.robot.com[:, 0] > 99 * VOXEL_SIZE
    return reward + arrived, arrived


def carries_to_table(before: Moment, after: Moment) -> Tuple[_Floats, _Bools]:
    """The robot goes to a table, and the package does not fall."""
    one, two = before.object("package").com, after.object("package").com
    table = 40 * VOXEL_SIZE
    reward = np.abs(table - before.robot.com[:, 0]) - np.abs(table - after.robot.com[:, 0])
    lowest = np.where(two[:, 0] > 20 * VOXEL_SIZE, 4.0 * VOXEL_SIZE, 6.0 * VOXEL_SIZE)
    return reward + np.where(two[:, 1] < lowest, 10 * (two - one)[:, 1], 0), _no(after)


def pushes(before: Moment, after: Moment, place: float) -> Tuple[_Floats, _Bools]:
    """Robot and package go to the right, and stay together."""
    one, two = before.object("package").com, after.object("package").com
    reward = (two - one)[:, 0] * 0.75 + _way(before, after, 0.5)
    reward += np.abs(before.robot.com[:, 0] - one[:, 0]) - np.abs(after.robot.com[:, 0] - two[:, 0])
    reward += np.where(two[:, 1] < 0, 10 * (two - one)[:, 1], 0)
    arrived = after.robot.com[:, 0] > place * VOXEL_SIZE
    return reward + arrived, arrived


def throws(before: Moment, after: Moment) -> Tuple[_Floats, _Bools]:
    """The package goes to the right, and the robot does not."""
    way = (after.object("package").com - before.object("package").com)[:, 0]
    penalty = -_way(before, after, 0.25)
    return way + np.where(after.robot.com[:, 0] < 0, -penalty, penalty), _no(after)


def moves_beam(before: Moment, after: Moment, topples: bool) -> Tuple[_Floats, _Bools]:
    """The robot comes to the beam, and slides it to the right or topples it."""
    one, two = before.object("beam").com, after.object("beam").com
    reward = np.abs(one[:, 0] - before.robot.com[:, 0]) - np.abs(two[:, 0] - after.robot.com[:, 0])
    way = two - one
    if topples:
        reward += np.abs(way[:, 0]) + np.abs(way[:, 1]) * 3.0 - way[:, 1] * 10
    else:
        reward += way[:, 0]
    done = two[:, 0] < 2 * VOXEL_SIZE
    return reward + done, done


def lifts(before: Moment, after: Moment) -> Tuple[_Floats, _Bools]:
    """The package goes up in the middle of the hole, and the robot stays above it."""
    one, two = before.object("package").com, after.object("package").com
    place = 5.5 * VOXEL_SIZE
    reward = (two - one)[:, 1] * 10 + (np.abs(place - one[:, 0]) - np.abs(place - two[:, 0])) * 10
    return reward + np.where(after.robot.com[:, 1] < 3 * VOXEL_SIZE, 20 * _way(before, after, 0, 1), 0), _no(after)


def visits(before: Moment, after: Moment) -> Tuple[_Floats, _Bools]:
    """Comes nearer to the next of some goals; those within two voxels are passed."""
    worlds, one, two = after.worlds, before.robot.com[:, 0], after.robot.com[:, 0]
    reward, passes = np.zeros(len(two)), np.ones(len(two), dtype=bool)
    while (passes := passes & ~worlds.arrived()).any():
        place = worlds.goal_places(worlds.goal) * 0.1
        reward = np.where(passes, np.abs(place - one) - np.abs(place - two), reward)
        passes &= np.abs(place - two) < 2 * 0.1
        worlds.goal += passes
    done = worlds.arrived()
    return reward + done, done


def catches(before: Moment, after: Moment) -> Tuple[_Floats, _Bools]:
    """The robot comes below the package, which does not fall to the ground."""
    one, two = before.object("package").com, after.object("package").com
    reward = np.abs(before.robot.com[:, 0] - one[:, 0]) - np.abs(after.robot.com[:, 0] - two[:, 0])
    return reward + np.where(two[:, 1] < 5.0 * VOXEL_SIZE, 10 * (two - one)[:, 1], 0), _no(after)


# ---- the tasks ----


@dataclass(frozen=True)
class Task:
    """A task: a world, where the robot starts, what it observes, and what is rewarded."""

    world: str
    at: Tuple[int, int]
    observes: Tuple[_Part, ...]
    judge: _Judge
    others: Tuple[str, ...] = ()
    blocks: Tuple[Tuple[int, int, int], ...] = ()
    has_goals: bool = False
    falls: bool = False
    name: str = ""
    steps: int = 0

    def __reduce__(self) -> Tuple[Any, ...]:
        return task_of, (self.name,)

    @property
    def turned(self) -> Optional[str]:
        """The object whose turn is observed."""
        if turn in self.observes:
            return "robot"
        return self.others[0] if any(getattr(part, "func", None) is turn_of for part in self.observes) else None

    @property
    def needs_extents(self) -> bool:
        """Whether widths, heights and areas are rewarded."""
        return getattr(self.judge, "func", None) in (changes_area, changes_span)

    def make_world(
        self, body: npt.ArrayLike, connections: Optional[npt.ArrayLike] = None, drop: Tuple[int, int] = (0, 0)
    ) -> EvoWorld:
        """The world with a robot in it, which is called ``robot``. A package that falls begins ``drop`` voxels to the
        right of its usual place and above it."""
        world = EvoWorld.of_task(self.world)
        world.add_from_array("robot", body, *self.at, connections=connections)
        for number, (x, y, size) in enumerate(self.blocks):
            world.add_from_array(f"block_{number}", np.ones((size, size), dtype=int), x, y)
        if self.falls:
            for name, file, x, y in (("package", "package", 21, 41), ("peg1", "peg", 17, 39), ("peg2", "peg", 19, 25)):
                for each in EvoWorld.of_task(file).objects.values():
                    world.add_from_array(name, each.structure, x + drop[0], y + drop[1])
        return world


_OVER, _STEEP = (pi / 2, 3 * pi / 2), (pi / 2 - pi / 12, 3 * pi / 2 + pi / 12)
_SOUP = tuple(
    [(20, 1, 3), (24, 1, 3), (27, 1, 2), (31, 1, 3), (34, 1, 3), (38, 1, 2), (41, 1, 3), (45, 1, 3)]
    + [(21, 4, 3), (24, 4, 2), (26, 4, 1), (29, 4, 2), (31, 4, 3), (34, 4, 2), (36, 4, 2), (40, 4, 3), (43, 4, 2)]
    + [(46, 4, 3)]
    + [(x, 7, 2) for x in range(20, 45, 3)]
)
_SHAPE = (7, 1)


def _stairs(names: Sequence[str] = ("ground",)) -> Tuple[_Part, ...]:
    return (velocity, turn, shape, partial(surface, names=tuple(names), sight=5))


def _package(name: str = "package") -> Tuple[_Part, ...]:
    return (partial(pair, name=name), shape)


_BEAM: Tuple[_Part, ...] = (
    partial(way_to, name="beam"), velocity, partial(velocity_of, name="beam"), partial(turn_of, name="beam"), shape
)
_CAVE = partial(surface, names=("terrain",), sight=5)

_TASKS: Dict[str, Task] = {
    "Walker-v0": Task("Walker-v0", (1, 1), (velocity, shape), partial(walks, goal=(0, 99, 1.0))),
    "BidirectionalWalker-v0": Task(
        "BidirectionalWalker-v0", (33, 1), (velocity, shape, goal), visits, has_goals=True
    ),
    "BridgeWalker-v0": Task("BridgeWalker-v0", (2, 5), (velocity, turn, shape), partial(walks, goal=(0, 60, 1.0))),
    "CaveCrawler-v0": Task(
        "CaveCrawler-v0", (1, 2), (velocity, shape, _CAVE, partial(_CAVE, above=True)),
        partial(walks, goal=(0, 69, 1.0)),
    ),
    "Jumper-v0": Task(
        "Jumper-v0", (32, 1), (velocity, shape, partial(surface, names=("ground",), sight=2)), jumps
    ),
    "Flipper-v0": Task("Flipper-v0", (60, 1), (turn, shape), flips),
    "Balancer-v0": Task("Balancer-v0", (15, 3), (turn, shape), partial(balances, x=17, y=5.0)),
    "Balancer-v1": Task("Balancer-v1", (10, 1), (turn, shape), partial(balances, x=17.5, y=6)),
    "UpStepper-v0": Task("UpStepper-v0", (1, 1), _stairs(), partial(walks, goal=(0, 69, 2.0), tilt=_STEEP)),
    "DownStepper-v0": Task("DownStepper-v0", (1, 11), _stairs(), partial(walks, goal=(0, 74, 2.0), tilt=_OVER)),
    "ObstacleTraverser-v0": Task(
        "ObstacleTraverser-v0", (2, 1), _stairs(), partial(walks, goal=(0, 79, 2.0), tilt=_OVER)
    ),
    "ObstacleTraverser-v1": Task("ObstacleTraverser-v1", (2, 4), _stairs(), partial(walks, goal=(0, 59, 2.0))),
    "Hurdler-v0": Task("Hurdler-v0", (2, 4), _stairs(), partial(walks, tilt=_OVER)),
    "GapJumper-v0": Task(
        "GapJumper-v0", (1, 6), _stairs([f"platform_{n}" for n in range(1, 6)]), partial(walks, lowest=0.4)
    ),
    "PlatformJumper-v0": Task(
        "PlatformJumper-v0", (1, 6), _stairs([f"platform_{n}" for n in range(1, 8)]),
        partial(walks, lowest=0.4, tilt=_OVER),
    ),
    "Traverser-v0": Task(
        "Traverser-v0", (1, 9), _stairs(["ground", *(f"block_{n}" for n in range(len(_SOUP)))]),
        partial(walks, goal=(0, 59, 2.0)), blocks=_SOUP,
    ),
    "Lifter-v0": Task(
        "Lifter-v0", (2, 3), (partial(pair, name="package"), partial(turn_of, name="package"), shape), lifts,
        others=("package",),
    ),
    "Catcher-v0": Task(
        "Walker-v0", (22, 1),
        (partial(way_to, name="package"), velocity, partial(velocity_of, name="package"),
         partial(turn_of, name="package"), shape),
        catches, others=("package",), falls=True,
    ),
    "Carrier-v0": Task("Carrier-v0", (1, 1), _package(), carries, others=("package",)),
    "Carrier-v1": Task("Carrier-v1", (1, 4), _package(), carries_to_table, others=("package",)),
    "Pusher-v0": Task("Pusher-v0", (1, 1), _package(), partial(pushes, place=99), others=("package",)),
    "Pusher-v1": Task("Pusher-v1", (13, 1), _package(), partial(pushes, place=69), others=("package",)),
    "BeamToppler-v0": Task(
        "BeamToppler-v0", (1, 1), _BEAM, partial(moves_beam, topples=True), others=("beam",)
    ),
    "BeamSlider-v0": Task("BeamSlider-v0", (1, 1), _BEAM, partial(moves_beam, topples=False), others=("beam",)),
    "Thrower-v0": Task("Thrower-v0", (1, 1), _package(), throws, others=("package",)),
    "AreaMaximizer-v0": Task("ShapeChange", _SHAPE, (shape,), partial(changes_area, sign=1)),
    "AreaMinimizer-v0": Task("ShapeChange", _SHAPE, (shape,), partial(changes_area, sign=-1)),
    "WingspanMazimizer-v0": Task("ShapeChange", _SHAPE, (shape,), partial(changes_span, axis=0)),
    "HeightMaximizer-v0": Task("ShapeChange", _SHAPE, (shape,), partial(changes_span, axis=1)),
    "Climber-v0": Task("Climber-v0", (1, 1), (velocity, shape), partial(walks, x=0, y=1, goal=(1, 86, 1.0))),
    "Climber-v1": Task("Climber-v1", (1, 1), (velocity, shape), partial(walks, x=0, y=1, goal=(1, 65, 1.0))),
    "Climber-v2": Task(
        "Climber-v2", (1, 1),
        (velocity, turn, shape, partial(surface, names=("pipe",), sight=3, above=True)), partial(walks, x=0.2, y=1),
    ),
}

TASKS: Dict[str, Task] = {name: replace(task, name=name, steps=EPISODES[name]) for name, task in _TASKS.items()}
"""The tasks by their names in Evolution Gym."""


def task_of(name: str) -> Task:
    """The task of a name.

    Raises:
        ValueError: when there is none.
    """
    if name not in TASKS:
        raise ValueError(unknown("task", name, TASKS))
    return TASKS[name]


class WalkToX(NamedTuple):
    """A goal of BidirectionalWalker-v0."""

    x_goal: int
    """Its place in voxels."""

    @property
    def name(self) -> str:
        """Its name."""
        return f"Walk to x = {self.x_goal}"


class TaskWorlds:
    """Worlds of one task with different robots. They can be pickled and copied."""

    def __init__(self, task: Task, worlds: Sequence[EvoWorld]) -> None:
        self.task, self.worlds, self.scenes = task, list(worlds), Scenes(worlds)
        self.goals: List[List[int]] = [[0] for _ in worlds]
        self.goal = np.zeros(len(worlds), dtype=np.int64)
        # The goals before the last env step.
        self.sought = self.goal.copy()
        self.flips = self.goal.copy()
        self._prepare()

    def _prepare(self) -> None:
        """Finds out what the worlds and their states say."""
        self._all = range(len(self.worlds))
        places = [self.scenes.actuators(n, "robot") for n in self._all]
        self.actuators = np.array([end - first for first, end in places])
        self._places = {name: self.scenes.places(self._all, name) for name in ("robot", *self.task.others)}
        self._points = int(self.scenes._native.counts(*self._places["robot"]).max())
        self._grounds: Dict[Tuple[str, ...], npt.NDArray[np.uintp]] = {}
        self._lay_out_goals()
        self._turned, self._is_spread = self.task.turned, self.task.needs_extents
        self._seen = -1
        self.look()

    def _lay_out_goals(self) -> None:
        self._counts = np.array([len(goals) for goals in self.goals])
        self._table = np.zeros((len(self), int(self._counts.max())), dtype=np.int64)
        for own, goals in zip(self._table, self.goals):
            own[: len(goals)] = goals

    def __len__(self) -> int:
        return len(self._all)

    def __getstate__(self) -> Dict[str, Any]:
        return {each: getattr(self, each) for each in ("task", "worlds", "scenes", "goals", "goal", "sought", "flips")}

    def __setstate__(self, kept: Dict[str, Any]) -> None:
        self.__dict__.update(kept)
        self._prepare()

    def step(self, targets: _Floats) -> Tuple[_Floats, _Bools]:
        """Simulates an env step with the targets of `targets_of`, which are clipped to 0.6 to 1.6. Returns rewards, and
        whether each world is done."""
        self.look()
        before = self.now
        self.scenes.drive(np.minimum(np.maximum(targets, 0.6), 1.6))
        self.look()
        self.sought[:] = self.goal
        reward, done = self.task.judge(before, self.now)
        broken = self.scenes.faults > 0
        return (reward - 3.0 * broken, done | broken) if broken.any() else (reward, done)

    def reset(
        self, worlds: Sequence[int], randoms: Sequence[Any], goals: Sequence[Optional[Sequence[int]]] = ()
    ) -> None:
        """Puts some worlds back to their start, with goals drawn anew if the task has some. The goal of a task whose
        package falls is how far to the right, and how far up, that begins.

        Args:
            worlds: their numbers.
            randoms: the generator of each of them.
            goals: the goals of each of them, or None for those that are drawn.
        """
        if self.task.falls or self.task.has_goals:
            draw = _draw_place if self.task.falls else _draw_goals
            # All of them first: what cannot be leaves the worlds as they were.
            found = [
                draw(random) if own is None else _read_goals(own, self.task)
                for random, own in zip(randoms, goals or [None] * len(worlds))
            ]
            if self.task.falls:
                self._drop(worlds, found)
            for n, own in zip(worlds, found):
                self.goals[n], self.goal[n], self.sought[n] = own, 0, 0
            self._lay_out_goals()
        for n in worlds:
            self.scenes.reset(n)
            self.flips[n] = 0
        self.look()

    def _drop(self, worlds: Sequence[int], places: Sequence[List[int]]) -> None:
        """Makes some worlds anew, with the package somewhere else."""
        made = list(self.worlds)
        for n, (right, up) in zip(worlds, places):
            robot = made[n].objects["robot"]
            made[n] = self.task.make_world(robot.structure, robot.get_connections(), (right, up))
        scenes = Scenes(made)
        for n in self._all:
            if n not in worlds:
                scenes._native.restore(n, *self.scenes._native.state(n))
        self.scenes.close()
        self.worlds, self.scenes, self._seen = made, scenes, -1

    def kept(self, world: int = 0) -> Dict[str, Any]:
        """What Evolution Gym's classes keep of their task, by its name there."""
        found: Dict[str, Any] = {}
        for part in self.task.observes:
            if getattr(part, "func", None) is surface:
                found["sight_dist"] = part.keywords["sight"]  # type: ignore[attr-defined]
        if self.task.has_goals:
            goals = [WalkToX(place) for place in self.goals[world]]
            found.update(goals=goals, current_goal=int(self.goal[world]))
        if self.task.falls:
            found["offsetx"], found["offsety"] = (*self.goals[world], 0)[:2]
        if self.task.judge is flips:
            found["num_flips"] = int(self.flips[world])
        return found

    def observe(self) -> _Floats:
        """What each robot observes, shape (N, most values)."""
        return np.concatenate([part(self.now) for part in self.task.observes], axis=1)

    def shape(self) -> _Floats:
        """The points of each robot from its center of mass."""
        return self.scenes._native.shapes(*self._places["robot"], self._points) * VOXEL_SIZE

    def surface(self, names: Tuple[str, ...], sight: int, above: bool, reach: float) -> _Floats:
        """The terrain around each robot."""
        if names not in self._grounds:
            self._grounds[names] = np.stack([self.scenes.places(self._all, name)[1] for name in names], axis=1)
        found = self.scenes._native.surface(*self._places["robot"], self._grounds[names], sight, reach, above)
        return found * VOXEL_SIZE

    def goal_places(self, numbers: npt.NDArray[np.int64]) -> npt.NDArray[np.int64]:
        """The goals with these numbers, or the last one of a world that has fewer, in voxels."""
        return self._table[self._all, np.minimum(numbers, self._counts - 1)]

    def arrived(self) -> _Bools:
        """The worlds in which all goals have been passed."""
        return self.goal >= self._counts

    def look(self) -> None:
        """Takes the state of the worlds as that of now. They may have been stepped or reset by themselves."""
        changes = self.scenes.changes
        if changes == self._seen:
            return
        self._seen, native, things = changes, self.scenes._native, {}
        for name, places in self._places.items():
            turns = native.turns(*places) if name == self._turned else None
            extents = native.extents(*places) if name == "robot" and self._is_spread else None
            things[name] = Thing(native.centers(*places), turns, extents)
        self.now = Moment(things.pop("robot"), things, self)


def _read_goals(goals: Any, task: Task) -> List[int]:
    """Goals that are given."""
    array = array_of(goals)
    least, expected = (2, "two numbers") if task.falls else (1, "a list of numbers")
    if array.ndim != 1 or array.dtype.kind not in "iuf":
        raise ValueError(f"the goals are {goals!r}, expected {expected}")
    if len(array) < least or (task.falls and len(array) > least):
        raise ValueError(f"there are {len(array)} goals, expected {expected}")
    numbers: List[int] = whole(array, "the goal", least=-(2**31), most=2**31).tolist()
    return numbers


def _draw_place(random: Any) -> List[int]:
    """How far to the right, and how far up, a package begins to fall."""
    return [int(random.integers(-6, 5)), int(random.integers(0, 6))]


def _draw_goals(random: Any) -> List[int]:
    """Places from 20 to 49 voxels, until their way has 100."""
    at, way, goals = 35, 0, []
    while way < 100:
        place = int(random.integers(20, 50))
        way += abs(at - place)
        at = place
        goals.append(place)
    return goals
