"""Interchange of bodies with Evolution Gym.

Evolution Gym numbers its voxels 0 empty, 1 rigid, 2 soft, 3 horizontal actuator, 4 vertical actuator, and an array of
connections says which neighbors are joined. Bodies of nbc are always joined to all neighbors, and their code 4 is a
horizontal actuator in antiphase. Codes 0 to 3 mean the same in both. A body with something that the other side lacks
is refused with the reason, never changed silently.

Evolution Gym itself is not needed.
"""

from __future__ import annotations

from typing import Any, Optional, Tuple

import numpy as np
import numpy.typing as npt

from .bodies import OneBody, pack

__all__ = ["connections", "from_structure", "to_structure"]

_MATERIALS = {
    4: "an actuator in antiphase; Evolution Gym's 4 is a vertical actuator",
    5: "a sensor, which Evolution Gym does not have",
    6: "a sensor, which Evolution Gym does not have",
    7: "a sensor, which Evolution Gym does not have",
    8: "a sensor, which Evolution Gym does not have",
}


def to_structure(body: OneBody) -> Tuple[npt.NDArray[np.int64], npt.NDArray[np.int64]]:
    """A body as ``EvoGymBase.add_from_array`` and ``evogym.make(body=..., connections=...)`` take it.

    Returns:
        The structure, shape (H, W), and the connections, shape (2, edges).

    Raises:
        ValueError: for a body with materials that Evolution Gym does not have, at the first of them.

    >>> import nbc
    >>> structure, joined = nbc.evogym.to_structure(["33", "12"])
    >>> structure.tolist(), joined.tolist()
    ([[3, 3], [1, 2]], [[0, 0, 1, 2], [1, 2, 3, 3]])
    """
    codes, shapes = pack([body])
    structure = codes.reshape(tuple(int(side) for side in shapes[0])).astype(np.int64)
    for row, column in np.argwhere(structure > 3).tolist():
        code = int(structure[row, column])
        reason = _MATERIALS.get(code, "not one of the paper's materials")
        raise ValueError(f"row {row + 1}, column {column + 1}: {code} is {reason}")
    return structure, connections(structure)


def from_structure(
    structure: npt.ArrayLike, connections: Optional[npt.ArrayLike] = None
) -> npt.NDArray[np.uint8]:
    """The body of Evolution Gym's structure, for `simulate`.

    The horizontal actuators of the body move with the sine of nbc's code 3; Evolution Gym's are moved by a controller.

    Args:
        structure: an array of shape (H, W).
        connections: an array of shape (2, edges), or None if all neighbors are joined.

    Raises:
        TypeError, ValueError: for other shapes and dtypes, vertical actuators, fixed voxels, neighbors that are not
            joined, and connections between voxels that are no neighbors.

    >>> import nbc
    >>> nbc.evogym.from_structure([[3, 3], [1, 2]]).tolist()
    [[3, 3], [1, 2]]
    """
    array = np.asarray(structure)
    if array.ndim != 2:
        raise ValueError(f"the structure has the shape {array.shape}, expected (H, W)")
    array = _whole(array, "the structure")
    for row, column in np.argwhere((array < 0) | (array > 3)).tolist():
        raise ValueError(f"row {row + 1}, column {column + 1}: {_reason(int(array[row, column]))}")
    if not array.any():
        raise ValueError("the structure has no voxels")
    if connections is not None:
        _check(array, np.asarray(connections))
    return array.astype(np.uint8)


def connections(structure: npt.NDArray[Any]) -> npt.NDArray[np.int64]:
    """The connections of all neighbors of a structure, shape (2, edges), in Evolution Gym's order: the numbers of two
    voxels in reading order, the smaller first."""
    height, width = structure.shape
    number = np.arange(height * width).reshape(height, width)
    edges = []
    for row in range(height):
        for column in range(width):
            for below, right in ((0, 1), (1, 0)):
                at = (row + below, column + right)
                inside = at[0] < height and at[1] < width
                if inside and structure[row, column] and structure[at]:
                    edges.append((number[row, column], number[at]))
    return np.array(edges, dtype=np.int64).reshape(-1, 2).T


def _reason(code: int) -> str:
    if code == 4:
        return "4 is a vertical actuator, which nbc does not have; its 4 is a horizontal actuator in antiphase"
    if code == 5:
        return "5 is a fixed voxel, such as terrain; nbc has one flat ground and no objects"
    return f"{code} is not a voxel of Evolution Gym"


def _whole(array: npt.NDArray[Any], name: str) -> npt.NDArray[np.int64]:
    """Whole numbers; Evolution Gym's own arrays may be floats."""
    if array.dtype.kind not in "iuf":
        raise TypeError(f"{name} has the dtype {array.dtype}, expected numbers")
    whole = np.isfinite(array) & (np.mod(array, 1) == 0)
    if not whole.all():
        raise ValueError(f"{name} has the value {array[~whole].flat[0]}, expected whole numbers")
    return array.astype(np.int64)


def _check(structure: npt.NDArray[np.int64], given: npt.NDArray[Any]) -> None:
    if given.ndim != 2 or given.shape[0] != 2:
        raise ValueError(f"the connections have the shape {given.shape}, expected (2, edges)")
    pairs = np.sort(_whole(given, "the connections"), axis=0)
    found = {(int(a), int(b)) for a, b in pairs.T}
    expected = {(int(a), int(b)) for a, b in connections(structure).T}
    width = structure.shape[1]
    for a, b in sorted(expected - found):
        raise ValueError(
            f"{_place(a, width)} and {_place(b, width)} are not connected; "
            "the voxels of nbc are joined to all neighbors"
        )
    for a, b in sorted(found - expected):
        raise ValueError(f"{_place(a, width)} and {_place(b, width)} are connected, but are not neighboring voxels")


def _place(number: int, width: int) -> str:
    return f"row {number // width + 1}, column {number % width + 1}"
