"""Names and words that are looked up, and the one that was meant. The words that arguments may be are types."""

from __future__ import annotations

from typing import Iterable, List, Literal

from . import _nbc

__all__ = ["Effort", "Genome", "Level", "Objective", "Registers", "Sought", "Symmetry", "meant", "texts", "unknown"]

Objective = Literal["area", "delay", "margin", "sturdy"]
"""What mapping minimizes."""

Effort = Literal["fast", "normal"]
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


def texts(values: Iterable[str], name: str) -> List[str]:
    """A list of texts, which is not one text."""
    if isinstance(values, str) or not isinstance(values, Iterable):
        raise TypeError(f"{name} is {values!r}, expected a list of texts")
    listed = list(values)
    if not all(isinstance(value, str) for value in listed):
        raise TypeError(f"{name} is {values!r}, expected a list of texts")
    return listed


def unknown(what: str, name: object, known: Iterable[str]) -> str:
    """What is wrong with a name that is none of the known ones: "there is no `what` called `name`", with the known name
    most like it, or all of them if they are few."""
    names = list(known)
    message = f"there is no {what} called `{name}`"
    near = meant(name, names)
    if near or not names:
        return message + near
    return f"{message}; expected one of {', '.join(names[:20])}{', …' if len(names) > 20 else ''}"
