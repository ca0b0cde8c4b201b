"""The threads that simulate."""

from __future__ import annotations

from . import _nbc
from .numbers import count

__all__ = ["set_threads"]


def set_threads(threads: int) -> None:
    """Uses that many threads from now on; 0 stands for all cores.

    Raises:
        ValueError: for more than 16 threads for each core, which would be slower and could take the machine down.
    """
    _nbc.set_threads(count(threads, "threads", most=2**63))
