"""The names of ``evogym.envs.balance``."""

from .base import *
from .base import __all__ as _base
from .task import NamedTask

__all__ = ["Balance", "BalanceJump", *_base]


class Balance(NamedTask):
    """Balancer-v0."""

    TASK = "Balancer-v0"


class BalanceJump(NamedTask):
    """Balancer-v1."""

    TASK = "Balancer-v1"
