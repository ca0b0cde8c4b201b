"""Exceptions of the package, and the diagnostics that they carry."""

from __future__ import annotations

import json
import warnings
from dataclasses import dataclass
from typing import Any, Dict, Iterable, Mapping, Optional, Sequence, Tuple

__all__ = [
    "Diagnostic",
    "InternalError",
    "Interrupted",
    "InvalidBodyWarning",
    "MissingRobotWarning",
    "NbcError",
    "RobotFault",
    "Span",
]


@dataclass(frozen=True)
class Span:
    """A place in a source text. Lines and columns count from 1, bytes from 0; the end is exclusive."""

    file: str
    line: int
    column: int
    end_line: int
    end_column: int
    start_byte: int
    end_byte: int
    text: str
    """The label of the place."""

    def __str__(self) -> str:
        return f"{self.file}:{self.line}:{self.column}"


@dataclass(frozen=True)
class Diagnostic:
    """One error or warning about a source text. ``nbc explain CODE`` describes each code."""

    code: str
    severity: str
    """``error`` or ``warning``."""
    message: str
    help: Optional[str]
    labels: Tuple[Span, ...]
    """The places it is about, the main one first."""
    related: Tuple[Span, ...]

    @property
    def span(self) -> Optional[Span]:
        """The main place; None for a diagnostic without a place in a text."""
        return self.labels[0] if self.labels else None

    def __str__(self) -> str:
        place = f"{self.span}: " if self.span else ""
        help = f"\n  help: {self.help}" if self.help else ""
        return f"{place}{self.severity}[{self.code}]: {self.message}{help}"


class NbcError(Exception):
    """Something is wrong with a source text, a schedule, a file or a checkpoint.

    ``diagnostics`` has every error found, each with its code, message, place and help.
    """

    def __init__(self, message: str, diagnostics: Sequence[Diagnostic] = ()) -> None:
        super().__init__(message)
        self.diagnostics: Tuple[Diagnostic, ...] = tuple(diagnostics)

    def __reduce__(self) -> Any:
        return type(self), (str(self), self.diagnostics)


class InternalError(NbcError):
    """A fault of nbc itself. Please report it with the call that led to it.

    A `Flock`, `Search` or `Swarm` that was in use is lost: its later calls raise RuntimeError. All others work on.
    """


class RobotFault(NbcError):
    """The simulation of a robot of a `Swarm` failed, so that the swarm has no more outputs. Its cycles before stay."""


class Interrupted(KeyboardInterrupt):
    """Ctrl-C ended a call that already had results.

    ``result`` is what the call would have returned, as far as it came; what was cut off is marked as stopped.
    """

    def __init__(self, result: Any) -> None:
        super().__init__("interrupted; the results so far are in `.result`")
        self.result = result

    def __reduce__(self) -> Any:
        return type(self), (self.result,)


class InvalidBodyWarning(UserWarning):
    """Some bodies of a call are invalid, and have no results; its ``errors`` has the reason for each.

    ``warnings.simplefilter("error", nbc.InvalidBodyWarning)`` makes it an exception.
    """


class MissingRobotWarning(UserWarning):
    """There is no robot for some behaviors, each with the reason."""


def report_invalid(found: Iterable[Tuple[int, str]], unread: Mapping[int, str], bodies: int) -> Dict[int, str]:
    """The reasons by body, told by a warning.

    Args:
        found: the invalid bodies of the native half with their reasons.
        unread: better reasons for those that could not be read.
        bodies: the number of all bodies.

    Raises:
        ValueError: when all bodies are invalid.
    """
    errors = {number: unread.get(number, reason) for number, reason in found}
    if not errors:
        return errors
    number, reason = next(iter(errors.items()))
    if len(errors) == bodies:
        others = "" if bodies == 1 else f" (all {bodies} bodies are invalid)"
        raise ValueError(f"bodies[{number}]: {reason}{others}")
    which = "1 body of" if len(errors) == 1 else f"{len(errors)} bodies of"
    text = f"{which} {bodies} could not be simulated; see `errors`. bodies[{number}]: {reason}"
    # The place of the call of `simulate` or `evaluate`.
    warnings.warn(text, InvalidBodyWarning, stacklevel=4)
    return errors


def diagnostics_of(records: Sequence[Mapping[str, Any]]) -> Tuple[Diagnostic, ...]:
    """Diagnostics of their JSON records."""
    return tuple(
        Diagnostic(
            code=record["code"],
            severity=record["severity"],
            message=record["message"],
            help=record["help"],
            labels=tuple(_span(place) for place in record["labels"]),
            related=tuple(_span(place) for place in record["related"]),
        )
        for record in records
    )


def _span(place: Mapping[str, Any]) -> Span:
    start, end = place["start"], place["end"]
    return Span(
        file=place["file"],
        line=start["line"],
        column=start["column"],
        end_line=end["line"],
        end_column=end["column"],
        start_byte=start["byte"],
        end_byte=end["byte"],
        text=place["text"],
    )


def _diagnosed(message: str, records: str) -> NbcError:
    return NbcError(message, diagnostics_of(json.loads(records)))
