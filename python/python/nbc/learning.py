"""Circuits that are learned from examples."""

from __future__ import annotations

import json
import os
from typing import Any, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _nbc
from .circuits import Circuit, loads
from .names import texts
from .numbers import amount, array_of, count, whole
from .progress import Progress, reporting
from .result import Result

__all__ = ["Learned", "learn"]

Path = Union[str, "os.PathLike[str]"]


class Learned(Result):
    """A circuit that was learned. In a notebook it is shown with its table of confusions.

    ``report`` is the JSON of ``nbc learn``, with all methods that were tried.
    """

    ands: int
    """AND gates, inverters not counted."""
    depth: int
    """The longest path in cells."""
    source: Optional[str]
    """The circuit as a program; None if it is too large for one."""
    _picture: Optional[str]

    @property
    def name(self) -> str:
        """The name of the circuit."""
        return str(self.report["circuit"])

    @property
    def training(self) -> float:
        """The share of the training rows that it gets right."""
        return float(self.report["training"]["accuracy"])

    @property
    def held_out(self) -> Optional[float]:
        """The share of the rows that were held out; None if there are none."""
        return self.report["held_out"]["accuracy"] if "held_out" in self.report else None

    @property
    def values(self) -> Tuple[int, ...]:
        """The values of its output, if it has one output with at most 16 values."""
        return tuple(self.report["confusion"]["values"]) if "confusion" in self.report else ()

    @property
    def confusion(self) -> npt.NDArray[np.intp]:
        """How often each of the values (columns) came in the place of the one wanted (rows), in the rows that were held
        out, or else in the training rows; shape (values, values)."""
        counts = self.report["confusion"]["counts"] if "confusion" in self.report else []
        return np.array(counts, dtype=np.intp).reshape([len(self.values)] * 2)

    @property
    def circuit(self) -> Circuit:
        """The circuit, to be compiled or proved.

        Raises:
            ValueError: when it is too large for a program.
        """
        if self.source is None:
            raise ValueError(f"the circuit `{self.name}` is too large for a program; write it to a .blif file")
        (circuit,) = loads(self.source, f"{self.name}.nb").circuits.values()
        return circuit

    def _repr_html_(self) -> str:
        return super()._repr_html_() + (self._picture or "")


def learn(
    rows: Union[Path, Mapping[str, Any]],
    output: Optional[Path] = None,
    *,
    name: Optional[str] = None,
    target: Sequence[str] = (),
    gates: int = 5000,
    hold_out: float = 20.0,
    group: int = 1,
    seed: int = 1,
    progress: Progress = False,
) -> Learned:
    """Learns a circuit from examples, as ``nbc learn`` does.

    Args:
        rows: a file, ``.csv`` or ``.pla``, or columns: a pandas frame or a mapping of names to arrays of whole numbers
            from 0. An array of shape (rows, bits) of zeros and ones is a port of so many bits, the highest first. NaN
            is any value.
        output: the file to write: ``.nb``, ``.blif``, ``.pla``, ``.aig``, ``.aag``, ``.v`` or ``.dot``.
        name: the name of the circuit; by default that of the output, or else of the rows.
        target: ports that are outputs; by default those of a PLA, or the last port.
        gates: the most AND gates, inverters not counted.
        hold_out: the share of the rows in percent that the learner does not see.
        group: so many rows after each other belong together: all are held out, or none.
        seed: the seed of all random choices.
        progress: whether to show a tqdm bar, or a function of the parts done and all parts.

    Raises:
        TypeError, ValueError: for columns that are not of whole numbers or of different lengths, masked arrays, and
            numbers out of their range.
        NbcError: when the rows cannot be read or learned from, or the circuit cannot be written.
    """
    if isinstance(rows, (str, os.PathLike)):
        file, text = os.fspath(rows), None
    elif hasattr(rows, "items"):
        file, text = "rows.csv", _csv(rows)
    else:
        raise TypeError(f"rows is of type {type(rows).__name__}, expected a file, a frame or a mapping of columns")
    percent = amount(hold_out, "hold_out", most=100.0)
    if percent == 100:
        raise ValueError("hold_out is 100, expected less, so that there are rows to learn from")
    written = None if output is None else os.fspath(output)
    if not isinstance(name, (str, type(None))):
        raise TypeError(f"name is {name!r}, expected a text")
    named = name or os.path.splitext(os.path.basename(written or file))[0]
    arguments = {
        "name": named,
        "file": file,
        "text": text,
        "output": written,
        "target": texts(target, "target"),
        "gates": count(gates, "gates"),
        "hold_out": percent,
        "group": count(group, "group", least=1, most=10**6),
        "seed": count(seed, "seed", least=0, most=2**64 - 1),
    }
    with reporting(progress, " parts") as report:
        made = json.loads(_nbc.learn(arguments, report))
    return Learned(made["data"], made["text"], source=made["source"], _picture=made["picture"])


def _csv(columns: Mapping[str, Any]) -> str:
    """Columns as the text of a file: a port of several bits has a column for each."""
    names: List[str] = []
    texts: List[List[str]] = []
    for name, column in columns.items():
        values = array_of(column)
        if values.ndim == 2:
            width = values.shape[1]
            names += [f"{name}[{width - 1 - bit}]" for bit in range(width)]
            texts += [_texts(str(name), values[:, bit]) for bit in range(width)]
        else:
            names.append(str(name))
            texts.append(_texts(str(name), values))
    if not texts or len({len(text) for text in texts}) > 1:
        raise ValueError("rows needs columns of the same length")
    return "\n".join(",".join(line) for line in [names, *(list(row) for row in zip(*texts))]) + "\n"


def _texts(name: str, values: npt.NDArray[Any]) -> List[str]:
    """The numbers of a column as text."""
    if values.ndim != 1:
        raise ValueError(f"the column `{name}` has {values.ndim} dimensions, expected 1 or 2")
    if values.dtype.kind == "f":
        is_any = np.isnan(values)
        numbers = whole(np.where(is_any, 0.0, values), f"the column `{name}`", most=2**53)
        return ["-" if open else str(value) for open, value in zip(is_any, numbers)]
    if values.dtype.kind not in "biu":
        raise TypeError(f"the column `{name}` has the dtype {values.dtype}, expected whole numbers")
    return [str(int(value)) for value in values]
