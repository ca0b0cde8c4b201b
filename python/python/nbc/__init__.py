"""Circuits made of brainless soft robots: exact voxel physics, evolution of bodies, and a circuit compiler.

>>> import nbc
>>> walk = nbc.simulate([["343", "563"]], "01*10")
>>> walk.displacement.shape
(1, 1)

- Physics: `simulate` and `Flock`.
- Evaluation: `evaluate` with an `Evolution`.
- Search: `Search` (ask and tell), `evolve`, `Archive`.
- Circuits: `load`, `Program`, `Compiled`, `Swarm`; `synthesize` for those of other tools.
- Interchange with Evolution Gym: `nbc.evogym`.
- A pytest plugin that collects ``.nb`` files.

docs/python.md is the guide.
"""

from __future__ import annotations

from . import evogym
from ._nbc import __version__
from .bodies import PAPER_MATERIALS, THREE_MATERIALS, Robot, invalid, library, rows, verify
from .circuits import Circuit, Compiled, Hardened, Port, Program, Report, Swarm, TestResult, Yield, load, loads
from .errors import (
    Diagnostic,
    InternalError,
    Interrupted,
    InvalidBodyWarning,
    MissingRobotWarning,
    NbcError,
    RobotFault,
    Span,
)
from .evolution import Evaluation, Evolution, evaluate
from .physics import CYCLE_STEPS, Flock, Trajectories, simulate
from .search import Archive, Candidates, Search, evolve, read_archive
from .synthesis import Synthesis, synthesize
from .threads import set_threads

__all__ = [
    "CYCLE_STEPS",
    "PAPER_MATERIALS",
    "Archive",
    "Candidates",
    "Circuit",
    "Compiled",
    "Diagnostic",
    "Evaluation",
    "Evolution",
    "Flock",
    "Hardened",
    "InternalError",
    "Interrupted",
    "InvalidBodyWarning",
    "MissingRobotWarning",
    "NbcError",
    "Port",
    "Program",
    "Report",
    "Robot",
    "RobotFault",
    "Search",
    "Span",
    "Swarm",
    "Synthesis",
    "THREE_MATERIALS",
    "TestResult",
    "Trajectories",
    "Yield",
    "__version__",
    "evaluate",
    "evogym",
    "evolve",
    "invalid",
    "library",
    "load",
    "loads",
    "read_archive",
    "rows",
    "set_threads",
    "simulate",
    "synthesize",
    "verify",
]
