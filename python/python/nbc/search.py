"""Search: ask, evaluate and tell; whole runs; archives and checkpoints."""

from __future__ import annotations

import json
import os
import time
from typing import Any, Dict, List, Mapping, Optional, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _nbc
from .errors import Interrupted
from .evolution import Evaluation, Evolution, letters, of_arrays
from .physics import count
from .progress import Progress, reporting

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


class Archive:
    """Elites in their niches.

    ``elites`` is a structured array with a row for each elite: ``niche`` (a bin for each axis), ``fitness`` (2),
    ``behavior``, ``displacement`` (4), ``body`` (H, W), ``generation`` and ``evaluations``.
    """

    def __init__(self, arrays: Mapping[str, Any], axes: Tuple[Tuple[str, int], ...]) -> None:
        rows = len(arrays["behavior"])
        shape = {name: arrays[name].shape[1:] for name in ("niche", "body")}
        fields: List[Tuple[Any, ...]] = [
            ("niche", "u2", shape["niche"]),
            ("fitness", "f8", (2,)),
            ("behavior", "U4"),
            ("displacement", "f8", (4,)),
            ("body", "u1", shape["body"]),
            ("generation", "u4"),
            ("evaluations", "u8"),
        ]
        self.axes = axes
        """The name and the number of bins of each axis."""
        self.elites: npt.NDArray[Any] = np.zeros(rows, dtype=fields)
        for name in self.elites.dtype.names or ():
            self.elites[name] = arrays[name]

    def __len__(self) -> int:
        return len(self.elites)

    def frame(self) -> Any:
        """The elites as a pandas frame: a column for each axis, fitness, displacement, behavior, generation and rows of
        the body."""
        import pandas

        columns: Dict[str, Any] = {name: self.elites["niche"][:, i] for i, (name, _) in enumerate(self.axes)}
        if "behavior" in columns:
            columns["function"] = columns.pop("behavior")
        columns["behavior"] = letters(self.elites["behavior"])
        columns["fitness_1"], columns["fitness_2"] = self.elites["fitness"].T
        for i, pattern in enumerate(("00", "01", "10", "11")):
            columns[f"displacement_{pattern}"] = self.elites["displacement"][:, i]
        columns["generation"], columns["evaluations"] = self.elites["generation"], self.elites["evaluations"]
        columns["body"] = [" ".join("".join(np.base_repr(c, 36) for c in row) for row in body).lower()
                           for body in self.elites["body"].tolist()]
        return pandas.DataFrame(columns)

    def heatmap(self, x: str, y: str) -> npt.NDArray[np.float64]:
        """The best first fitness over two axes, shape (bins of y, bins of x); NaN where no niche is filled."""
        names = [name for name, _ in self.axes]
        for name in (x, y):
            if name not in names:
                raise ValueError(f"the archive has no axis `{name}`; expected one of {', '.join(names)}")
        (i, across), (j, up) = ((names.index(name), dict(self.axes)[name]) for name in (x, y))
        best = np.full((up, across), -np.inf)
        np.maximum.at(best, (self.elites["niche"][:, j], self.elites["niche"][:, i]), self.elites["fitness"][:, 0])
        return np.where(np.isneginf(best), np.nan, best)

    def __repr__(self) -> str:
        return f"<Archive: {len(self)} elites over {' x '.join(f'{name} {bins}' for name, bins in self.axes)}>"


class Search:
    """A MAP-Elites search: ask for candidates, evaluate them in any way, tell the results.

    The same seed gives the same archive on any number of cores and after any number of interruptions.

    >>> import nbc
    >>> search = nbc.Search(nbc.Evolution(box=(3, 3), batch=4, fixed="1 cycles"), seed=7)
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
        self._native = _nbc.Search(evolution._native, count(seed, "seed", most=2**64 - 1))

    @classmethod
    def resume(cls, path: Path, evolution: Evolution) -> Search:
        """The search of a checkpoint, which `save` or ``nbc evolve`` wrote.

        Raises:
            FileNotFoundError: when there is no such file.
            NbcError: when it is damaged, or belongs to another declaration.
        """
        search = cls.__new__(cls)
        search.evolution = evolution
        search._native = _nbc.Search.resume(os.fspath(path), evolution._native)
        return search

    def save(self, path: Path) -> None:
        """Writes a checkpoint, whole or not at all. ``nbc draw`` and ``nbc export`` read it too."""
        self._native.save(os.fspath(path))

    def ask(self) -> Candidates:
        """The candidates of the next generation; the same ones until `tell`."""
        return Candidates(self._native.ask())

    def evaluate(self, candidates: Candidates) -> Evaluation:
        """Evaluates candidates by the protocol of the declaration, on all cores. Simulations that cannot matter for the
        archive as it is are left out: such bodies are ``surpassed``."""
        return of_arrays(self._native.evaluate(candidates._native))

    def tell(self, candidates: Candidates, evaluation: Evaluation) -> None:
        """Takes the results of the candidates of `ask`, which completes a generation.

        Raises:
            ValueError: for results of other shapes, scores that are not finite numbers, or candidates of another
                search or generation.
        """
        size = len(candidates)
        for name, shape in (("outcome", (size,)), ("fitness", (size, 2)), ("displacement", (size, 4)),
                            ("behavior", (size,))):
            found = np.shape(getattr(evaluation, name))
            if found != shape:
                raise ValueError(f"{name} has the shape {found}, expected {shape}")
        numbers = (np.ascontiguousarray(evaluation.fitness, dtype=np.float64),
                   np.ascontiguousarray(evaluation.displacement, dtype=np.float64))
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
        return Archive(self._native.archive(), self.evolution.axes)

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
        generations: stop when so many generations are done; by default those of the declaration.
        checkpoint: a file to save to, and to resume from if it exists.
        checkpoint_every: seconds between checkpoints.
        progress: whether to show a tqdm bar, or a function of the generations done and all generations.

    Raises:
        Interrupted: on Ctrl-C; its ``result`` is the search after its last complete generation, which is also saved.
        NbcError: when the checkpoint is damaged, or belongs to another declaration or seed.
    """
    if checkpoint is not None and os.path.exists(checkpoint):
        search = Search.resume(checkpoint, evolution)
        found = search.summary["seed"]
        if found != seed:
            raise ValueError(f"`{os.fspath(checkpoint)}` belongs to seed {found}, expected seed {seed}")
    else:
        search = Search(evolution, seed)
    declared = int(search.summary["generations"])
    most = declared if generations is None else min(declared, count(generations, "generations"))
    try:
        with reporting(progress, " generations") as report:
            saved = time.monotonic()
            while search.generation < most:
                search.step()
                if report is not None:
                    report(search.generation, most)
                if checkpoint is not None and time.monotonic() - saved >= checkpoint_every:
                    search.save(checkpoint)
                    saved = time.monotonic()
    except KeyboardInterrupt:
        if checkpoint is not None:
            search.save(checkpoint)
        raise Interrupted(search) from None
    if checkpoint is not None:
        search.save(checkpoint)
    return search


def read_archive(path: Path) -> Archive:
    """The archive of a checkpoint file, without its declaration.

    Raises:
        FileNotFoundError: when there is no such file.
        NbcError: when it is damaged.
    """
    arrays, axes = _nbc.read_checkpoint(os.fspath(path))
    return Archive(arrays, tuple(axes))
