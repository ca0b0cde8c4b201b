"""The simulator under the names of ``evogym``: `EvoSim` for one world, `Scenes` for many at once."""

from __future__ import annotations

import copy
import operator
from typing import Any, Dict, List, Optional, Sequence, Tuple

import numpy as np
import numpy.typing as npt

from .. import _nbc
from ..names import meant
from ..numbers import amount, count, finite, whole
from .world import EvoWorld, WorldObject

__all__ = ["EvoSim", "Scenes"]

_Points = npt.NDArray[np.float64]
_Numbers = npt.NDArray[np.uintp]
VOXEL_SIZE = 0.1


class Scenes:
    """Worlds that are simulated at once, each on its own. Worlds with the same terrain and objects, and any robots,
    share the lanes of the processor. They can be pickled and copied.

    >>> import numpy as np
    >>> from nbc.evogym import EvoWorld, Scenes
    >>> world = EvoWorld.of_task("Walker-v0")
    >>> world.add_from_array("robot", np.array([[3, 3], [4, 4]]), 1, 1)
    >>> scenes = Scenes([world, world])
    >>> scenes.step(np.ones(8))
    >>> scenes.faults.tolist()
    [0, 0]
    """

    def __init__(self, worlds: Sequence[EvoWorld]) -> None:
        """Puts the objects of each world at their start.

        Raises:
            ValueError: for a world in which nothing can move, and for an object that its connections do not join into
                one piece.
        """
        for world in worlds:
            if not isinstance(world, EvoWorld):
                raise TypeError(f"a world is of type {type(world).__name__}, expected EvoWorld")
        self.names = [[each.name for each in world.ordered()] for world in worlds]
        self._objects = [[_packed(each) for each in world.ordered()] for world in worlds]
        self._start()

    def _start(self) -> None:
        self._native = _nbc.Scenes(self._objects)
        ends = [max(self._native.channels(n, k)[1] for k in range(len(own))) for n, own in enumerate(self.names)]
        self._targets = sum(ends)

    def __len__(self) -> int:
        return len(self._native)

    def step(self, actions: npt.ArrayLike, steps: int = 1) -> None:
        """Simulates env steps.

        Args:
            actions: the target of each actuator as a fraction of its rest length: those of all worlds one after
                another, robots in the order of their names and actuators in reading order. Targets are taken as they
                are; Evolution Gym's environments clip them to 0.6 to 1.6.
            steps: env steps with these targets.

        Raises:
            TypeError, ValueError: when there is not one finite target for each actuator.
        """
        self.drive(targets_of(actions).ravel(), count(steps, "steps"))

    def drive(self, targets: _Points, steps: int = 1) -> None:
        """Simulates env steps as `step` does, with targets that are finite numbers in an array of one dimension."""
        if len(targets) != self._targets:
            expected = f"expected {self._targets}, one for each actuator"
            raise ValueError(f"the actions have {len(targets)} targets, {expected}")
        self._native.act(targets)
        self._native.step(steps)

    def reset(self, scene: int) -> None:
        """Puts a world back to its start. Its targets stay until the next step."""
        self._native.reset(self._known(scene))

    def points(self, scenes: Sequence[int], name: str) -> Tuple[_Points, _Points]:
        """The points of an object in some worlds, one world after another: positions in voxels, shape (P, 2), and
        velocities in voxels per second."""
        return self._native.points(*self.places(scenes, name))

    def centers(self, scenes: Sequence[int], name: str) -> Tuple[_Points, _Points]:
        """The center of mass of an object in each of some worlds: its position in voxels, shape (N, 2), and its
        velocity in voxels per second."""
        found = self._native.centers(*self.places(scenes, name))
        return found[:, :2], found[:, 4:6]

    def shapes(self, scenes: Sequence[int], name: str) -> _Points:
        """The points of an object from its center of mass in each of some worlds, shape (N, 2 P): first x, then y, with
        zeros where a world has fewer points than the most."""
        numbers, objects = self.places(scenes, name)
        most = int(self._native.counts(numbers, objects).max(initial=1))
        return self._native.shapes(numbers, objects, most)

    def surface(
        self,
        scenes: Sequence[int],
        name: str,
        terrain: Sequence[str],
        sight_dist: int,
        sight_range: float = 5,
        above: bool = False,
    ) -> _Points:
        """How far below the center of mass of an object the terrain is in each of some worlds, in voxels.

        Args:
            scenes: the numbers of the worlds.
            name: the object.
            terrain: the objects that are terrain.
            sight_dist: the columns to the left and to the right of that in the middle.
            sight_range: the most that is seen, and what is said of a column without terrain.
            above: whether terrain above the object is meant.

        Returns:
            A distance for each column, shape (N, 2 sight_dist + 1).
        """
        numbers, objects = self.places(scenes, name)
        columns = [self.places(scenes, each)[1] for each in terrain]
        grounds = np.stack(columns, axis=1) if columns else np.empty((len(numbers), 0), dtype=np.uintp)
        sight = count(sight_dist, "sight_dist", most=4096)
        return self._native.surface(numbers, objects, grounds, sight, amount(sight_range, "sight_range"), bool(above))

    def extents(self, scenes: Sequence[int], name: str) -> _Points:
        """The width and the height of an object in each of some worlds, and the area of the convex hull of its points,
        shape (N, 3), in voxels."""
        return self._native.extents(*self.places(scenes, name))

    def turns(self, scenes: Sequence[int], name: str) -> _Points:
        """How far an object has turned in each of some worlds since the start, in radians from 0 to 2π,
        counterclockwise, by Evolution Gym's estimate."""
        return self._native.turns(*self.places(scenes, name))

    def voxels(self, scene: int, name: str) -> npt.NDArray[np.intp]:
        """The four points of each voxel of an object, by their rows in `points`, shape (V, 4)."""
        found = self._native.voxels(scene, self._place(scene, name))
        return np.array(found, dtype=np.intp).reshape(-1, 4)

    def actuators(self, scene: int, name: str) -> Tuple[int, int]:
        """The places of an object's actuators in the targets of its world: the first, and the one after the last."""
        return self._native.channels(scene, self._place(scene, name))

    @property
    def faults(self) -> npt.NDArray[np.uint32]:
        """For each world the env step that was abandoned because a robot became unstable; 0 for none. Such a world
        stays as it was before that env step, until it is reset."""
        return self._native.faults()

    @property
    def clock(self) -> npt.NDArray[np.uint32]:
        """Env steps that each world has done since its start."""
        return self._native.clocks()

    def close(self) -> None:
        """Frees the worlds. Later calls raise ValueError."""
        self._native.close()

    @property
    def changes(self) -> int:
        """A number that grows whenever the state of a world changes."""
        return self._native.changes()

    def places(self, scenes: Sequence[int], name: str) -> Tuple[_Numbers, _Numbers]:
        """The numbers of some worlds, and that of an object in each of them."""
        objects = [self._place(scene, name) for scene in scenes]
        return np.array(scenes, dtype=np.uintp).reshape(-1), np.array(objects, dtype=np.uintp)

    def __getstate__(self) -> Dict[str, Any]:
        states = [self._native.state(n) for n in range(len(self))]
        return {"names": self.names, "objects": self._objects, "states": states}

    def __setstate__(self, kept: Dict[str, Any]) -> None:
        self.names, self._objects = kept["names"], kept["objects"]
        self._start()
        for n, state in enumerate(kept["states"]):
            self._native.restore(n, *state)

    def _place(self, scene: int, name: str) -> int:
        scene = self._known(scene)
        try:
            return self.names[scene].index(name)
        except ValueError:
            raise ValueError(f"world {scene} has no object `{name}`") from None

    def _known(self, scene: int) -> int:
        number = operator.index(scene)
        if not 0 <= number < len(self):
            raise IndexError(f"there is no world {number}; the worlds count from 0 to {len(self) - 1}")
        return number


def targets_of(actions: npt.ArrayLike) -> npt.NDArray[np.float64]:
    """Targets of actuators as finite numbers.

    Raises:
        TypeError, ValueError: for what are no numbers, and those that are not finite.
    """
    return finite(actions, "the action")


def _packed(each: WorldObject) -> Tuple[npt.NDArray[np.uint8], int, int, List[Tuple[int, int]]]:
    if not each.is_joined():
        raise ValueError(f"the connections of the object `{each.name}` do not join it into one piece")
    codes = whole(each.structure, f"the structure of `{each.name}`", most=5)
    return np.ascontiguousarray(codes, dtype=np.uint8), each.pos[0], each.pos[1], each.apart


class EvoSim:
    """One world, with the methods of ``evogym.EvoSim``. It keeps the states of all env steps since the start, as that
    does, and can be pickled and copied.

    >>> import numpy as np
    >>> from nbc.evogym import EvoSim, EvoWorld
    >>> world = EvoWorld.of_task("Walker-v0")
    >>> world.add_from_array("robot", np.array([[3, 3], [4, 4]]), 1, 1)
    >>> sim = EvoSim(world)
    >>> sim.set_action("robot", np.array([1.6, 1.6, 0.6, 0.6]))
    >>> sim.step()
    False
    >>> sim.object_pos_at_time(1, "robot").shape
    (2, 9)
    """

    VOXEL_SIZE = VOXEL_SIZE

    def __init__(self, world: EvoWorld) -> None:
        scenes = Scenes([world])
        self.follow(world.copy(), scenes)

    @classmethod
    def of(cls, world: EvoWorld, scenes: Scenes) -> EvoSim:
        """The simulation of a world that another simulates, too, as the only one of some scenes."""
        made = cls.__new__(cls)
        made.follow(world, scenes)
        return made

    def follow(self, world: EvoWorld, scenes: Scenes) -> None:
        """Becomes the simulation of another world, from its state of now."""
        self.world, self.scenes = world, scenes
        self._objects = {each.name: each for each in world.ordered()}
        # Any object may be named in actions, with as many targets as it has actuators.
        self._robots = {name: scenes.actuators(0, name) for name in self._objects}
        self._targets = np.ones(max((end for _, end in self._robots.values()), default=0))
        # The scene that goes back to earlier states.
        self._past: Optional[Scenes] = None
        self._history = [scenes._native.state(0)]

    def get_actuator_indices(self, robot_name: str) -> npt.NDArray[np.int64]:
        """The places of a robot's actuators in its flattened structure."""
        self._robot(robot_name)
        return np.flatnonzero(np.isin(self._objects[robot_name].structure, (3, 4)))

    def get_dim_action_space(self, robot_name: str) -> int:
        """The number of a robot's actuators."""
        first, end = self._robot(robot_name)
        return end - first

    def set_action(self, robot_name: str, action: npt.ArrayLike) -> None:
        """Sets the targets of a robot's actuators, in order of `get_actuator_indices`, as fractions of their rest
        length."""
        first, end = self._robot(robot_name)
        targets = targets_of(action).ravel()
        if len(targets) != end - first:
            raise ValueError(f"the action has {len(targets)} values, expected {end - first} for {robot_name}")
        self._targets[first:end] = targets

    def step(self) -> bool:
        """Simulates an env step. Returns whether a robot became unstable; then time and positions stay as they were,
        and only `reset` helps."""
        self.scenes.drive(self._targets)
        return not self.keep()

    def keep(self) -> bool:
        """Keeps the state after an env step of the scenes. Returns False if a robot became unstable in it."""
        if self.scenes.faults[0]:
            return False
        self._history.append(self.scenes._native.state(0))
        return True

    def reset(self) -> None:
        """Goes back to time 0."""
        self.scenes.reset(0)
        del self._history[1:]

    def revert(self, time: int) -> None:
        """Goes back to an earlier time."""
        self.scenes._native.restore(0, *self._history[self._known(time)])
        del self._history[time + 1 :]

    def get_time(self) -> int:
        """Env steps since the start."""
        return len(self._history) - 1

    def pos_at_time(self, time: int) -> _Points:
        """The positions of all points in voxels, shape (2, P), objects in Evolution Gym's order."""
        return np.concatenate([self.object_pos_at_time(time, name) for name in self._objects], axis=1)

    def vel_at_time(self, time: int) -> _Points:
        """The velocities of all points in voxels per second, shape (2, P)."""
        return np.concatenate([self.object_vel_at_time(time, name) for name in self._objects], axis=1)

    def object_pos_at_time(self, time: int, object_name: str) -> _Points:
        """The positions of an object's points in voxels, shape (2, P)."""
        # In the order of Evolution Gym's arrays, in which `mean` adds one point after another.
        return np.array(self._at(time, object_name).points([0], object_name)[0].T, order="F")

    def object_vel_at_time(self, time: int, object_name: str) -> _Points:
        """The velocities of an object's points in voxels per second, shape (2, P)."""
        return np.array(self._at(time, object_name).points([0], object_name)[1].T, order="F")

    def object_orientation_at_time(self, time: int, object_name: str) -> float:
        """How far an object has turned since the start, in radians from 0 to 2π, counterclockwise."""
        return float(self._at(time, object_name).turns([0], object_name)[0])

    def __getstate__(self) -> Dict[str, Any]:
        return {**self.__dict__, "_past": None}

    def __copy__(self) -> EvoSim:
        return copy.deepcopy(self)

    def _at(self, time: int, name: str) -> Scenes:
        """The world at a time."""
        if name not in self._objects:
            raise ValueError(f"the world has no object `{name}`")
        number = self._known(time)
        if number == self.get_time():
            return self.scenes
        if self._past is None:
            self._past = Scenes([self.world])
        self._past._native.restore(0, *self._history[number])
        return self._past

    def _known(self, time: int) -> int:
        number = operator.index(time)
        if not 0 <= number <= self.get_time():
            raise ValueError(f"time is {number}, expected 0 to {self.get_time()}")
        return number

    def _robot(self, name: str) -> Tuple[int, int]:
        if name not in self._robots:
            raise ValueError(f"the world has no object `{name}`{meant(name, self._robots)}")
        return self._robots[name]
