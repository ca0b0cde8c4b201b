"""Worlds of voxels under the names of ``evogym``: `EvoWorld` and `WorldObject`."""

from __future__ import annotations

import copy
import json
import os
from functools import lru_cache
from importlib import resources
from typing import Any, Dict, List, Mapping, Optional, Tuple

import numpy as np
import numpy.typing as npt

from ..numbers import array_of, count, whole
from .exchange import apart, structure_of
from .utils import Pair, get_full_connectivity, is_connected

__all__ = ["EvoWorld", "WorldObject"]

_LETTERS = ".RSHVF"
DATA_PATH = os.path.join(os.path.dirname(os.path.abspath(__file__)), "sim_files")
"""The folder in which scripts look for the worlds of tasks. They are not files, but `EvoWorld.from_json` knows them."""


class WorldObject:
    """An object: voxels in one piece, and the place of its lower left corner.

    Attributes:
        name: how `EvoSim` calls it.
        structure: the codes of its voxels, row 0 on top, shape (H, W).
        pos: column and row of its lower left corner in the world.
        apart: the neighbors that are not joined, by their numbers in the flattened structure.
    """

    def __init__(self) -> None:
        self.name = ""
        self.structure: npt.NDArray[np.int64] = np.zeros((0, 0), dtype=np.int64)
        self.pos = Pair(0, 0)
        self.apart: List[Tuple[int, int]] = []

    @classmethod
    def from_array(
        cls, name: str, structure: npt.ArrayLike, connections: Optional[npt.ArrayLike] = None
    ) -> WorldObject:
        """An object of an array of codes, at the origin.

        Raises:
            ValueError: for other shapes and codes, voxels that are not in one piece, and connections between voxels
                that are no neighbors.
        """
        made = cls()
        made.load_from_array(name, structure, connections)
        return made

    def load_from_array(
        self, name: str, structure: npt.ArrayLike, connections: Optional[npt.ArrayLike] = None
    ) -> None:
        """Becomes an object of an array of codes, at the origin; see `from_array`."""
        codes = structure_of(structure)
        if not is_connected(codes):
            raise ValueError(f"the object `{name}` is not in one piece")
        self.apart = [] if connections is None else apart(codes, array_of(connections))
        self.name, self.structure, self.pos = name, codes, Pair(0, 0)

    @classmethod
    def from_json(cls, file_path: str) -> WorldObject:
        """The only object of a world in a file of Evolution Gym's design tool."""
        objects = EvoWorld.from_json(file_path).objects
        if len(objects) != 1:
            raise ValueError(f"{file_path} has {len(objects)} objects, expected one")
        return next(iter(objects.values()))

    def load_from_json(self, file_path: str) -> None:
        """Becomes the only object of a world in a file of Evolution Gym's design tool."""
        self.__dict__.update(WorldObject.from_json(file_path).__dict__)

    def load_from_parsed_json(self, name: str, json_data: Any, grid_size: Tuple[int, int]) -> None:
        """Becomes an object of such a file, with the columns and rows of its world."""
        self.__dict__.update(_read_object(name, json_data, grid_size[0]).__dict__)

    @property
    def grid_size(self) -> Pair:
        """Columns and rows."""
        height, width = self.structure.shape
        return Pair(width, height)

    @property
    def voxels(self) -> List[Pair]:
        """The column and row of each voxel, the lowest row first."""
        return [Pair(column, row) for row, column in np.argwhere(self.grid != 0).tolist()]

    @property
    def neighbors(self) -> Dict[Pair, List[Pair]]:
        """The voxels to which each voxel is joined, by column and row."""
        width, height = self.grid_size
        found: Dict[Pair, List[Pair]] = {}
        for ends in self.get_connections().T.tolist():
            a, b = (Pair(number % width, height - 1 - number // width) for number in ends)
            found.setdefault(a, []).append(b)
            found.setdefault(b, []).append(a)
        return found

    @property
    def grid(self) -> npt.NDArray[np.int64]:
        """The codes with the lowest row first, as Evolution Gym has them."""
        return np.flipud(self.structure)

    def get_structure(self) -> npt.NDArray[np.int64]:
        """The codes of its voxels, row 0 on top."""
        return self.structure.copy()

    def get_connections(self) -> npt.NDArray[np.int64]:
        """The connections of its voxels, shape (2, edges), each once."""
        edges = get_full_connectivity(self.structure)
        is_joined = [(a, b) not in self.apart for a, b in edges.T.tolist()]
        return edges[:, is_joined] if self.apart else edges

    def is_joined(self) -> bool:
        """Whether its connections join all of its voxels."""
        if not self.apart:
            return True
        left = set(np.flatnonzero(self.structure).tolist())
        beside: Dict[int, List[int]] = {}
        for a, b in self.get_connections().T.tolist():
            beside.setdefault(a, []).append(b)
            beside.setdefault(b, []).append(a)
        found = [left.pop()]
        while found:
            reached = left.intersection(beside.get(found.pop(), ()))
            left -= reached
            found += reached
        return not left

    def get_pos(self) -> Tuple[int, int]:
        """Column and row of its lower left corner."""
        return (self.pos[0], self.pos[1])

    def set_pos(self, x: int, y: int) -> None:
        """Moves it."""
        self.pos = Pair(count(x, "x"), count(y, "y"))

    def translate(self, dx: int, dy: int) -> None:
        """Moves it by some voxels."""
        self.set_pos(self.pos[0] + dx, self.pos[1] + dy)

    def rename(self, name: str) -> None:
        """Changes its name."""
        self.name = name

    def get_name(self) -> str:
        """Its name."""
        return self.name

    def copy(self) -> WorldObject:
        """A copy."""
        return copy.deepcopy(self)

    def __repr__(self) -> str:
        height, width = self.structure.shape
        return f"WorldObject({self.name!r}, {height} x {width} at {self.pos})"

    def _cells(self) -> Dict[Tuple[int, int], int]:
        """The code of each cell of the world that it fills."""
        left, bottom = self.pos
        filled = np.argwhere(self.grid != 0).tolist()
        return {(left + column, bottom + row): int(self.grid[row, column]) for row, column in filled}


class EvoWorld:
    """A world: objects by name, none of which overlap.

    >>> import numpy as np
    >>> from nbc.evogym import EvoWorld
    >>> world = EvoWorld()
    >>> world.add_from_array("ground", np.full((1, 20), 5), 0, 0)
    >>> world.add_from_array("robot", np.array([[3, 3], [4, 4]]), 2, 1)
    >>> world.grid_size
    Pair(20, 3)
    """

    def __init__(self) -> None:
        self.objects: Dict[str, WorldObject] = {}

    @classmethod
    def from_json(cls, file_path: str) -> EvoWorld:
        """The world of a file of Evolution Gym's design tool."""
        world = cls()
        world.add_from_json(file_path)
        return world

    def add_from_json(self, file_path: str) -> None:
        """Adds the objects of such a file, or none of them if one cannot be added."""
        before = dict(self.objects)
        try:
            for each in _objects_of(file_path):
                self.add_object(each)
        except ValueError:
            self.objects = before
            raise

    @classmethod
    def of_task(cls, name: str) -> EvoWorld:
        """The world of a task of Evolution Gym, such as ``"UpStepper-v0"``, without its robot."""
        known = _task_worlds()
        if name not in known:
            raise ValueError(f"there is no world {name!r}")
        world = cls()
        for each in known[name]:
            rows = [[int(code) for code, times in runs for _ in range(times)] for runs in each["rows"]]
            world.add_from_array(each["name"], np.array(rows), *each["at"])
        return world

    @property
    def grid_size(self) -> Pair:
        """Columns and rows up to the last voxel, at least one."""
        cells = [cell for each in self.objects.values() for cell in each._cells()]
        return Pair(max((x for x, _ in cells), default=0) + 1, max((y for _, y in cells), default=0) + 1)

    @property
    def grid(self) -> npt.NDArray[np.int64]:
        """The codes of all cells, the lowest row first."""
        width, height = self.grid_size
        grid = np.zeros((height, width), dtype=np.int64)
        for each in self.objects.values():
            for (x, y), code in each._cells().items():
                grid[y, x] = code
        return grid

    def add_object(self, obj: WorldObject) -> None:
        """Adds a copy of an object.

        Raises:
            ValueError: when its name is taken, or it overlaps another.
        """
        if not isinstance(obj, WorldObject):
            raise TypeError(f"the object is of type {type(obj).__name__}, expected WorldObject")
        if obj.name in self.objects:
            raise ValueError(f"the world has an object `{obj.name}` already")
        cells = set(obj._cells())
        for name, other in self.objects.items():
            if not cells.isdisjoint(other._cells()):
                raise ValueError(f"the objects `{obj.name}` and `{name}` overlap")
        self.objects[obj.name] = obj.copy()

    def add_from_array(
        self, name: str, structure: npt.ArrayLike, x: int, y: int, connections: Optional[npt.ArrayLike] = None
    ) -> None:
        """Adds an object of an array of codes, row 0 on top, with its lower left corner in a column and row."""
        made = WorldObject.from_array(name, structure, connections)
        made.set_pos(x, y)
        self.add_object(made)

    def remove_object(self, obj_name: str) -> WorldObject:
        """Takes an object out."""
        if obj_name not in self.objects:
            raise ValueError(f"the world has no object `{obj_name}`")
        return self.objects.pop(obj_name)

    def move_object(self, obj_name: str, x: int, y: int) -> None:
        """Moves an object."""
        if obj_name not in self.objects:
            raise ValueError(f"the world has no object `{obj_name}`")
        moved = self.objects[obj_name].copy()
        moved.set_pos(x, y)
        before = self.remove_object(obj_name)
        try:
            self.add_object(moved)
        except ValueError:
            self.objects[obj_name] = before
            raise

    def translate_object(self, obj_name: str, dx: int, dy: int) -> None:
        """Moves an object by some voxels."""
        if obj_name not in self.objects:
            raise ValueError(f"the world has no object `{obj_name}`")
        x, y = self.objects[obj_name].pos
        self.move_object(obj_name, x + dx, y + dy)

    def pretty_print(self, voxels_per_line: int = 50) -> None:
        """Prints the world: R rigid, S soft, H and V actuators, F fixed."""
        grid = self.grid
        height, width = grid.shape
        for start in range(0, width, voxels_per_line):
            for row in reversed(range(height)):
                print(f"{row:3} |", *(_LETTERS[code] for code in grid[row, start : start + voxels_per_line]))

    def copy(self) -> EvoWorld:
        """A copy."""
        return copy.deepcopy(self)

    def ordered(self) -> List[WorldObject]:
        """The objects in the order of Evolution Gym: those with actuators first, and each kind by name."""
        is_passive = {name: not np.isin(each.structure, (3, 4)).any() for name, each in self.objects.items()}
        return [self.objects[name] for name in sorted(self.objects, key=lambda name: (is_passive[name], name))]


@lru_cache(maxsize=None)
def _task_worlds() -> Dict[str, Any]:
    """The objects of the worlds of all tasks."""
    text = resources.files(__package__).joinpath("worlds.json").read_text(encoding="utf-8")
    found: Dict[str, Any] = json.loads(text)["worlds"]
    return found


def _objects_of(file_path: str) -> List[WorldObject]:
    """The objects of a file of Evolution Gym's design tool."""
    folder, name = os.path.split(os.path.abspath(file_path))
    if folder == DATA_PATH:
        return list(EvoWorld.of_task(name.removesuffix(".json")).objects.values())
    with open(file_path, encoding="utf-8") as file:
        data = json.load(file)
    try:
        width = count(data["grid_width"], "grid_width", least=1)
        return [_read_object(name, found, width) for name, found in data["objects"].items()]
    except (KeyError, TypeError, AttributeError) as error:
        raise ValueError(f"{file_path} is not a world of Evolution Gym: {error!r} was expected in it") from None


def _read_object(name: str, found: Mapping[str, Any], width: int) -> WorldObject:
    """An object of a file: the numbers of its cells, their codes, and their neighbors."""
    numbers = whole(found["indices"], f"the indices of `{name}`").tolist()
    codes = whole(found["types"], f"the types of `{name}`", most=5).tolist()
    if not numbers or len(codes) != len(numbers):
        raise ValueError(f"the object `{name}` has {len(numbers)} voxels with {len(codes)} types")
    columns, rows = [number % width for number in numbers], [number // width for number in numbers]
    left, bottom, top = min(columns), min(rows), max(rows)
    structure = np.zeros((top - bottom + 1, max(columns) - left + 1), dtype=np.int64)
    for column, row, code in zip(columns, rows, codes):
        structure[top - row, column - left] = code
    across = structure.shape[1]
    local = {number: (top - row) * across + column - left for number, column, row in zip(numbers, columns, rows)}
    joined = {
        tuple(sorted((local[number], local[other])))
        for number in numbers
        for other in found["neighbors"][str(number)]
    }
    edges = np.array(sorted(joined), dtype=np.int64).reshape(-1, 2).T
    made = WorldObject.from_array(name, structure, edges)
    made.set_pos(left, bottom)
    return made
