"""Circuits made of brainless soft robots: exact voxel physics, evolution of bodies, and a circuit compiler.

>>> import nbc
>>> walk = nbc.simulate([["343", "563"]], "01*10")
>>> walk.displacement.shape
(1, 1)

- Physics: `simulate` and `Flock`.
- Evaluation: `evaluate` with an `Evolution`.
- Search: `Search` (ask and tell), `evolve`, `Archive`.
- Circuits: `load`, `Program`, `Compiled`, `Swarm`.
- Interchange with Evolution Gym: `nbc.evogym`.
- A pytest plugin that collects ``.nb`` files.

docs/python.md is the guide.
"""

from __future__ import annotations

from . import evogym
from ._nbc import __version__
from .bodies import PAPER_MATERIALS, THREE_MATERIALS, Robot, invalid, library, rows
from .circuits import Circuit, Compiled, Port, Program, Report, Swarm, TestResult, load, loads
from .errors import Diagnostic, InternalError, Interrupted, InvalidBodyWarning, NbcError, RobotFault, Span
from .evolution import Evaluation, Evolution, evaluate
from .physics import CYCLE_STEPS, Flock, Trajectories, simulate
from .search import Archive, Candidates, Search, evolve, read_archive
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
    "InternalError",
    "Interrupted",
    "InvalidBodyWarning",
    "NbcError",
    "Port",
    "Program",
    "Report",
    "Robot",
    "RobotFault",
    "Search",
    "Span",
    "Swarm",
    "THREE_MATERIALS",
    "TestResult",
    "Trajectories",
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
]
