"""Bodies, materials and the robots of the library."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from typing import Any, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _nbc

__all__ = ["PAPER_MATERIALS", "Bodies", "Material", "Robot", "invalid", "library", "rows"]

Material = Mapping[str, Any]
"""A material as data: ``name``, ``kind`` (rigid, soft, actuator or sensor), and the numbers of its kind."""

PAPER_MATERIALS: Tuple[Material, ...] = tuple(json.loads(_nbc.paper_materials()))
"""The paper's eight materials, in the order of their codes from 1: rigid, soft, an actuator, an actuator in antiphase,
two sensors that shrink and two that grow while stimulus 1 or 2 is present."""

Codes = npt.NDArray[np.uint8]
OneBody = Union["Robot", npt.NDArray[Any], Sequence[str], Sequence[Sequence[int]]]
Bodies = Union[npt.NDArray[Any], Sequence[OneBody]]
"""Bodies: an integer array of shape (N, H, W), or a sequence of bodies of any sizes, each an integer array of shape
(H, W), rows of digits such as ``["343", "303"]``, or a `Robot`. Row 0 is on top. Code 0 is empty, code k is the k-th
material."""

MOST_SIDE = 100


@dataclass(frozen=True)
class Robot:
    """A body with a known behavior, of the library that comes with nbc."""

    name: str
    function: str
    """The function that it computes as a gate, such as ``nand``."""
    behavior: str
    """Which way it walks under the patterns 00, 01, 10, 11: a letter L or R for each."""
    body: Codes = field(repr=False)
    """Its codes, shape (H, W)."""
    displacement: npt.NDArray[np.float64] = field(repr=False)
    """Voxels walked in the paper's four fixed simulations, shape (4,)."""
    character: Mapping[str, Any] = field(repr=False)
    """Its clock, margin, error rate and settle times as a gate."""
    provenance: Mapping[str, Any] = field(repr=False)
    """The evolution that made it, with seed and version."""
    materials: Tuple[Material, ...] = field(repr=False)
    """The materials of its codes."""

    def _repr_svg_(self) -> str:
        codes, shapes = pack([self.body])
        title = f"{self.name}: {self.function}, {self.behavior}"
        return _nbc.draw_body(title, codes, shapes, pack_materials(self.materials), False)


def library() -> Tuple[Robot, ...]:
    """The evolved robots that come with nbc, best first within each function.

    >>> import nbc
    >>> nand = next(robot for robot in nbc.library() if robot.function == "nand")
    >>> nand.behavior
    'RRRL'
    """
    return tuple(_robot(record) for record in json.loads(_nbc.shipped_robots()))


def invalid(bodies: Bodies, *, materials: Optional[Sequence[Material]] = None) -> List[str]:
    """Why each body cannot take part in an evolution; an empty text for each that can.

    A valid body has at least three actuators, and its voxels are connected by their sides.

    >>> import nbc
    >>> nbc.invalid([["333"], ["33"], ["330", "003"]])
    ['', 'the body has 2 actuators, expected at least 3', 'the body is not in one piece']
    """
    codes, shapes = pack(bodies)
    return _nbc.invalid_bodies(codes, shapes, pack_materials(materials))


def rows(body: OneBody) -> List[str]:
    """A body as rows of digits and lower-case letters, as robot files and the command line have it.

    >>> import numpy as np, nbc
    >>> nbc.rows(np.array([[3, 4, 3], [3, 0, 3]]))
    ['343', '303']
    """
    return ["".join(np.base_repr(code, 36).lower() for code in row) for row in _codes(body, "body").tolist()]


def pack(bodies: Bodies) -> Tuple[Codes, npt.NDArray[np.uint64]]:
    """All codes in reading order, and the rows and columns of each body."""
    if isinstance(bodies, np.ndarray) and bodies.dtype != object:
        if bodies.ndim != 3:
            hint = "; for one body write `body[None]`" if bodies.ndim == 2 else ""
            raise ValueError(f"bodies has the shape {bodies.shape}, expected (N, H, W){hint}")
        codes = _as_codes(bodies, "bodies")
        shapes = np.empty((len(bodies), 2), dtype=np.uint64)
        shapes[:] = bodies.shape[1:]
        return codes.reshape(-1), shapes
    if isinstance(bodies, (str, bytes)) or not isinstance(bodies, (Sequence, np.ndarray)):
        raise TypeError(f"bodies is of type {type(bodies).__name__}, expected an array (N, H, W) or a list of bodies")
    packed = [_codes(body, f"bodies[{i}]") for i, body in enumerate(bodies)]
    shapes = np.array([body.shape for body in packed], dtype=np.uint64).reshape(-1, 2)
    flat = [body.reshape(-1) for body in packed]
    return (np.concatenate(flat) if flat else np.empty(0, dtype=np.uint8)), shapes


def pack_materials(materials: Optional[Sequence[Material]]) -> Optional[str]:
    """Materials as JSON; None for the paper's."""
    if materials is None:
        return None
    if isinstance(materials, (str, bytes, Mapping)) or not isinstance(materials, Sequence):
        raise TypeError(f"materials is of type {type(materials).__name__}, expected a list of mappings")
    try:
        return json.dumps([dict(material) for material in materials], allow_nan=False)
    except ValueError as error:
        raise ValueError("materials: expected finite numbers") from error


def _codes(body: OneBody, name: str) -> Codes:
    if isinstance(body, Robot):
        return body.body
    if isinstance(body, (str, bytes)):
        raise TypeError(f"{name} is a text, expected a list of rows such as ['343', '303']")
    if isinstance(body, Sequence) and body and all(isinstance(row, str) for row in body):
        return _of_rows([str(row) for row in body], name)
    try:
        array = np.asarray(body)
    except ValueError as error:
        raise ValueError(f"{name} has rows of different lengths") from error
    if array.ndim != 2:
        raise ValueError(f"{name} has the shape {array.shape}, expected (H, W)")
    return _as_codes(array, name)


def _of_rows(body: Sequence[str], name: str) -> Codes:
    for number, row in enumerate(body, start=1):
        if len(row) != len(body[0]):
            raise ValueError(f"{name}: row {number} has {len(row)} voxels, expected {len(body[0])} as in row 1")
        wrong = next((digit for digit in row if digit not in "0123456789abcdefghijklmnopqrstuvwxyz"), None)
        if wrong is not None:
            raise ValueError(f"{name}: row {number}: `{wrong}` is not a material code; expected a digit")
    return np.array([[int(digit, 36) for digit in row] for row in body], dtype=np.uint8)


def _as_codes(array: npt.NDArray[Any], name: str) -> Codes:
    if array.dtype == np.uint8:
        return np.ascontiguousarray(array)
    if array.size and not np.issubdtype(array.dtype, np.integer):
        raise TypeError(f"{name} has the dtype {array.dtype}, expected integers")
    if array.size and (array.min() < 0 or array.max() > 255):
        wrong = array.min() if array.min() < 0 else array.max()
        raise ValueError(f"{name}: {wrong} is not a material code; expected 0 to the number of materials")
    return np.ascontiguousarray(array, dtype=np.uint8)


def _robot(record: Mapping[str, Any]) -> Robot:
    return Robot(
        name=record["name"],
        function=record["function"],
        behavior=record["behavior"],
        body=_of_rows(record["body"], "body"),
        displacement=np.array(record["displacement"]),
        character=record["character"],
        provenance=record["provenance"],
        materials=tuple(record["materials"]),
    )
