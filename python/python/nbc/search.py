"""Search: ask, evaluate and tell; whole runs; archives and checkpoints."""

from __future__ import annotations

import json
import os
import time
import warnings
from typing import TYPE_CHECKING, Any, Dict, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _nbc
from .bodies import PAPER_MATERIALS, Material, Robot, _robot, check_materials, pack_materials, rows
from .errors import Interrupted, MissingRobotWarning
from .evolution import Evaluation, Evolution, axes_of, letters, of_arrays
from .names import texts, unknown
from .numbers import amount, array_of, count, real, whole
from .progress import Progress, reporting

if TYPE_CHECKING:
    import pandas

__all__ = ["Archive", "Candidates", "Search", "evolve", "read_archive"]

Path = Union[str, "os.PathLike[str]"]


class Candidates:
    """The bodies of a generation, to be evaluated."""

    def __init__(self, native: _nbc.Candidates) -> None:
        self._native = native

    @property
    def bodies(self) -> npt.NDArray[np.uint8]:
        """Their codes, shape (N, H, W)."""
        return self._native.bodies()

    @property
    def generation(self) -> int:
        """The generations done before."""
        return self._native.generation

    def __len__(self) -> int:
        return len(self._native)

# The columns of elites that are extra fields in pyribs.
_EXTRA = ("fitness", "behavior", "displacement", "generation", "evaluations")


def _ribs_type(column: np.dtype[Any]) -> Any:
    """The type of a column in pyribs: objects instead of texts of a fixed length."""
    return object if column.base.kind == "U" else column.base


def _behaviors(words: Any, patterns: int) -> npt.NDArray[np.str_]:
    """Behaviors with a letter for each pattern."""
    for word in letters(words):
        if len(word) != patterns:
            raise ValueError(f"the behavior `{word}` has {len(word)} letters, expected {patterns}")
    return np.array(letters(words), dtype=f"U{patterns}")


class Archive:
    """Elites in their niches.

    ``elites`` is a structured array with a row for each elite: ``niche`` (a bin for each axis), ``fitness`` (2),
    ``behavior``, ``displacement`` (4, or 8 for three stimuli), ``body`` (H, W), ``generation`` and ``evaluations``.
    """

    def __init__(
        self, arrays: Mapping[str, Any], axes: Tuple[Tuple[str, int], ...], materials: Sequence[Material]
    ) -> None:
        size = len(arrays["behavior"])
        shape = {name: arrays[name].shape[1:] for name in ("niche", "displacement", "body")}
        fields: List[Tuple[Any, ...]] = [
            ("niche", "u2", shape["niche"]),
            ("fitness", "f8", (2,)),
            ("behavior", f"U{shape['displacement'][0]}"),
            ("displacement", "f8", shape["displacement"]),
            ("body", "u1", shape["body"]),
            ("generation", "u4"),
            ("evaluations", "u8"),
        ]
        self.axes = axes
        """The name and the number of bins of each axis; see `Evolution.axes`."""
        self.materials: Tuple[Material, ...] = tuple(materials)
        """The materials of the codes."""
        self._functions: List[str] = list(arrays["function"])
        self.elites: npt.NDArray[Any] = np.zeros(size, dtype=fields)
        for name in self.elites.dtype.names or ():
            self.elites[name] = arrays[name]

    def __len__(self) -> int:
        return len(self.elites)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Archive):
            return NotImplemented
        alike = (self.axes, self.materials, self.elites.dtype) == (other.axes, other.materials, other.elites.dtype)
        return alike and np.array_equal(self.elites, other.elites)

    __hash__ = None  # type: ignore[assignment]

    def frame(self) -> pandas.DataFrame:
        """The elites as a pandas frame, with the columns of the CSV of ``nbc export`` (docs/export.md), except
        ``run`` and ``seed``."""
        import pandas

        columns: Dict[str, Any] = {"behavior": letters(self.elites["behavior"]), "function": self._functions}
        columns["fitness_1"], columns["fitness_2"] = self.elites["fitness"].T
        for i, (name, _) in enumerate(self.axes):
            columns[f"niche_{name}"] = self.elites["niche"][:, i]
        patterns = self._patterns()
        for i in range(patterns):
            columns[f"displacement_{i:0{patterns.bit_length() - 1}b}"] = self.elites["displacement"][:, i]
        height, width = self.elites["body"].shape[1:]
        columns["width"], columns["height"] = np.full(len(self), width), np.full(len(self), height)
        columns.update(self._voxels())
        columns["body"] = ["|".join(rows(body)) for body in self.elites["body"]]
        materials = "" if self.materials == PAPER_MATERIALS else json.dumps(self.materials, separators=(",", ":"))
        columns["materials"] = [materials] * len(self)
        columns["generation"], columns["evaluations"] = self.elites["generation"], self.elites["evaluations"]
        return pandas.DataFrame(columns)

    def to_ribs(self) -> Any:
        """The elites as a ``GridArchive`` of pyribs: solutions are the codes of bodies in reading order, the objective
        is the first fitness, and the measures are the bins of `axes`. Its extra fields have the rest, and the ``width``
        and the ``materials`` of each body. Of several elites in a niche it has the one with the greatest first fitness.

        Raises:
            ValueError: for an archive with the axis ``class``, of which not all behaviors have a bin.
        """
        from ribs.archives import GridArchive

        if any(name.startswith("class") for name, _ in self.axes):
            raise ValueError("pyribs has no archive with the axis `class`")
        types = {name: (self.elites.dtype[name].shape, _ribs_type(self.elites.dtype[name])) for name in _EXTRA}
        archive = GridArchive(
            solution_dim=int(np.prod(self.elites["body"].shape[1:])),
            dims=[bins for _, bins in self.axes],
            ranges=[(-0.5, bins - 0.5) for _, bins in self.axes],
            extra_fields={**types, "function": ((), object), "materials": ((), object), "width": ((), np.int64)},
        )
        if len(self):
            extra = {name: self.elites[name].astype(of) for name, (_, of) in types.items()}
            bodies = self.elites["body"]
            archive.add(bodies.reshape(len(self), -1), self.elites["fitness"][:, 0], self.elites["niche"],
                        function=np.array(self._functions, dtype=object), width=np.full(len(self), bodies.shape[2]),
                        materials=np.full(len(self), pack_materials(self.materials), dtype=object), **extra)
        return archive

    @classmethod
    def from_ribs(cls, archive: Any, axes: Sequence[str], materials: Optional[Sequence[Material]] = None) -> Archive:
        """The archive of a ``GridArchive`` that `to_ribs` made, and that may have got more elites since.

        Args:
            archive: the archive of pyribs.
            axes: the name of each of its measures.
            materials: the materials of the codes; by default those that `to_ribs` wrote, which must agree with them.

        Raises:
            ValueError: for an archive without the extra fields of `to_ribs`, or with another number of measures, and
                for solutions that are not whole codes of the materials.
        """
        missing = [name for name in (*_EXTRA, "function", "materials", "width") if name not in archive.field_list]
        if missing:
            raise ValueError(f"the archive has no field `{missing[0]}`; `to_ribs` makes archives with it")
        if len(axes) != len(archive.dims):
            raise ValueError(f"{len(axes)} axes are named, expected {len(archive.dims)}, one for each measure")
        found = archive.data()
        size, texts = len(found["index"]), sorted(set(found["materials"]))
        if len(texts) > 1:
            raise ValueError("the bodies have different materials, expected the same for all")
        own = json.loads(texts[0]) if texts else PAPER_MATERIALS
        common = own if materials is None else materials
        codes = whole(found["solution"], "the solution", most=len(common)).reshape(size, -1)
        check_materials(codes, own, common, "the archive", "`materials`")
        widths = np.unique(whole(found["width"], "the width", least=1)).tolist() or [1]
        if len(widths) > 1 or codes.shape[1] % widths[0]:
            raise ValueError(f"bodies of {codes.shape[1]} codes have the widths {widths}, expected one that fits")
        arrays = {
            "niche": archive.int_to_grid_index(found["index"]),
            "fitness": real(found["fitness"], "the fitness"),
            "behavior": _behaviors(found["behavior"], found["displacement"].shape[1]),
            "displacement": real(found["displacement"], "the displacement"),
            "body": codes.reshape(size, -1, widths[0]),
            "generation": whole(found["generation"], "the generation", most=2**32 - 1),
            "evaluations": whole(found["evaluations"], "the evaluations"),
            "function": found["function"],
        }
        # In order of their niches, as archives are.
        order = np.argsort(found["index"])
        axis_bins = tuple(zip(axes, (int(bins) for bins in archive.dims)))
        return cls({name: column[order] for name, column in arrays.items()}, axis_bins, common)

    def _patterns(self) -> int:
        """The patterns of its stimuli, 4 or 8."""
        return int(self.elites["displacement"].shape[1])

    def _voxels(self) -> Dict[str, npt.NDArray[np.int64]]:
        """How many voxels, actuators and sensors each elite has."""
        kinds = np.array(["empty", *(material["kind"] for material in self.materials)])[self.elites["body"]]
        wanted = {"voxels": kinds != "empty", "actuators": kinds == "actuator", "sensors": kinds == "sensor"}
        return {name: of_kind.sum(axis=(1, 2)) for name, of_kind in wanted.items()}

    def heatmap(self, x: str, y: str) -> npt.NDArray[np.float64]:
        """The best first fitness over two axes, by their names in `axes`; shape (bins of y, bins of x), NaN where no
        niche is filled. The axis ``class`` has as many bins here as there are behaviors: a class has the bin of the
        lowest bits of its functions."""
        names = [name for name, _ in self.axes]
        for name in (x, y):
            if name not in names:
                raise ValueError(unknown("axis of the archive", name, names))
        bins = {name: 2 ** self._patterns() if name.startswith("class") else size for name, size in self.axes}
        (i, across), (j, up) = ((names.index(name), bins[name]) for name in (x, y))
        best = np.full((up, across), -np.inf)
        np.maximum.at(best, (self.elites["niche"][:, j], self.elites["niche"][:, i]), self.elites["fitness"][:, 0])
        return np.where(np.isneginf(best), np.nan, best)

    def __repr__(self) -> str:
        return f"<Archive: {len(self)} elites over {' x '.join(f'{name} {bins}' for name, bins in self.axes)}>"


class Search:
    """A MAP-Elites search: ask for candidates, evaluate them in any way, tell the results.

    The same seed gives the same archive on any number of cores and after any number of interruptions.

    >>> import nbc
    >>> search = nbc.Search(nbc.Evolution(shape=(3, 3), batch=4, fixed="1 cycles"), seed=7)
    >>> candidates = search.ask()
    >>> candidates.bodies.shape
    (5, 3, 3)
    >>> search.tell(candidates, search.evaluate(candidates))
    >>> search.generation
    1
    """

    def __init__(self, evolution: Evolution, seed: int = 1) -> None:
        """A new search."""
        self.evolution = evolution
        """The declaration that it follows."""
        self._native = _nbc.Search(declaration(evolution)._native, count(seed, "seed", most=2**64 - 1))

    @classmethod
    def resume(cls, path: Path, evolution: Evolution) -> Search:
        """The search of a checkpoint, which `save` or ``nbc evolve`` wrote.

        Raises:
            FileNotFoundError: when there is no such file.
            NbcError: when it is damaged, or belongs to another declaration.
        """
        return cls._of(_nbc.Search.resume(os.fspath(path), declaration(evolution)._native), evolution)

    @classmethod
    def _of(cls, native: _nbc.Search, evolution: Evolution) -> Search:
        search = cls.__new__(cls)
        search.evolution, search._native = evolution, native
        return search

    def __reduce__(self) -> Any:
        return _copied, (self._native.to_bytes(), self.evolution)

    def save(self, path: Path) -> None:
        """Writes a checkpoint, whole or not at all. ``nbc draw`` and ``nbc export`` read it too."""
        self._native.save(os.fspath(path))

    def ask(self) -> Candidates:
        """The candidates of the next generation; the same ones until `tell`."""
        return Candidates(self._native.ask())

    def evaluate(self, candidates: Candidates) -> Evaluation:
        """Evaluates candidates by the protocol of the declaration, on all cores. Simulations that cannot matter for the
        archive as it is are left out: such bodies are ``surpassed``."""
        return of_arrays(self._native.evaluate(asked(candidates)._native))

    def tell(self, candidates: Candidates, evaluation: Evaluation) -> None:
        """Takes the results of the candidates of `ask`, which completes a generation.

        Raises:
            ValueError: for results of other shapes, scores that are not finite numbers, or candidates of another
                search or generation.
        """
        size, patterns = len(asked(candidates)), self._native.patterns
        for name, shape in (("outcome", (size,)), ("fitness", (size, 2)), ("displacement", (size, patterns)),
                            ("behavior", (size,))):
            if not hasattr(evaluation, name):
                raise TypeError(f"evaluation is of type {type(evaluation).__name__}, expected Evaluation")
            found = np.shape(array_of(getattr(evaluation, name)))
            if found != shape:
                raise ValueError(f"{name} has the shape {found}, expected {shape}")
        numbers = real(evaluation.fitness, "fitness"), real(evaluation.displacement, "displacement")
        self._native.tell(candidates._native, letters(evaluation.outcome), *numbers, letters(evaluation.behavior))

    def step(self) -> None:
        """Makes a generation. If Ctrl-C ends it, the search is as it was before."""
        self._native.step()

    @property
    def summary(self) -> Mapping[str, Any]:
        """Seed, generation, counts of results, env steps, and coverage, QD-score and champions of the archive."""
        summary: Mapping[str, Any] = json.loads(self._native.summary())
        return summary

    @property
    def generation(self) -> int:
        """Generations done."""
        return int(self.summary["generation"])

    @property
    def is_done(self) -> bool:
        """Whether all declared generations are done."""
        return bool(self.summary["is_done"])

    @property
    def archive(self) -> Archive:
        """The archive as it is now."""
        arrays, axes, materials = self._native.archive()
        return Archive(arrays, axes_of(axes), json.loads(materials))

    def robots(
        self,
        behaviors: Sequence[str] = (),
        *,
        tries: int = 8,
        finalists: int = 2,
        max_error: float = 0.0,
        wide_margin: float = 0.0,
        progress: Progress = False,
    ) -> List[Robot]:
        """The best robot of each behavior in the archive, measured as ``nbc library add`` does. A behavior without a
        robot that is good enough is left out; if it was named, or there is no robot at all, a `MissingRobotWarning`
        says why.

        Args:
            behaviors: behaviors such as ``RRRL``, or their functions such as ``nand``; by default all.
            tries: the number of elites of each behavior that are screened.
            finalists: the number of these that are measured in full.
            max_error: the highest accepted share of wrong switches.
            wide_margin: robots with at least this margin are better than quicker ones with less, in voxels per cycle.
            progress: whether to show a tqdm bar, or a function of the work done and all work.
        """
        choosing = {
            "tries": count(tries, "tries", least=1),
            "finalists": count(finalists, "finalists", least=1),
            "max_error": amount(max_error, "max_error", most=1.0),
            "wide_margin": amount(wide_margin, "wide_margin"),
        }
        with reporting(progress, " screenings") as report:
            found = json.loads(self._native.robots(texts(behaviors, "behaviors"), choosing, report))
        if found["reasons"] and (behaviors or not found["robots"]):
            text = "there is no robot for some behaviors\n" + "".join(found["reasons"])
            warnings.warn(text, MissingRobotWarning, stacklevel=2)
        return [_robot(record) for record in found["robots"]]

    def close(self) -> None:
        """Frees the search. Later calls raise ValueError."""
        self._native.close()


def evolve(
    evolution: Evolution,
    *,
    seed: int = 1,
    generations: Optional[int] = None,
    checkpoint: Optional[Path] = None,
    checkpoint_every: float = 60.0,
    progress: Progress = False,
) -> Search:
    """Runs an evolution to its end.

    Args:
        evolution: the declaration.
        seed: the seed of the run.
        generations: run until so many generations are done, also if the declaration has fewer; by default those of the
            declaration.
        checkpoint: a file to save to, and to resume from if it exists. It is written before the first generation too.
        checkpoint_every: seconds between checkpoints.
        progress: whether to show a tqdm bar, or a function of the generations done and all generations.

    Raises:
        Interrupted: on Ctrl-C; its ``result`` is the search after its last complete generation, which is also saved.
        NbcError: when the checkpoint is damaged, belongs to another declaration or seed, or cannot be written, before
            anything is simulated.
    """
    every, path = amount(checkpoint_every, "checkpoint_every"), None if checkpoint is None else os.fspath(checkpoint)
    most = None if generations is None else count(generations, "generations")
    if path is not None and os.path.exists(path):
        search = Search.resume(path, evolution)
        found = search.summary["seed"]
        if found != seed:
            raise ValueError(f"`{os.fsdecode(path)}` belongs to seed {found}, expected seed {seed}")
    else:
        search = Search(evolution, seed)
    if path is not None:
        search.save(path)
    if most is None:
        most = int(search.summary["generations"])
    try:
        with reporting(progress, " generations") as report:
            saved = time.monotonic()
            while search.generation < most:
                search.step()
                if report is not None:
                    report(search.generation, most)
                if path is not None and time.monotonic() - saved >= every:
                    search.save(path)
                    saved = time.monotonic()
    except KeyboardInterrupt:
        if path is not None:
            search.save(path)
        raise Interrupted(search) from None
    if path is not None:
        search.save(path)
    return search


def read_archive(path: Path) -> Archive:
    """The archive of a checkpoint file, without its declaration.

    Raises:
        FileNotFoundError: when there is no such file.
        NbcError: when it is damaged.
    """
    arrays, axes, materials = _nbc.read_checkpoint(os.fspath(path))
    return Archive(arrays, axes_of(axes), json.loads(materials))


def declaration(evolution: Evolution) -> Evolution:
    """The argument, if it is an evolution."""
    if not isinstance(evolution, Evolution):
        raise TypeError(f"evolution is of type {type(evolution).__name__}, expected Evolution")
    return evolution


def asked(candidates: Candidates) -> Candidates:
    """The argument, if it is what `Search.ask` returns."""
    if not isinstance(candidates, Candidates):
        raise TypeError(f"candidates is of type {type(candidates).__name__}, expected what `ask` returned")
    return candidates


def _copied(checkpoint: bytes, evolution: Evolution) -> Search:
    return Search._of(_nbc.Search.from_bytes(checkpoint, evolution._native), evolution)
