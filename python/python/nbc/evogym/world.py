"""Worlds of voxels under the names of ``evogym``: `EvoWorld` and `WorldObject`."""

from __future__ import annotations

import copy
import json
from importlib import resources
from typing import Any, Dict, List, Mapping, Optional, Tuple

import numpy as np
import numpy.typing as npt

from ..numbers import array_of, count
from .exchange import _check, _whole
from .utils import get_full_connectivity, is_connected

__all__ = ["EvoWorld", "WorldObject"]

_LETTERS = ".RSHVF"


class WorldObject:
    """An object: voxels in one piece, and the place of its lower left corner.

    Attributes:
        name: how `EvoSim` calls it.
        structure: the codes of its voxels, row 0 on top, shape (H, W).
        pos: column and row of its lower left corner in the world.
    """

    def __init__(self) -> None:
        self.name = ""
        self.structure: npt.NDArray[np.int64] = np.zeros((0, 0), dtype=np.int64)
        self.pos = (0, 0)

    @classmethod
    def from_array(
        cls, name: str, structure: npt.ArrayLike, connections: Optional[npt.ArrayLike] = None
    ) -> WorldObject:
        """An object of an array of codes, at the origin.

        Raises:
            ValueError: for other shapes and codes, voxels that are not in one piece, and neighbors that are not joined.
        """
        codes = array_of(structure)
        if codes.ndim != 2:
            raise ValueError(f"the structure has the shape {codes.shape}, expected (H, W)")
        codes = _whole(codes, "the structure")
        for row, column in np.argwhere((codes < 0) | (codes > 5)).tolist():
            place = f"row {row + 1}, column {column + 1}"
            raise ValueError(f"{place}: {codes[row, column]} is not a voxel, expected 0 to 5")
        if not is_connected(codes):
            raise ValueError(f"the object `{name}` is not in one piece")
        if connections is not None:
            _check(codes, array_of(connections))
        made = cls()
        made.name, made.structure = name, codes
        return made

    @classmethod
    def from_json(cls, file_path: str) -> WorldObject:
        """The only object of a world in a file of Evolution Gym's design tool."""
        objects = EvoWorld.from_json(file_path).objects
        if len(objects) != 1:
            raise ValueError(f"{file_path} has {len(objects)} objects, expected one")
        return next(iter(objects.values()))

    @property
    def grid(self) -> npt.NDArray[np.int64]:
        """The codes with the lowest row first, as Evolution Gym has them."""
        return np.flipud(self.structure)

    def get_structure(self) -> npt.NDArray[np.int64]:
        """The codes of its voxels, row 0 on top."""
        return self.structure.copy()

    def get_connections(self) -> npt.NDArray[np.int64]:
        """The connections of all its voxels, shape (2, edges)."""
        return get_full_connectivity(self.structure)

    def get_pos(self) -> Tuple[int, int]:
        """Column and row of its lower left corner."""
        return self.pos

    def set_pos(self, x: int, y: int) -> None:
        """Moves it."""
        self.pos = (count(x, "x"), count(y, "y"))

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
    (20, 3)
    """

    def __init__(self) -> None:
        self.objects: Dict[str, WorldObject] = {}

    @classmethod
    def from_json(cls, file_path: str) -> EvoWorld:
        """The world of a file of Evolution Gym's design tool."""
        with open(file_path, encoding="utf-8") as file:
            return cls._from_cells(json.load(file), str(file_path))

    @classmethod
    def of_task(cls, name: str) -> EvoWorld:
        """The world of a task of Evolution Gym, such as ``"UpStepper-v0"``, without its robot."""
        text = resources.files(__package__).joinpath("worlds.json").read_text(encoding="utf-8")
        known = json.loads(text)["worlds"]
        if name not in known:
            raise ValueError(f"there is no world {name!r}")
        world = cls()
        for each in known[name]:
            rows = [[int(code) for code, times in runs for _ in range(times)] for runs in each["rows"]]
            world.add_from_array(each["name"], np.array(rows), *each["at"])
        return world

    @classmethod
    def _from_cells(cls, data: Any, path: str) -> EvoWorld:
        try:
            width = int(data["grid_width"])
            world = cls()
            for name, found in data["objects"].items():
                world.add_object(_read_object(name, found, width))
        except (KeyError, TypeError, AttributeError) as error:
            raise ValueError(f"{path} is not a world of Evolution Gym: {error!r} was expected in it") from None
        return world

    @property
    def grid_size(self) -> Tuple[int, int]:
        """Columns and rows up to the last voxel."""
        cells = [cell for each in self.objects.values() for cell in each._cells()]
        return (max((x for x, _ in cells), default=-1) + 1, max((y for _, y in cells), default=-1) + 1)

    def add_object(self, obj: WorldObject) -> None:
        """Adds a copy of an object.

        Raises:
            ValueError: when its name is taken, or it overlaps another.
        """
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
        before = self.remove_object(obj_name)
        moved = before.copy()
        moved.set_pos(x, y)
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
        width, height = self.grid_size
        cells = {cell: code for each in self.objects.values() for cell, code in each._cells().items()}
        for start in range(0, width, voxels_per_line):
            for row in reversed(range(height)):
                columns = range(start, min(width, start + voxels_per_line))
                print(f"{row:3} |", *(_LETTERS[cells.get((column, row), 0)] for column in columns))

    def copy(self) -> EvoWorld:
        """A copy."""
        return copy.deepcopy(self)

    def ordered(self) -> List[WorldObject]:
        """The objects in the order of Evolution Gym: those with actuators first, and each kind by name."""
        is_passive = {name: not np.isin(each.structure, (3, 4)).any() for name, each in self.objects.items()}
        return [self.objects[name] for name in sorted(self.objects, key=lambda name: (is_passive[name], name))]


def _read_object(name: str, found: Mapping[str, Any], width: int) -> WorldObject:
    """An object of a file: the numbers of its cells, their codes, and their neighbors."""
    numbers = [int(number) for number in found["indices"]]
    if not numbers:
        raise ValueError(f"the object `{name}` has no voxels")
    columns, rows = [number % width for number in numbers], [number // width for number in numbers]
    left, bottom, top = min(columns), min(rows), max(rows)
    structure = np.zeros((top - bottom + 1, max(columns) - left + 1), dtype=np.int64)
    for column, row, code in zip(columns, rows, found["types"]):
        structure[top - row, column - left] = code
    across = structure.shape[1]
    local = {number: (top - row) * across + column - left for number, column, row in zip(numbers, columns, rows)}
    joined = {
        tuple(sorted((local[number], local[int(other)])))
        for number in numbers
        for other in found["neighbors"][str(number)]
    }
    edges = np.array(sorted(joined), dtype=np.int64).reshape(-1, 2).T
    made = WorldObject.from_array(name, structure, edges)
    made.set_pos(left, bottom)
    return made
