"""The names of the package, without `nbc.evogym`."""

from __future__ import annotations

from ._nbc import __version__
from .bodies import PAPER_MATERIALS, THREE_MATERIALS, Robot, invalid, library, rows, verify
from .circuits import Circuit, Compiled, Hardened, Port, Program, Property, Report, Swarm, TestResult, Yield, load
from .circuits import loads
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
from .learning import Learned, learn
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
    "Learned",
    "MissingRobotWarning",
    "NbcError",
    "Port",
    "Program",
    "Property",
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
    "evolve",
    "invalid",
    "learn",
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
