"""The names of ``evogym.envs.jump``."""

from .base import *
from .base import __all__ as _base
from .task import NamedTask

__all__ = ["StationaryJump", *_base]


class StationaryJump(NamedTask):
    """Jumper-v0."""

    TASK = "Jumper-v0"
