"""Interchange of bodies with Evolution Gym.

Evolution Gym numbers its voxels 0 empty, 1 rigid, 2 soft, 3 horizontal actuator, 4 vertical actuator, and an array of
connections says which neighbors are joined. Bodies of nbc are always joined to all neighbors, and their code 4 is a
horizontal actuator in antiphase. Codes 0 to 3 mean the same in both. A body with something that the other side lacks
is refused with the reason, never changed silently.

All active voxels of nbc, codes 3 to 8, are one material and differ in their target widths only (docs/physics.md 1 and
10). So ``to_structure(body, as_actuators=True)`` makes horizontal actuators of all of them, and `actions` has the width
of each in each env step, for ``set_action``. Evolution Gym then simulates what nbc does.

Evolution Gym itself is not needed.
"""

from __future__ import annotations

from typing import Any, List, Optional, Tuple

import numpy as np
import numpy.typing as npt

from .. import _nbc
from ..bodies import PAPER_MATERIALS, OneBody, Robot, check_materials, read
from ..numbers import array_of, whole
from ..physics import CYCLE_STEPS, Schedule, pack_schedule

__all__ = ["actions", "connections", "from_structure", "to_structure"]

_SENSOR = "a sensor, which Evolution Gym does not have"
_MATERIALS = {
    4: "an actuator in antiphase; Evolution Gym's 4 is a vertical actuator",
    **{code: _SENSOR for code in (5, 6, 7, 8)},
}
# The stimulus of each sensor, counted from 0, and its widths while that is absent and present.
_SENSORS = {5: (0, 1.6, 0.6), 6: (1, 1.6, 0.6), 7: (0, 0.6, 1.6), 8: (1, 0.6, 1.6)}


def to_structure(
    body: OneBody, *, as_actuators: bool = False
) -> Tuple[npt.NDArray[np.int64], npt.NDArray[np.int64]]:
    """A body as ``EvoGymBase.add_from_array`` and ``evogym.make(body=..., connections=...)`` take it.

    Args:
        body: a body of the paper's materials.
        as_actuators: whether codes 4 to 8 become horizontal actuators, to be moved by `actions`.

    Returns:
        The structure, shape (H, W), and the connections, shape (2, edges).

    Raises:
        ValueError: for a body with materials that Evolution Gym does not have, at the first of them, and for a robot of
            materials that are not the paper's.

    >>> import nbc
    >>> structure, joined = nbc.evogym.to_structure(["33", "12"])
    >>> structure.tolist(), joined.tolist()
    ([[3, 3], [1, 2]], [[0, 0, 1, 2], [1, 2, 3, 3]])
    """
    structure = _paper_codes(body)
    for row, column in np.argwhere(structure > 3).tolist():
        if as_actuators:
            break
        code = int(structure[row, column])
        hint = "; `as_actuators=True` makes it a horizontal actuator, to be moved by `nbc.evogym.actions`"
        raise ValueError(f"row {row + 1}, column {column + 1}: {code} is {_MATERIALS[code]}{hint}")
    structure = np.minimum(structure, 3)
    return structure, connections(structure)


def actions(body: OneBody, schedule: Schedule) -> npt.NDArray[np.float64]:
    """The target widths of all active voxels under a schedule, as nbc simulates them.

    Args:
        body: a body of the paper's materials.
        schedule: the stimuli over time; see `simulate`.

    Returns:
        An array of shape (env steps, active voxels): row ``t`` is for ``EvoSim.set_action`` before env step ``t``, with
        the voxels in reading order, as those of ``get_actuator_indices``.

    >>> import nbc
    >>> nbc.evogym.actions(["35"], "00*1 10*1")[[0, 84]].tolist()
    [[1.1, 1.6], [1.1, 0.6]]
    """
    codes = _paper_codes(body)
    active = codes[codes >= 3]
    steps = [pattern for pattern, length in _nbc.read_schedule(pack_schedule(schedule)) for _ in range(length)]
    phase = 2 * np.pi * (np.arange(len(steps)) % CYCLE_STEPS) / (CYCLE_STEPS - 1)
    targets = np.empty((len(steps), len(active)))
    for column, code in enumerate(active.tolist()):
        if code in _SENSORS:
            stimulus, absent, present = _SENSORS[code]
            targets[:, column] = [present if pattern[stimulus : stimulus + 1] == "1" else absent for pattern in steps]
        else:
            targets[:, column] = 0.6 + (np.sin(phase if code == 3 else np.pi + phase) + 1) / 2
    return np.clip(targets, 0.6, 1.6)


def _paper_codes(body: OneBody) -> npt.NDArray[np.int64]:
    codes = read(body, "body").astype(np.int64)
    if isinstance(body, Robot):
        check_materials(codes, body.materials, PAPER_MATERIALS, "body", "the paper's materials")
    for row, column in np.argwhere(codes > 8).tolist():
        code = int(codes[row, column])
        raise ValueError(f"row {row + 1}, column {column + 1}: {code} is not one of the paper's materials")
    return codes


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
    array = structure_of(structure)
    for row, column in np.argwhere(array > 3).tolist():
        raise ValueError(f"row {row + 1}, column {column + 1}: {_reason(int(array[row, column]))}")
    if not array.any():
        raise ValueError("the structure has no voxels")
    if connections is not None:
        _check(array, array_of(connections))
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


def structure_of(structure: npt.ArrayLike) -> npt.NDArray[np.int64]:
    """A structure as whole numbers; Evolution Gym's own arrays may be floats."""
    array = array_of(structure)
    if array.ndim != 2:
        raise ValueError(f"the structure has the shape {array.shape}, expected (H, W)")
    return whole(array, "the structure", most=5)


def _reason(code: int) -> str:
    if code == 4:
        return "4 is a vertical actuator, which these bodies do not have; their 4 is a horizontal actuator in antiphase"
    return "5 is a fixed voxel, such as terrain; `nbc.evogym.EvoWorld` has them"


def _check(structure: npt.NDArray[np.int64], given: npt.NDArray[Any]) -> None:
    for a, b in apart(structure, given):
        raise ValueError(not_joined(structure, a, b))


def apart(structure: npt.NDArray[np.int64], given: npt.NDArray[Any]) -> List[Tuple[int, int]]:
    """The neighbors that connections leave apart, by their numbers in reading order.

    Raises:
        ValueError: for other shapes, and connections between voxels that are no neighbors.
    """
    if given.ndim != 2 or given.shape[0] != 2:
        raise ValueError(f"the connections have the shape {given.shape}, expected (2, edges)")
    pairs = np.sort(whole(given, "the connection", most=structure.size - 1), axis=0)
    found = {(int(a), int(b)) for a, b in pairs.T}
    expected = {(int(a), int(b)) for a, b in connections(structure).T}
    width = structure.shape[1]
    for a, b in sorted(found - expected):
        raise ValueError(f"{_place(a, width)} and {_place(b, width)} are connected, but are not neighboring voxels")
    return sorted(expected - found)


def not_joined(structure: npt.NDArray[np.int64], a: int, b: int) -> str:
    """Why a body whose neighbors a and b are apart cannot be simulated."""
    places = f"{_place(a, structure.shape[1])} and {_place(b, structure.shape[1])}"
    return f"{places} are not connected; the voxels of nbc are joined to all neighbors"


def _place(number: int, width: int) -> str:
    return f"row {number // width + 1}, column {number % width + 1}"
