"""Declarations of evolutions, and evaluation of bodies by their protocol."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from typing import Any, Dict, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _nbc
from .bodies import Bodies, pack
from .errors import Interrupted, report_invalid
from .names import Genome, Sought, Symmetry, texts
from .numbers import amount, array_of, count
from .physics import fault_array
from .progress import Progress, reporting

__all__ = ["Evaluation", "Evolution", "evaluate"]

Field = Union[str, float, Sequence[str]]


class Evolution:
    """A declared evolution: box, materials, protocol, archive and search.

    What is not given has the value of ``base``, by default the paper's run. Values are those of the language; see
    docs/evolution.md.

    >>> import nbc
    >>> run = nbc.Evolution(shape=(5, 5), objective="gate", descriptors=["voxels in 4 bins", "behavior"])
    >>> run.axes
    (('voxels', 4), ('behavior', 16))
    """

    def __init__(
        self,
        *,
        base: str = "gates",
        name: str = "evolution_in_python",
        shape: Optional[Tuple[int, int]] = None,
        generations: Optional[int] = None,
        batch: Optional[int] = None,
        newcomers: Optional[int] = None,
        genome: Optional[Genome] = None,
        crossover: Optional[float] = None,
        objective: Optional[Sought] = None,
        behaviors: Optional[Sequence[str]] = None,
        symmetry: Optional[Symmetry] = None,
        niche: Optional[str] = None,
        fixed: Optional[str] = None,
        descriptors: Optional[Sequence[str]] = None,
        rules: Union[str, Sequence[str], None] = None,
        vary: Optional[Mapping[str, float]] = None,
        worlds: Optional[int] = None,
        box: None = None,
    ) -> None:
        """Declares an evolution.

        Args:
            base: the evolution that the other values are from: ``gates`` is the paper's.
            name: its name, which checkpoints have.
            shape: rows and columns of the bodies, as the shapes of their arrays. (The language's ``box: 7 x 5`` has the
                columns first; here this is ``shape=(5, 7)``.)
            generations: how many generations make it complete.
            batch: offspring in each generation.
            newcomers: fresh random bodies in each generation.
            genome: ``cppn`` (the paper's) or ``voxels``.
            crossover: of voxels: the share of offspring that take a part of a second parent, from 0 to 1.
            objective: ``distance`` (the paper's), ``gate`` or ``wave``.
            behaviors: the behaviors that gates are searched for, for example ``["xor", "RLLR"]``; by default all.
            symmetry: ``none`` or ``npn``.
            niche: ``dominance`` (the paper's) or for example ``pareto(4)``.
            fixed: the length of a fixed simulation, for example ``10 cycles``.
            descriptors: the axes of the archive, for example ``["voxels in 4 bins", "behavior"]``.
            rules: ``paper`` or ``code``, where the paper's text and code differ, or a list of the matters in which to
                follow the code, for example ``["sensors", "repair"]``.
            vary: the largest changes of other worlds in which the objectives of gates try bodies too, for example
                ``{"friction": 0.1}``, or ``{"all": 0.1}`` for all factors.
            worlds: the number of these worlds.
            box: refused; it was (columns, rows) in version 0.2.

        Raises:
            NbcError: for values that the language does not have.
        """
        if box is not None:
            raise TypeError(_no_box(box))
        fields: Dict[str, Optional[Field]] = {
            "from": base,
            "box": None if shape is None else _box(shape),
            "generations": generations,
            "batch": batch,
            "newcomers": newcomers,
            "genome": genome,
            "crossover": crossover,
            "objective": objective,
            "behaviors": None if behaviors is None else _listed(behaviors, "behaviors"),
            "symmetry": symmetry,
            "niche": niche,
            "fixed": fixed,
            "descriptors": None if descriptors is None else _listed(descriptors, "descriptors"),
            "as": rules if rules is None or isinstance(rules, str) else _listed(rules, "rules"),
            "vary": None if vary is None else _variation(vary),
            "worlds": worlds,
        }
        lines = [f"    {key}: {value}," for key, value in fields.items() if value is not None]
        self._declare(f"evolution {name} {{\n" + "\n".join(lines) + "\n}\n", "evolution in Python")

    @classmethod
    def parse(cls, text: str, file: str = "evolution in Python") -> Evolution:
        """The last evolution that a text in the language declares; the paper's if it declares none.

        Raises:
            NbcError: when the text has errors; ``file`` is its name in their places.
        """
        evolution = cls.__new__(cls)
        evolution._declare(text, file)
        return evolution

    def _declare(self, text: str, file: str) -> None:
        self._native = _nbc.Evolution(text, file)

    def __reduce__(self) -> Any:
        return _copied, (self._native.to_json(),)

    def __eq__(self, other: object) -> bool:
        return self.fields == other.fields if isinstance(other, Evolution) else NotImplemented

    def __hash__(self) -> int:
        return hash(self._native.to_json())

    @classmethod
    def _of(cls, native: _nbc.Evolution) -> Evolution:
        evolution = cls.__new__(cls)
        evolution._native = native
        return evolution

    @property
    def fields(self) -> Mapping[str, Any]:
        """All values, also those that were not given."""
        fields: Mapping[str, Any] = json.loads(self._native.to_json())
        return fields

    @property
    def axes(self) -> Tuple[Tuple[str, int], ...]:
        """The name and the number of bins of each axis of the archive. A word that several axes have gets their places,
        from 1: ``active_1`` and ``active_3``."""
        return axes_of(self._native.axes())

    @property
    def shape(self) -> Tuple[int, int]:
        """Rows and columns of the bodies."""
        fields = self.fields
        return fields["height"], fields["width"]

    def __repr__(self) -> str:
        fields = self.fields
        return f"<Evolution {fields['name']}: shape {self.shape}, {fields['objective']}>"


@dataclass(frozen=True, eq=False)
class Evaluation:
    """The results of N bodies by the protocol of an evolution."""

    outcome: npt.NDArray[np.str_]
    """The outcome of each body, shape (N,):

    - ``measured``: it has scores.
    - ``inconsistent``: it walks one way under a constant pattern and the other way under the same pattern in the long
      simulation; or, by the objective ``gate``, its first fitness is too low.
    - ``surpassed``: it cannot enter its niche.
    - ``faulty``: one of its simulations failed.
    - ``invalid``: it is not a body of the evolution; ``errors`` has the reason.
    - ``stopped``: Ctrl-C ended its evaluation.
    """
    fitness: npt.NDArray[np.float64] = field(repr=False)
    """The two fitnesses, shape (N, 2); NaN for bodies that were not measured.

    By the objective ``distance``, in voxels: the sum of the distances of the long simulation, and the smallest distance
    of the fixed ones. By ``gate``, from 0 to 1: the scores of the displacement from the clock of a hold on, and in
    holds whose output stays (docs/evolution.md).
    """
    displacement: npt.NDArray[np.float64] = field(repr=False)
    """Voxels walked in the fixed simulations under the patterns 00, 01, 10, 11, shape (N, 4); for three stimuli under
    000 to 111, shape (N, 8)."""
    behavior: npt.NDArray[np.str_] = field(repr=False)
    """A letter L or R for each of the patterns, such as ``RRRL`` for nand and ``LLLRLRRR`` for maj; shape (N,)."""
    niche: Optional[npt.NDArray[np.int32]] = field(default=None, repr=False)
    """The bin on each axis of the archive, from 0; on the axis ``behavior`` the bits of the function, on ``class`` the
    lowest bits of the functions of its class. -1 for bodies that were not measured. Shape (N, axes)."""
    faults: Optional[npt.NDArray[Any]] = field(default=None, repr=False)
    """For each body the env step that was abandoned (0 for none) and the reason, as in `Trajectories`."""
    errors: Mapping[int, str] = field(default_factory=dict, repr=False)
    """Why each invalid body could not be evaluated, by its index."""

    @property
    def measured(self) -> npt.NDArray[np.bool_]:
        """Whether each body has scores, shape (N,)."""
        has_scores: npt.NDArray[np.bool_] = self.outcome == "measured"
        return has_scores

    def __len__(self) -> int:
        return len(self.outcome)


def evaluate(bodies: Bodies, evolution: Optional[Evolution] = None, *, progress: Progress = False) -> Evaluation:
    """Evaluates bodies by the protocol of an evolution, as for an empty archive, on all cores.

    The paper's protocol (``objective="distance"``) lets each body walk under each constant pattern, then through all of
    them. The gate objective scores switches of the inputs.

    Args:
        bodies: bodies of the evolution's box; see `simulate`.
        evolution: the evolution; by default the paper's, with the box of the bodies.
        progress: see `simulate`.

    Raises:
        TypeError, ValueError: as `simulate`, and for bodies of another box, or robots of other materials.
        Interrupted: on Ctrl-C, with the results so far.

    >>> import nbc
    >>> nand = next(robot for robot in nbc.library() if robot.name == "nand_5x5")
    >>> result = nbc.evaluate([nand], nbc.Evolution(objective="gate"))
    >>> result.behavior.tolist()
    ['RRRL']
    """
    if not isinstance(evolution, (Evolution, type(None))):
        raise TypeError(f"evolution is of type {type(evolution).__name__}, expected Evolution")
    packed = pack(bodies, (evolution or Evolution()).fields["palette"], "the evolution")
    if evolution is None:
        evolution = Evolution(shape=next(((int(h), int(w)) for h, w in packed.shapes if h and w), None))
    with reporting(progress, " env steps") as report:
        try:
            return of_arrays(_nbc.evaluate(packed.codes, packed.shapes, evolution._native, report), packed.errors)
        except Interrupted as interrupt:
            interrupt.result = of_arrays(interrupt.result, packed.errors)
            raise


def of_arrays(arrays: Mapping[str, Any], unread: Mapping[int, str] = {}) -> Evaluation:
    """An evaluation of the native half, with better reasons for bodies that could not be read."""
    errors = report_invalid(arrays["errors"], unread, len(arrays["outcome"]))
    return Evaluation(
        outcome=np.array(arrays["outcome"], dtype="U12"),
        fitness=arrays["fitness"],
        displacement=arrays["displacement"],
        behavior=np.array(arrays["behavior"], dtype=f"U{arrays['displacement'].shape[1]}"),
        niche=arrays["niche"],
        faults=fault_array(arrays),
        errors=errors,
    )


def axes_of(axes: Sequence[Tuple[str, int]]) -> Tuple[Tuple[str, int], ...]:
    """Axes by name, as the CSV of ``nbc export`` names them."""
    words = [word for word, _ in axes]
    named = (f"{word}_{place}" if words.count(word) > 1 else word for place, word in enumerate(words, start=1))
    return tuple((name, bins) for name, (_, bins) in zip(named, axes))


def letters(behavior: Any) -> List[str]:
    """Behaviors as a list of texts."""
    return [str(word) for word in array_of(behavior).tolist()]


def _copied(text: str) -> Evolution:
    return Evolution._of(_nbc.Evolution.from_json(text))


def _box(shape: Sequence[int]) -> str:
    """The field of the language for rows and columns."""
    if not isinstance(shape, Sequence) or isinstance(shape, str) or len(shape) != 2:
        raise ValueError(f"shape is {shape!r}, expected rows and columns, such as (5, 7)")
    rows, columns = (count(side, f"shape[{number}]") for number, side in enumerate(shape))
    return f"{columns} x {rows}"


def _no_box(box: Any) -> str:
    """Where the argument of version 0.2 is now."""
    try:
        columns, rows = box
    except (TypeError, ValueError):
        columns, rows = "columns", "rows"
    return f"box=({columns}, {rows}), columns first, is now shape=({rows}, {columns}), rows first as in all shapes"


def _listed(values: Sequence[str], name: str) -> str:
    return f"[{', '.join(texts(values, name))}]"


def _variation(vary: Mapping[str, float]) -> str:
    if not isinstance(vary, Mapping):
        raise TypeError(f"vary is of type {type(vary).__name__}, expected a mapping")
    shares = {key: np.format_float_positional(amount(share, f"vary[{key!r}]"), trim="-") for key, share in vary.items()}
    return "{ " + ", ".join(f"{key}: {share}" for key, share in shares.items()) + " }"
