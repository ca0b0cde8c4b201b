"""Robots in physics, which can be freed."""

from __future__ import annotations

from typing import Any, TypeVar

Own = TypeVar("Own", bound="Closing")


class Closing:
    """What has robots in physics. A ``with`` frees them at its end."""

    _native: Any

    def close(self) -> None:
        """Frees the robots. Later calls raise ValueError."""
        self._native.close()

    def __enter__(self: Own) -> Own:
        return self

    def __exit__(self, *error: object) -> None:
        self.close()
