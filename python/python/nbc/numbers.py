"""Whole numbers and arrays from any library."""

from __future__ import annotations

import math
import operator
from typing import Any

import numpy as np
import numpy.typing as npt

__all__ = ["amount", "array_of", "count", "finite", "is_array", "real", "whole"]


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


def amount(value: Any, name: str, least: float = 0.0, most: float = math.inf) -> float:
    """A number in a range; also a numpy scalar, or an array of one."""
    array = array_of(value)
    if array.ndim or array.dtype.kind not in "biuf":
        raise TypeError(f"{name} is {_shown(value)}, expected a number")
    if not least <= array <= most:
        expected = f"{least:g} or more" if most == math.inf else f"{least:g} to {most:g}"
        raise ValueError(f"{name} is {array}, expected {expected}")
    return float(array)


def is_array(value: Any) -> bool:
    """Whether it is an array of numpy or of another library, such as JAX."""
    return not isinstance(value, type) and (hasattr(value, "__array__") or hasattr(value, "__dlpack__"))


def array_of(value: Any) -> npt.NDArray[Any]:
    """The numpy array of an array of any library, without a copy where possible.

    Raises:
        TypeError: for a masked array, also in a list, whose mask would be lost.
    """
    if _is_masked(value):
        raise TypeError("masked arrays are not read; `filled` makes a plain array of one")
    # A tensor of torch with a gradient gives its numbers only when it is detached.
    if getattr(value, "requires_grad", False) is True:
        value = value.detach()
    if hasattr(value, "__array__"):
        return np.asarray(value)
    if hasattr(value, "__dlpack__"):
        return np.from_dlpack(value)
    try:
        return np.asarray(value)
    except ValueError as error:
        raise ValueError("the rows of an array have different lengths") from error


def _is_masked(value: Any) -> bool:
    if isinstance(value, (list, tuple)):
        return any(map(_is_masked, value))
    return isinstance(value, np.ma.MaskedArray)


def real(values: Any, name: str) -> npt.NDArray[np.float64]:
    """Numbers as floats, of an array of any library."""
    array = array_of(values)
    if array.dtype.kind not in "biuf":
        raise TypeError(f"{name} has the dtype {array.dtype}, expected numbers")
    return np.asarray(array, dtype=np.float64, order="C")


def finite(values: Any, name: str) -> npt.NDArray[np.float64]:
    """Numbers as floats, none of them NaN or infinite."""
    array = real(values, name)
    _check(array, np.isfinite(array), name, "a finite number")
    return array


def whole(values: Any, name: str, least: int = 0, most: int = 2**62) -> npt.NDArray[np.int64]:
    """Whole numbers in a range, which may be floats such as 3.0."""
    array = array_of(values)
    if array.size and array.dtype.kind not in "iuf":
        raise TypeError(f"{name} has the dtype {array.dtype}, expected whole numbers")
    fits = (array >= least) & (array <= most) & (array.dtype.kind != "f" or np.floor(array) == array)
    _check(array, fits, name, f"a whole number from {least} to {most}")
    return array.astype(np.int64)


def _check(array: npt.NDArray[Any], fits: npt.NDArray[np.bool_], name: str, expected: str) -> None:
    """Raises ValueError for the first value that does not fit."""
    if not np.all(fits):
        place = tuple(np.argwhere(~fits)[0].tolist())
        where = f" at {place[0] if len(place) == 1 else place}" if place else ""
        raise ValueError(f"{name}{where} is {array[place]}, expected {expected}")


def _shown(value: object) -> str:
    """A value in a message, not longer than a line."""
    text = repr(value) if not isinstance(value, int) or abs(value) < 10**30 else "a number of more than 30 digits"
    return text if len(text) <= 100 else f"{text[:100]}…"
