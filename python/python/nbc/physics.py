"""Physics: bodies under stimuli, from a fresh start or step by step."""

from __future__ import annotations

import threading
from dataclasses import dataclass, field
from typing import Any, Dict, List, Literal, Mapping, NamedTuple, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _nbc
from .bodies import Bodies, Material, pack
from .closing import Closing
from .errors import Interrupted, report_invalid
from .names import meant
from .numbers import array_of, count, is_array, real
from .progress import Progress, reporting

__all__ = ["CYCLE_STEPS", "Flock", "Schedule", "Trajectories", "simulate"]

CYCLE_STEPS: int = _nbc.CYCLE_STEPS
"""Env steps of one actuation cycle of the paper."""

Schedule = Union[str, Sequence[Tuple[Union[str, npt.NDArray[Any], Sequence[Sequence[float]]], int]]]
"""Stimuli over time: ``"00*10 01*56steps"`` (ten cycles of pattern 00, then 56 env steps of pattern 01), or pairs of a
pattern and a number of env steps, ``[("00", 840), ("01", 56)]``. A pattern has a digit for each stimulus, stimulus 1
first. For materials that sense an image, pairs of an image and a number of env steps: an array of shape (rows, columns)
with values from 0 to 1, row 0 on top."""

RECORDS = ("com", "poses")
FAULTS = np.dtype([("env_step", "u4"), ("kind", "U10")])
MOST_STEPS = 10_000_000


@dataclass(frozen=True, eq=False)
class Trajectories:
    """What N bodies did under a schedule of S spells (entries) and T - 1 env steps. Lengths are in voxels."""

    displacement: npt.NDArray[np.float64]
    """Voxels walked in each spell, shape (N, S); NaN in spells that were not simulated to their end."""
    com: Optional[npt.NDArray[np.float64]] = field(repr=False)
    """Center of mass at the start and after each env step, shape (N, T, 2); NaN after a fault.
    Ctrl-C may leave fewer env steps. None if not recorded."""
    faults: npt.NDArray[Any] = field(repr=False)
    """For each body the env step that was abandoned (0 for none) and the reason: ``unstable`` or ``non_finite``,
    ``invalid`` for a body that could not be simulated at all, or ``stopped`` if Ctrl-C ended it. A structured array of
    shape (N,) with the fields ``env_step`` and ``kind``."""
    poses: Optional[List[npt.NDArray[np.float64]]] = field(default=None, repr=False)
    """With ``record="poses"``: for each body its P points every ``stride`` env steps, shape (frames, P, 2)."""
    voxels: Optional[List[npt.NDArray[np.intp]]] = field(default=None, repr=False)
    """With ``record="poses"``: for each body the four points of each voxel in reading order, shape (V, 4): top left,
    top right, bottom right, bottom left."""
    errors: Mapping[int, str] = field(default_factory=dict, repr=False)
    """Why each invalid body could not be simulated, by its index. Such a body has NaN everywhere."""

    @property
    def ok(self) -> npt.NDArray[np.bool_]:
        """Whether each body was simulated to the end, shape (N,)."""
        ended: npt.NDArray[np.bool_] = self.faults["env_step"] == 0
        return ended

    def __len__(self) -> int:
        return len(self.faults)


def simulate(
    bodies: Bodies,
    schedule: Schedule,
    *,
    materials: Optional[Sequence[Material]] = None,
    world_width: int = 500,
    start_x: Optional[int] = None,
    record: Optional[Literal["com", "poses"]] = "com",
    stride: int = 12,
    progress: Progress = False,
) -> Trajectories:
    """Simulates each body from a fresh start under a schedule, on all cores.

    The results are those of ``nbc simulate``, to the last bit, for any number of bodies and cores. The lock of the
    interpreter is released, and Ctrl-C ends the call with `Interrupted`, which has the results so far.

    An invalid body (empty, not in one piece, with a code that is no material, or without room in the world) does not
    keep the others from being simulated: it has NaN, its reason is in ``errors``, and an `InvalidBodyWarning` tells.

    Args:
        bodies: an integer array (N, H, W) of numpy or a library such as JAX, or a list of bodies of any sizes.
        schedule: the stimuli over time, for all bodies; a pattern has a digit for each stimulus that the materials
            sense, two for the paper's. For materials that sense an image, arrays of pixels take the place of patterns.
        materials: the materials of the codes; by default those of robots, and for other bodies the paper's.
        world_width: ground voxels in a row.
        start_x: the ground column of each body's left column; by default the middle of the world.
        record: ``"com"`` keeps the path of the center of mass, ``"poses"`` also all points every ``stride`` env steps,
            None only displacements.
        stride: env steps between poses.
        progress: whether to show a tqdm bar, or a function of the env steps done and all env steps.

    Raises:
        TypeError: for arrays that are not of integers, and arguments of other types.
        ValueError: for wrong shapes, and if no body at all is valid.
        MemoryError: when there is no room for the bodies and paths, or the paths would need more than 8 GiB.
        NbcError: for a schedule that cannot be read; its diagnostics have the places in the text.

    >>> import nbc
    >>> walk = nbc.simulate([["343", "563"]], "00*2 11*1")
    >>> walk.displacement.shape, walk.com.shape
    ((1, 2), (1, 253, 2))
    """
    if record not in (None, "com", "poses"):
        raise ValueError(f"record is {record!r}, expected 'com', 'poses' or None{meant(record, RECORDS)}")
    every = count(stride, "stride", least=1)
    packed = pack(bodies, materials)
    trials = {
        "codes": packed.codes,
        "shapes": packed.shapes,
        "materials": packed.materials,
        "schedule": pack_schedule(schedule),
        "world_width": count(world_width, "world_width"),
        "start_x": None if start_x is None else count(start_x, "start_x"),
        "record_com": record is not None,
        "stride": every if record == "poses" else None,
    }
    with reporting(progress, " env steps") as report:
        try:
            return _trajectories(_nbc.simulate(trials, report), packed.errors)
        except Interrupted as interrupt:
            interrupt.result = _trajectories(interrupt.result, packed.errors)
            raise


class _Source(NamedTuple):
    """What a flock is made of."""

    codes: npt.NDArray[np.uint8]
    shapes: npt.NDArray[np.uint64]
    materials: str
    world_width: int
    start_x: Optional[int]


class _Spell(NamedTuple):
    """Env steps under the same patterns, after earlier spells: the pattern of all robots, or one for each with spaces
    between them."""

    earlier: Optional[_Spell]
    patterns: str
    steps: int


class FlockState:
    """The state of a flock, for `Flock.restore`. It can be pickled and copied: the pickle has the bodies and the
    stimuli so far, and the first use of what is read from it simulates them again."""

    def __init__(self, native: _nbc.FlockState, source: _Source, last: Optional[_Spell]) -> None:
        self._native: Optional[_nbc.FlockState] = native
        self._source, self._last = source, last

    def native(self) -> _nbc.FlockState:
        """The state as the native half has it."""
        if self._native is None:
            self._native = _replayed(self._source, self._last).snapshot()
        return self._native

    def is_of(self, source: _Source) -> bool:
        """Whether a flock of this kind can be in this state."""
        pairs: List[Tuple[Any, Any]] = list(zip(self._source, source))
        return all(np.array_equal(own, other) for own, other in pairs)

    def __getstate__(self) -> Dict[str, Any]:
        return {"source": self._source, "spells": _spells(self._last)}

    def __setstate__(self, kept: Dict[str, Any]) -> None:
        self._native, self._source, self._last = None, kept["source"], _last_of(kept["spells"])

    def __copy__(self) -> FlockState:
        return self

    def __deepcopy__(self, memo: Dict[int, Any]) -> FlockState:
        # Nothing changes a state.
        return self


class Flock(Closing):
    """Robots that are advanced step by step, each alone in its own simulation with its own stimuli.

    For closed-loop control and other experiments step by step. A flock can be used from several threads: calls wait for
    each other. It is closed with `close` or at the end of a ``with`` block.

    It can be copied and pickled, and goes on with equal steps. A pickle has the bodies and the stimuli so far, and what
    is read from it has simulated them again.

    >>> import nbc
    >>> with nbc.Flock([["343", "563"]]) as flock:
    ...     flock.advance("01", 84)
    ...     flock.com.shape, flock.clock.tolist()
    ((1, 2), [84])
    """

    def __init__(
        self,
        bodies: Bodies,
        *,
        materials: Optional[Sequence[Material]] = None,
        world_width: int = 500,
        start_x: Optional[int] = None,
    ) -> None:
        """Puts a robot for each body at its start; arguments and errors are those of `simulate`, but each body must be
        valid."""
        packed = pack(bodies, materials)
        packed.check()
        start = None if start_x is None else count(start_x, "start_x")
        width = count(world_width, "world_width")
        self._source = _Source(packed.codes, packed.shapes, packed.materials, width, start)
        self._native: _nbc.Flock = _nbc.Flock(*self._source)
        self._last: Optional[_Spell] = None
        self._lock = threading.RLock()

    def __len__(self) -> int:
        return len(self._native)

    def advance(self, patterns: Union[str, Sequence[str], npt.NDArray[Any]], steps: int = CYCLE_STEPS) -> None:
        """Simulates more env steps.

        The clock of the actuators continues from call to call. A robot with a fault stays as it was. If Ctrl-C ends the
        call, the flock is as it was before.

        Args:
            patterns: a pattern for all robots (``"01"``), or one for each: a sequence of N patterns, or an array of
                shape (N, stimuli) of zeros and ones.
            steps: env steps, by default one cycle.
        """
        each, number = self._patterns(patterns), count(steps, "steps", most=MOST_STEPS)
        with self._lock:
            self._native.advance(each, number)
            self._last = _after(self._last, each[0] if len(set(each)) == 1 else " ".join(each), number)

    @property
    def com(self) -> npt.NDArray[np.float64]:
        """Centers of mass in voxels, shape (N, 2)."""
        return self._native.centers()

    @property
    def clock(self) -> npt.NDArray[np.uint32]:
        """Env steps that each robot has done, shape (N,)."""
        return self._native.clocks()

    @property
    def faults(self) -> npt.NDArray[Any]:
        """For each robot the env step that was abandoned (0 for none) and the reason, as in `Trajectories`."""
        return np.array(self._native.faults(), dtype=FAULTS)

    def poses(self) -> List[npt.NDArray[np.float64]]:
        """The points of each robot in voxels, shape (P, 2) each."""
        return self._native.poses()

    def voxels(self, robot: int) -> npt.NDArray[np.intp]:
        """The four points of each voxel of a robot, by their rows in its pose, shape (V, 4)."""
        number = count(robot, "the number of the robot", least=-(2**31))
        if not 0 <= number < len(self):
            raise IndexError(f"there is no robot {number}; the flock has {len(self)}, counted from 0")
        return np.array(self._native.voxels(number), dtype=np.intp).reshape(-1, 4)

    def snapshot(self) -> FlockState:
        """The state of all robots, for `restore`."""
        with self._lock:
            return FlockState(self._native.snapshot(), self._source, self._last)

    def restore(self, state: FlockState) -> None:
        """Sets all robots to an earlier state of this flock, or of one with the same bodies in the same world."""
        if not isinstance(state, FlockState):
            raise TypeError(f"state is of type {type(state).__name__}, expected what `snapshot` returned")
        if not state.is_of(self._source):
            raise ValueError("the state is of other bodies, or of another world")
        native = state.native()
        with self._lock:
            self._native.restore(native)
            self._last = state._last

    def __getstate__(self) -> Dict[str, Any]:
        return self.snapshot().__getstate__()

    def __setstate__(self, kept: Dict[str, Any]) -> None:
        self._source, self._last = kept["source"], _last_of(kept["spells"])
        self._native, self._lock = _replayed(self._source, self._last), threading.RLock()

    def __copy__(self) -> Flock:
        state = self.snapshot()
        other = Flock.__new__(Flock)
        other.__setstate__({"source": self._source, "spells": []})
        other.restore(state)
        return other

    def __deepcopy__(self, memo: Dict[int, Any]) -> Flock:
        return self.__copy__()

    def _patterns(self, patterns: Union[str, Sequence[str], npt.NDArray[Any]]) -> List[str]:
        if isinstance(patterns, str):
            return [patterns] * len(self)
        if is_array(patterns):
            patterns = array_of(patterns)
        if not isinstance(patterns, (Sequence, np.ndarray)):
            raise TypeError(f"patterns is of type {type(patterns).__name__}, expected a pattern, or one for each robot")
        if isinstance(patterns, np.ndarray) and patterns.dtype.kind in "biu":
            if patterns.ndim != 2 or len(patterns) != len(self):
                raise ValueError(f"patterns has the shape {patterns.shape}, expected ({len(self)}, stimuli)")
            if not np.isin(patterns, (0, 1)).all():
                raise ValueError("patterns has values other than 0 and 1")
            return ["".join("1" if bit else "0" for bit in row) for row in patterns]
        if isinstance(patterns, np.ndarray) and patterns.dtype.kind != "U":
            raise TypeError(f"patterns has the dtype {patterns.dtype}, expected integers, booleans or text")
        return [_pattern(pattern) for pattern in patterns]


def _after(last: Optional[_Spell], patterns: str, steps: int) -> Optional[_Spell]:
    """The last spell after more env steps."""
    if steps == 0:
        return last
    if last is not None and last.patterns == patterns:
        return _Spell(last.earlier, patterns, last.steps + steps)
    return _Spell(last, patterns, steps)


def _spells(last: Optional[_Spell]) -> List[Tuple[str, int]]:
    """All spells, the first one first."""
    found = []
    while last is not None:
        found.append((last.patterns, last.steps))
        last = last.earlier
    return found[::-1]


def _last_of(spells: Sequence[Tuple[str, int]]) -> Optional[_Spell]:
    last: Optional[_Spell] = None
    for patterns, steps in spells:
        last = _Spell(last, patterns, steps)
    return last


def _replayed(source: _Source, last: Optional[_Spell]) -> _nbc.Flock:
    """A flock after all spells."""
    flock = _nbc.Flock(*source)
    for patterns, steps in _spells(last):
        each = patterns.split(" ")
        for start in range(0, steps, MOST_STEPS):
            flock.advance(each * len(flock) if len(each) == 1 else each, min(MOST_STEPS, steps - start))
    return flock


def pack_schedule(schedule: Schedule) -> Union[str, List[Tuple[Union[str, List[List[float]]], int]]]:
    """A schedule as the native half reads it."""
    if isinstance(schedule, str):
        return schedule
    if not isinstance(schedule, Sequence):
        raise TypeError(f"schedule is of type {type(schedule).__name__}, expected a text or pairs")
    spells: List[Tuple[Union[str, List[List[float]]], int]] = []
    for entry in schedule:
        if isinstance(entry, str) or not isinstance(entry, Sequence) or len(entry) != 2:
            raise ValueError(f"the schedule has the entry {entry!r}, expected a pattern and a number of env steps")
        first = array_of(entry[0]) if is_array(entry[0]) else entry[0]
        is_image = isinstance(first, (list, tuple)) or np.ndim(first) > 0
        shown = _image(first) if is_image else _pattern(first)
        spells.append((shown, count(entry[1], "the length of a spell", least=1, most=MOST_STEPS)))
    if not spells:
        raise ValueError("the schedule is empty")
    if sum(steps for _, steps in spells) > MOST_STEPS:
        raise ValueError(f"the schedule is too long, expected at most {MOST_STEPS} env steps")
    return spells


def fault_array(arrays: Mapping[str, Any]) -> npt.NDArray[Any]:
    """The faults of the native half."""
    faults = np.empty(len(arrays["fault_step"]), dtype=FAULTS)
    faults["env_step"], faults["kind"] = arrays["fault_step"], arrays["fault_kind"]
    return faults


def _pattern(pattern: Any) -> str:
    if not isinstance(pattern, str):
        raise TypeError(f"{pattern!r} is not a pattern; expected digits such as '01'")
    return str(pattern)


def _image(image: Any) -> List[List[float]]:
    array = real(image, "an image of the schedule")
    if array.ndim != 2:
        raise ValueError(f"an image of the schedule has the shape {array.shape}, expected (rows, columns)")
    rows: List[List[float]] = array.tolist()
    return rows


def _trajectories(arrays: Mapping[str, Any], unread: Mapping[int, str]) -> Trajectories:
    poses, voxels = arrays.get("poses"), arrays.get("voxels")
    corners = None if voxels is None else [np.array(each, dtype=np.intp).reshape(-1, 4) for each in voxels]
    errors = report_invalid(arrays["errors"], unread, len(arrays["fault_step"]))
    return Trajectories(arrays["displacement"], arrays["com"], fault_array(arrays), poses, corners, errors)
