"""The names of ``evogym.envs.multi_goal``."""

from .base import *
from .base import __all__ as _base
from ..tasks import WalkToX
from .task import NamedTask

__all__ = ["BiWalk", "WalkToX", *_base]


class BiWalk(NamedTask):
    """BidirectionalWalker-v0."""

    TASK = "BidirectionalWalker-v0"
