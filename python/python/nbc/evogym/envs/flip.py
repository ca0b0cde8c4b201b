"""The names of ``evogym.envs.flip``."""

from .base import *
from .base import __all__ as _base
from .task import NamedTask

__all__ = ["Flipping", *_base]


class Flipping(NamedTask):
    """Flipper-v0."""

    TASK = "Flipper-v0"
