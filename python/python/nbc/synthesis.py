"""Circuits of other tools, mapped onto robots and proved."""

from __future__ import annotations

import json
import os
from typing import Any, Mapping, Optional, Sequence, Tuple, Union

from . import _nbc
from .errors import Diagnostic, diagnostics_of
from .names import Effort, Objective, Registers, texts
from .result import Result

__all__ = ["Synthesis", "synthesize"]

Path = Union[str, "os.PathLike[str]"]


class Synthesis(Result):
    """A circuit of another tool as cells. Its equality with the file is proved."""

    cells: int
    """The number of cells."""
    by_function: Mapping[str, int]
    """The number of cells of each function."""
    depth: int
    """The longest path in cells."""
    warnings: Tuple[Diagnostic, ...]

    @property
    def registers(self) -> int:
        """The registers that are left."""
        return int(self.report["latches"])


def synthesize(
    *files: Path,
    output: Optional[Path] = None,
    cells: Sequence[str] = (),
    library: Optional[Path] = None,
    objective: Objective = "area",
    effort: Effort = "normal",
    top: Optional[str] = None,
    parameters: Optional[Mapping[str, Union[int, str]]] = None,
    clock: Optional[str] = None,
    registers: Optional[Registers] = None,
    what_if: Sequence[str] = (),
) -> Synthesis:
    """Maps a circuit file onto robots, proves the result, and writes it, as ``nbc synth`` does.

    Args:
        files: the circuit: ``.blif``, ``.pla``, ``.aig``, ``.aag``, ``.bench``, or several files of Verilog, which need
            ``pip install nbc-robots[verilog]``.
        output: the file to write: ``.blif``, ``.pla``, ``.aig``, ``.aag``, ``.v``, ``.dot`` or ``.nb``.
        cells: functions of the cells, such as ``["nand", "not"]``; by default those of the robots.
        library: a folder of robot files, ``shipped`` or ``three``.
        objective: what mapping minimizes, as in `Program.compile`.
        effort: ``fast`` or ``normal``.
        top: the module of Verilog or the model of BLIF.
        parameters: values of parameters of the Verilog module.
        clock: the clock of registers without one in the file.
        registers: ``keep`` or ``expand`` to cells; by default only a ``.dot`` file expands them.
        what_if: functions of which the report says how many cells a robot for each would save.

    Raises:
        NbcError: when the circuit cannot be read, mapped or written.
    """
    if not files:
        raise TypeError("synthesize needs a file")
    if cells and library is not None:
        raise ValueError("cells and library both choose the cells; leave out one")
    if registers not in (None, "keep", "expand"):
        raise ValueError(f"invalid registers `{registers}`; expected keep or expand")
    written = None if output is None else os.fspath(output)
    expand = registers == "expand" if registers else written is not None and written.lower().endswith(".dot")
    made = json.loads(
        _nbc.synthesize(
            [os.fspath(file) for file in files],
            written,
            {
                "cells": texts(cells, "cells"),
                "library": None if library is None else os.fspath(library),
                "objective": objective,
                "effort": effort,
                "top": top,
                "parameters": [(name, str(value)) for name, value in (parameters or {}).items()],
                "clock": clock,
                "expand": expand,
                "what_if": texts(what_if, "what_if"),
            },
        )
    )
    return Synthesis(made["data"], made["text"], warnings=diagnostics_of(made["warnings"]))
