"""Progress of long calls."""

from __future__ import annotations

from contextlib import contextmanager
from typing import Any, Callable, Iterator, Optional, Union

__all__ = ["Progress"]

Report = Callable[[int, int], Any]
"""Called with the parts done and all parts."""

Progress = Union[bool, Report]
"""True shows a tqdm bar if tqdm is installed, False shows nothing. A function is called with parts done and all."""


@contextmanager
def reporting(progress: Progress, unit: str) -> Iterator[Optional[Report]]:
    """What the native half calls with its progress; a bar is closed at the end."""
    if callable(progress):
        yield progress
        return
    bar = _bar(unit) if progress else None
    if bar is None:
        yield None
        return

    def show(done: int, all: int) -> None:
        bar.total = all or None
        bar.update(done - bar.n)

    with bar:
        yield show


def _bar(unit: str) -> Any:
    try:
        from tqdm.auto import tqdm
    except ImportError:
        return None
    return tqdm(unit=unit, leave=False)
