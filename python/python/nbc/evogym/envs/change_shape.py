"""The names of ``evogym.envs.change_shape``."""

from .base import *
from .base import __all__ as _base
from .task import NamedTask

__all__ = ["MaximizeShape", "MaximizeXShape", "MaximizeYShape", "MinimizeShape", *_base]


class MaximizeShape(NamedTask):
    """AreaMaximizer-v0."""

    TASK = "AreaMaximizer-v0"


class MinimizeShape(NamedTask):
    """AreaMinimizer-v0."""

    TASK = "AreaMinimizer-v0"


class MaximizeXShape(NamedTask):
    """WingspanMazimizer-v0."""

    TASK = "WingspanMazimizer-v0"


class MaximizeYShape(NamedTask):
    """HeightMaximizer-v0."""

    TASK = "HeightMaximizer-v0"
