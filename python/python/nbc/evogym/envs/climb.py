"""The names of ``evogym.envs.climb``."""

from .base import *
from .base import __all__ as _base
from .task import NamedTask

__all__ = ["Climb0", "Climb1", "Climb2", *_base]


class Climb0(NamedTask):
    """Climber-v0."""

    TASK = "Climber-v0"


class Climb1(NamedTask):
    """Climber-v1."""

    TASK = "Climber-v1"


class Climb2(NamedTask):
    """Climber-v2."""

    TASK = "Climber-v2"
