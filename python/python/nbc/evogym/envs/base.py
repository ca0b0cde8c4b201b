"""The names of ``evogym.envs.base``."""

from ...evogym import *
from ...evogym import __all__ as _names
from ..base import BenchmarkBase, EvoGymBase

__all__ = ["BenchmarkBase", "EvoGymBase", *_names]
