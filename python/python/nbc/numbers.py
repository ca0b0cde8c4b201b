"""Whole numbers and arrays from any library."""

from __future__ import annotations

import math
import operator
from typing import Any

import numpy as np
import numpy.typing as npt

__all__ = ["array_of", "count", "is_array", "seconds"]


def count(value: Any, name: str, least: int = 0, most: int = 2**31) -> int:
    """A whole number in a range; also a numpy scalar, or an array of one."""
    if isinstance(value, np.bool_):
        value = bool(value)
    elif is_array(value) and not isinstance(value, np.generic) and np.ndim(array_of(value)) == 0:
        value = array_of(value).item()
    try:
        number = operator.index(value)
    except TypeError:
        raise TypeError(f"{name} is {_shown(value)}, expected a whole number") from None
    if not least <= number <= most:
        raise ValueError(f"{name} is {_shown(number)}, expected {least} to {most}")
    return number


def seconds(value: Any, name: str) -> float:
    """A time that is not negative."""
    try:
        number = float(value)
    except (TypeError, ValueError, OverflowError):
        raise TypeError(f"{name} is {_shown(value)}, expected a number of seconds") from None
    if math.isnan(number) or number < 0:
        raise ValueError(f"{name} is {number}, expected a number of seconds from 0 on")
    return number


def is_array(value: Any) -> bool:
    """Whether it is an array of numpy or of another library, such as JAX."""
    return not isinstance(value, type) and (hasattr(value, "__array__") or hasattr(value, "__dlpack__"))


def array_of(value: Any) -> npt.NDArray[Any]:
    """The numpy array of an array of any library, without a copy where possible.

    Raises:
        TypeError: for a masked array, whose mask would be lost.
    """
    if isinstance(value, np.ma.MaskedArray):
        raise TypeError("masked arrays are not read; `filled` makes a plain array of one")
    # A tensor of torch with a gradient gives its numbers only when it is detached.
    if getattr(value, "requires_grad", False) is True:
        value = value.detach()
    if hasattr(value, "__array__"):
        return np.asarray(value)
    if hasattr(value, "__dlpack__"):
        return np.from_dlpack(value)
    return np.asarray(value)


def _shown(value: object) -> str:
    """A value in a message, not longer than a line."""
    text = repr(value) if not isinstance(value, int) or abs(value) < 10**30 else "a number of more than 30 digits"
    return text if len(text) <= 100 else f"{text[:100]}…"
