"""Bodies, materials and the robots of the library."""

from __future__ import annotations

import json
import os
from dataclasses import dataclass, field
from typing import Any, Dict, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _nbc
from .numbers import array_of, is_array
from .progress import Progress, reporting

__all__ = ["PAPER_MATERIALS", "THREE_MATERIALS", "Bodies", "Material", "Robot", "invalid", "library", "rows", "verify"]

Material = Mapping[str, Any]
"""A material as data: ``name``, ``kind`` (rigid, soft, actuator or sensor), and the numbers of its kind."""

PAPER_MATERIALS: Tuple[Material, ...] = tuple(json.loads(_nbc.paper_materials()))
"""The paper's eight materials, in the order of their codes from 1: rigid, soft, an actuator, an actuator in antiphase,
two sensors that shrink and two that grow while stimulus 1 or 2 is present."""

THREE_MATERIALS: Tuple[Material, ...] = tuple(json.loads(_nbc.three_materials()))
"""The paper's eight materials, and codes 9 and 10 that shrink and grow while stimulus 3 is present."""

Codes = npt.NDArray[np.uint8]
OneBody = Union["Robot", npt.NDArray[Any], Sequence[str], Sequence[Sequence[int]]]
Bodies = Union[npt.NDArray[Any], Sequence[OneBody]]
"""Bodies: an integer array of shape (N, H, W), or a sequence of bodies of any sizes, each an integer array of shape
(H, W), rows of digits such as ``["343", "303"]``, or a `Robot`. Row 0 is on top. Code 0 is empty, code k is the k-th
material: of a robot its own, of others that of the argument ``materials``, by default the paper's. A code that would
be two materials in one call is a ValueError. Arrays may be of numpy or of any library whose arrays have ``__array__``
or ``__dlpack__``, such as JAX.

All shapes of the package are (rows, columns), as those of numpy."""

MOST_SIDE = 100
MOST_BODIES = 10_000_000


@dataclass(frozen=True, eq=False)
class Robot:
    """A body with a known behavior, of a library."""

    name: str
    function: str
    """The function that it computes as a gate, such as ``nand``."""
    behavior: str
    """Which way it walks under each pattern, a letter L or R: 00, 01, 10, 11, or 000 to 111 for three stimuli."""
    body: Codes = field(repr=False)
    """Its codes, shape (H, W)."""
    displacement: npt.NDArray[np.float64] = field(repr=False)
    """Voxels walked in the paper's fixed simulations, one for each pattern: shape (4,), or (8,) for three stimuli."""
    character: Mapping[str, Any] = field(repr=False)
    """Its clock, margin, error rate and settle times as a gate."""
    provenance: Mapping[str, Any] = field(repr=False)
    """The evolution that made it, with seed and version."""
    materials: Tuple[Material, ...] = field(repr=False)
    """The materials of its codes."""
    file: str = field(default="", repr=False)
    """The text of its robot file."""

    def save(self, folder: Union[str, "os.PathLike[str]"]) -> str:
        """Writes its robot file into a folder, which a library of a program can name, and returns the path."""
        os.makedirs(folder, exist_ok=True)
        path = os.path.join(os.fspath(folder), f"{self.name}.yaml")
        _nbc.write_file(path, self.file)
        return path

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Robot):
            return NotImplemented
        own, its = dict(vars(self)), dict(vars(other))
        arrays = all(np.array_equal(own.pop(name), its.pop(name)) for name in ("body", "displacement"))
        return arrays and own == its

    def __hash__(self) -> int:
        return hash((self.name, self.body.tobytes()))

    def _repr_svg_(self) -> str:
        packed = pack([self])
        title = f"{self.name}: {self.function}, {self.behavior}"
        return _nbc.draw_body(title, packed.codes, packed.shapes, packed.materials, False)


def library(name: Union[str, "os.PathLike[str]"] = "shipped") -> Tuple[Robot, ...]:
    """The robots of a library, best first within each function.

    Args:
        name: ``shipped`` for the evolved robots that come with nbc, ``three`` for those and others with three stimuli,
            or a folder of robot files.

    Raises:
        NbcError: when the folder or one of its files cannot be read.

    >>> import nbc
    >>> nand = next(robot for robot in nbc.library() if robot.function == "nand")
    >>> nand.behavior
    'RRRL'
    >>> next(robot.behavior for robot in nbc.library("three") if robot.function == "and3")
    'LLLLLLLR'
    """
    return tuple(_robot(record) for record in json.loads(_nbc.robots(os.fspath(name))))


def verify(
    name: Union[str, "os.PathLike[str]"] = "shipped", *, progress: Progress = False
) -> Dict[str, Tuple[str, ...]]:
    """Measures every robot of a library again, as ``nbc library verify`` does.

    Args:
        name: a library, as in `library`.
        progress: whether to show a tqdm bar, or a function of the work done and all work.

    Returns:
        For each robot, by its name, what differs from its file; an empty tuple if nothing does.

    Raises:
        NbcError: when the folder or one of its files cannot be read.
    """
    with reporting(progress, " robots") as report:
        found = _nbc.verify(os.fspath(name), report)
    return {robot: tuple(differs) for robot, differs in found}


def invalid(bodies: Bodies, *, materials: Optional[Sequence[Material]] = None) -> List[str]:
    """Why each body cannot take part in an evolution; an empty text for each that can.

    A valid body has at least three actuators, and its voxels are connected by their sides.

    >>> import nbc
    >>> nbc.invalid([["333"], ["33"], ["330", "003"]])
    ['', 'the body has 2 actuators, expected at least 3', 'the body is not in one piece']
    """
    packed = pack(bodies, materials)
    reasons = _nbc.invalid_bodies(packed.codes, packed.shapes, packed.materials)
    return [packed.errors.get(number, reason) for number, reason in enumerate(reasons)]


def rows(body: OneBody) -> List[str]:
    """A body as rows of digits and lower-case letters, as robot files and the command line have it.

    >>> import numpy as np, nbc
    >>> nbc.rows(np.array([[3, 4, 3], [3, 0, 3]]))
    ['343', '303']
    """
    return ["".join(np.base_repr(code, 36).lower() for code in row) for row in read(body, "body").tolist()]


@dataclass(frozen=True, eq=False)
class Packed:
    """Bodies as the native half takes them."""

    codes: Codes
    """All codes in reading order, body after body."""
    shapes: npt.NDArray[np.uint64]
    """The rows and columns of each body; none for one that could not be read."""
    materials: str
    """The materials of the codes, as JSON."""
    errors: Mapping[int, str]
    """Why bodies could not be read."""

    def check(self) -> None:
        """Raises ValueError for the first body that could not be read."""
        for number, reason in self.errors.items():
            raise ValueError(f"bodies[{number}]: {reason}")


def pack(bodies: Bodies, materials: Optional[Sequence[Material]] = None, owner: str = "`materials`") -> Packed:
    """Bodies for the native half.

    Args:
        bodies: the bodies.
        materials: the materials of the codes; None for those of the robots, or the paper's.
        owner: who has these materials, for messages.

    Raises:
        TypeError, ValueError: for what is no array or list of bodies, and for a code that would be two materials. A
            body among others that is wrong in another way is in ``errors``.
    """
    if is_array(bodies):
        bodies = array_of(bodies)
    if isinstance(bodies, np.ndarray) and bodies.dtype != object:
        return _pack_array(bodies, pack_materials(PAPER_MATERIALS if materials is None else materials))
    if isinstance(bodies, (str, bytes)) or not isinstance(bodies, (Sequence, np.ndarray)):
        raise TypeError(f"bodies is of type {type(bodies).__name__}, expected an array (N, H, W) or a list of bodies")
    _check_count(len(bodies))
    packed, errors = [], {}
    for number, body in enumerate(bodies):
        try:
            packed.append(read(body, f"bodies[{number}]"))
        except ValueError as error:
            errors[number] = str(error).removeprefix(f"bodies[{number}]: ")
            packed.append(np.empty((0, 0), dtype=np.uint8))
    shapes = np.array([body.shape for body in packed], dtype=np.uint64).reshape(-1, 2)
    flat = [body.reshape(-1) for body in packed]
    text = pack_materials(_common_materials(bodies, packed, materials, owner))
    return Packed(np.concatenate(flat) if flat else np.empty(0, dtype=np.uint8), shapes, text, errors)


def _common_materials(
    bodies: Union[npt.NDArray[Any], Sequence[OneBody]],
    codes: Sequence[Codes],
    given: Optional[Sequence[Material]],
    owner: str,
) -> Sequence[Material]:
    """The materials in which all bodies can be read: those that are given, or else the most that a robot has."""
    common = PAPER_MATERIALS if given is None else given
    own = [body.materials if isinstance(body, Robot) else common for body in bodies]
    if given is None and own:
        first = max(range(len(own)), key=lambda number: len(own[number]))
        common, owner = own[first], f"bodies[{first}]"
    for number, materials in enumerate(own):
        check_materials(codes[number], materials, common, f"bodies[{number}]", owner)
    return common


def check_materials(
    codes: npt.NDArray[Any], own: Sequence[Material], common: Sequence[Material], name: str, owner: str
) -> None:
    """Raises ValueError for a code of a body that is another material, or none, in those of somebody else."""
    if own is common:
        return
    texts = pack_materials(own), pack_materials(common)
    if texts[0] == texts[1]:
        return
    known, expected = map(json.loads, texts)
    for code in np.unique(codes[codes > 0]).tolist():
        if known[code - 1 : code] != expected[code - 1 : code]:
            raise ValueError(f"{name}: code {code} is not the same material in {owner}")


def _check_count(found: int) -> None:
    if found > MOST_BODIES:
        raise ValueError(f"there are {found} bodies, expected at most {MOST_BODIES} in one call")


def _pack_array(bodies: npt.NDArray[Any], materials: str) -> Packed:
    if bodies.ndim != 3:
        hint = "; for one body write `body[None]`" if bodies.ndim == 2 else ""
        raise ValueError(f"bodies has the shape {bodies.shape}, expected (N, H, W){hint}")
    if max(bodies.shape[1:]) > MOST_SIDE:
        raise ValueError(f"bodies has the shape {bodies.shape}, expected at most {(len(bodies), MOST_SIDE, MOST_SIDE)}")
    _check_count(len(bodies))
    _check_integers(bodies, "bodies")
    shapes = np.empty((len(bodies), 2), dtype=np.uint64)
    shapes[:] = bodies.shape[1:]
    errors: Dict[int, str] = {}
    if bodies.dtype != np.uint8 and bodies.size and (bodies.min() < 0 or bodies.max() > 255):
        wrong = np.flatnonzero(((bodies < 0) | (bodies > 255)).any(axis=(1, 2)))
        errors = {number: _wrong_code(bodies[number]) for number in wrong.tolist()}
        bodies = bodies.copy()
        bodies[wrong] = 0
    return Packed(np.ascontiguousarray(bodies, dtype=np.uint8).reshape(-1), shapes, materials, errors)


def pack_materials(materials: Sequence[Material]) -> str:
    """Materials as JSON."""
    if isinstance(materials, (str, bytes, Mapping)) or not isinstance(materials, Sequence):
        raise TypeError(f"materials is of type {type(materials).__name__}, expected a list of mappings")
    for number, material in enumerate(materials):
        if not isinstance(material, Mapping):
            raise TypeError(f"materials[{number}] is of type {type(material).__name__}, expected a mapping")
    try:
        return json.dumps([dict(material) for material in materials], allow_nan=False, default=_plain)
    except ValueError as error:
        fault = "expected finite numbers" if "Out of range" in str(error) else str(error)
        raise ValueError(f"materials: {fault}") from error


def _plain(value: Any) -> Any:
    """A number or array of numpy or another library, as JSON has it."""
    if isinstance(value, Mapping):
        return dict(value)
    if is_array(value):
        plain = array_of(value)
        if plain.dtype.kind in "biufU":
            return plain.tolist()
    raise TypeError(f"materials: a value is of type {type(value).__name__}, expected a number or a text")


def read(body: OneBody, name: str) -> Codes:
    """The codes of one body, shape (H, W).

    Raises:
        TypeError, ValueError: for what is no body; ``name`` is what it is called in messages.
    """
    if isinstance(body, Robot):
        body = body.body
    if isinstance(body, (str, bytes)):
        raise TypeError(f"{name} is a text, expected a list of rows such as ['343', '303']")
    if isinstance(body, Sequence) and body and all(isinstance(row, str) for row in body):
        return _of_rows([str(row) for row in body], name)
    try:
        array = array_of(body)
    except ValueError as error:
        raise ValueError(f"{name}: {error}") from error
    if array.ndim != 2:
        raise ValueError(f"{name}: the body has the shape {array.shape}, expected (H, W)")
    if max(array.shape) > MOST_SIDE:
        raise ValueError(f"{name}: the body has the shape {array.shape}, expected at most {(MOST_SIDE, MOST_SIDE)}")
    _check_integers(array, name)
    if array.size and (array.min() < 0 or array.max() > 255):
        raise ValueError(f"{name}: {_wrong_code(array)}")
    return np.ascontiguousarray(array, dtype=np.uint8)


def _of_rows(body: Sequence[str], name: str) -> Codes:
    for number, row in enumerate(body, start=1):
        if len(row) != len(body[0]):
            voxels = "1 voxel" if len(row) == 1 else f"{len(row)} voxels"
            raise ValueError(f"{name}: row {number} has {voxels}, expected {len(body[0])} as in row 1")
        wrong = next((digit for digit in row if digit not in "0123456789abcdefghijklmnopqrstuvwxyz"), None)
        if wrong is not None:
            raise ValueError(f"{name}: row {number}: `{wrong}` is not a material code; expected a digit")
    shape = (len(body), len(body[0]))
    if max(shape) > MOST_SIDE:
        raise ValueError(f"{name}: the body has the shape {shape}, expected at most {(MOST_SIDE, MOST_SIDE)}")
    return np.array([[int(digit, 36) for digit in row] for row in body], dtype=np.uint8)


def _check_integers(array: npt.NDArray[Any], name: str) -> None:
    if array.size and array.dtype.kind not in "iu":
        raise TypeError(f"{name} has the dtype {array.dtype}, expected integers")


def _wrong_code(body: npt.NDArray[Any]) -> str:
    wrong = body.min() if body.min() < 0 else body.max()
    return f"{wrong} is not a material code; expected 0 to the number of materials"


def _robot(record: Mapping[str, Any]) -> Robot:
    arrays = {"body": _of_rows(record["body"], "body"), "displacement": np.array(record["displacement"])}
    return Robot(**{**record, **arrays, "materials": tuple(record["materials"])})
