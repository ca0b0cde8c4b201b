"""The names of ``evogym.envs.base``."""

from ..base import BenchmarkBase, EvoGymBase

__all__ = ["BenchmarkBase", "EvoGymBase"]
