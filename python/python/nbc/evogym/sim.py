"""The simulator under the names of ``evogym``: `EvoSim` for one world, `Scenes` for many at once."""

from __future__ import annotations

import operator
from typing import Any, Dict, List, Sequence, Tuple

import numpy as np
import numpy.typing as npt

from .. import _nbc
from ..numbers import array_of, count
from .world import EvoWorld

__all__ = ["EvoSim", "Scenes"]

_Points = npt.NDArray[np.float64]
VOXEL_SIZE = 0.1


class Scenes:
    """Worlds that are simulated at once, each on its own. Worlds with the same terrain and objects, and any robots,
    share the lanes of the processor.

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
            ValueError: for a world in which nothing can move.
        """
        self.names = [[each.name for each in world.ordered()] for world in worlds]
        objects = [
            [(np.ascontiguousarray(each.structure, dtype=np.uint8), *each.pos) for each in world.ordered()]
            for world in worlds
        ]
        self._native = _nbc.Scenes(objects)

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
            ValueError: when there is not one finite target for each actuator.
        """
        targets = np.ascontiguousarray(array_of(actions), dtype=np.float64).ravel()
        if not np.isfinite(targets).all():
            raise ValueError("the actions have values that are not finite")
        self._native.act(targets)
        self._native.step(count(steps, "steps"))

    def reset(self, scene: int) -> None:
        """Puts a world back to its start. Its targets stay until the next step."""
        self._native.reset(self._known(scene))

    def points(self, scenes: Sequence[int], name: str) -> Tuple[_Points, _Points]:
        """The points of an object in some worlds, one world after another: positions in voxels, shape (P, 2), and
        velocities in voxels per second."""
        places = {self._place(scene, name) for scene in scenes}
        if len(places) == 1:
            return self._native.points(list(scenes), places.pop())
        found = [self._native.points([scene], self._place(scene, name)) for scene in scenes]
        return np.concatenate([each[0] for each in found]), np.concatenate([each[1] for each in found])

    def turns(self, scenes: Sequence[int], name: str) -> _Points:
        """How far an object has turned in each of some worlds since the start, in radians from 0 to 2π,
        counterclockwise, by Evolution Gym's estimate."""
        return np.concatenate([self._native.turns([scene], self._place(scene, name)) for scene in scenes])

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


class EvoSim:
    """One world, with the methods of ``evogym.EvoSim``. It keeps the positions of all env steps since the start, as
    that does, and can be pickled.

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
        self._world = world.copy()
        self._objects = {each.name: each for each in self._world.ordered()}
        self._scenes = Scenes([self._world])
        self._robots = {name: self._scenes.actuators(0, name) for name in self._objects}
        self._robots = {name: (first, end) for name, (first, end) in self._robots.items() if end > first}
        self._targets = np.ones(max((end for _, end in self._robots.values()), default=0))
        is_fixed = {name: bool((each.structure[each.structure > 0] == 5).all()) for name, each in self._objects.items()}
        self._moves = [name for name in self._objects if not is_fixed[name]]
        self._still = {name: self._scenes.points([0], name) for name in self._objects if name not in self._moves}
        self._history: List[Dict[str, Tuple[_Points, _Points]]] = []
        self._turns: List[Dict[str, float]] = []
        self.force_save()

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
        targets = np.asarray(array_of(action), dtype=np.float64).ravel()
        if len(targets) != end - first:
            raise ValueError(f"the action has {len(targets)} values, expected {end - first} for {robot_name}")
        self._targets[first:end] = targets

    def step(self) -> bool:
        """Simulates an env step. Returns whether a robot became unstable; then time and positions stay as they were,
        and only `reset` helps."""
        self._scenes.step(self._targets)
        if self._scenes.faults[0]:
            return True
        self.force_save()
        return False

    def reset(self) -> None:
        """Goes back to time 0."""
        self._scenes.reset(0)
        del self._history[1:], self._turns[1:]

    def force_save(self) -> None:
        """Keeps the positions of now."""
        now = {name: self._scenes.points([0], name) for name in self._moves}
        time = self.get_time()
        del self._history[time:], self._turns[time:]
        self._history.append(now)
        self._turns.append({name: float(self._scenes.turns([0], name)[0]) for name in self._moves})

    def get_time(self) -> int:
        """Env steps since the start."""
        return int(self._scenes.clock[0])

    def pos_at_time(self, time: int) -> _Points:
        """The positions of all points in voxels, shape (2, P), objects in Evolution Gym's order."""
        return np.concatenate([self.object_pos_at_time(time, name) for name in self._objects], axis=1)

    def vel_at_time(self, time: int) -> _Points:
        """The velocities of all points in voxels per second, shape (2, P)."""
        return np.concatenate([self.object_vel_at_time(time, name) for name in self._objects], axis=1)

    def object_pos_at_time(self, time: int, object_name: str) -> _Points:
        """The positions of an object's points in voxels, shape (2, P)."""
        return self._at(time, object_name)[0].T

    def object_vel_at_time(self, time: int, object_name: str) -> _Points:
        """The velocities of an object's points in voxels per second, shape (2, P)."""
        return self._at(time, object_name)[1].T

    def object_orientation_at_time(self, time: int, object_name: str) -> float:
        """How far an object has turned since the start, in radians from 0 to 2π, counterclockwise."""
        self._at(time, object_name)
        return self._turns[time].get(object_name, 0.0)

    def __getstate__(self) -> Dict[str, Any]:
        state = {name: value for name, value in self.__dict__.items() if name != "_scenes"}
        return {**state, "kept": self._scenes._native.state(0)}

    def __setstate__(self, state: Dict[str, Any]) -> None:
        points, clock, fault = state.pop("kept")
        self.__dict__.update(state)
        self._scenes = Scenes([self._world])
        self._scenes._native.restore(0, points, clock, fault)

    def _at(self, time: int, name: str) -> Tuple[_Points, _Points]:
        if name not in self._objects:
            raise ValueError(f"the world has no object `{name}`")
        if not 0 <= time < len(self._history):
            raise ValueError(f"time is {time}, expected 0 to {len(self._history) - 1}")
        return self._still[name] if name in self._still else self._history[time][name]

    def _robot(self, name: str) -> Tuple[int, int]:
        if name not in self._robots:
            raise ValueError(f"the world has no robot `{name}`")
        return self._robots[name]
