"""Names and words that are looked up, and the one that was meant. The words that arguments may be are types."""

from __future__ import annotations

from typing import Iterable, Literal

from . import _nbc

__all__ = ["Effort", "Genome", "Level", "Objective", "Registers", "Sought", "Symmetry", "meant", "unknown"]

Objective = Literal["area", "delay", "margin", "sturdy"]
"""What mapping minimizes."""

Effort = Literal["fast", "normal", "high"]
"""How hard mapping tries."""

Level = Literal["logic", "physics"]
"""What a test simulates."""

Registers = Literal["keep", "expand"]
"""What synthesis does with registers."""

Genome = Literal["cppn", "voxels"]
"""What an evolution changes."""

Sought = Literal["distance", "gate", "wave"]
"""What an evolution searches for."""

Symmetry = Literal["none", "npn"]
"""Which behaviors an evolution takes for one."""


def meant(name: object, known: Iterable[str]) -> str:
    """The end of a message that offers the known name most like it, or nothing."""
    near = _nbc.nearest(str(name), list(known))
    return "" if near is None else f"; did you mean `{near}`?"


def unknown(what: str, name: object, known: Iterable[str]) -> str:
    """What is wrong with a name that is none of the known ones: "there is no `what` called `name`", with the known name
    most like it, or all of them if they are few."""
    names = list(known)
    message = f"there is no {what} called `{name}`"
    near = meant(name, names)
    if near or not names:
        return message + near
    return f"{message}; expected one of {', '.join(names[:20])}{', …' if len(names) > 20 else ''}"
