"""The names of ``evogym.envs.walk``."""

from .base import *
from .base import __all__ as _base
from .task import NamedTask

__all__ = ["Duck", "SoftBridge", "WalkingFlat", *_base]


class WalkingFlat(NamedTask):
    """Walker-v0."""

    TASK = "Walker-v0"


class SoftBridge(NamedTask):
    """BridgeWalker-v0."""

    TASK = "BridgeWalker-v0"


class Duck(NamedTask):
    """CaveCrawler-v0."""

    TASK = "CaveCrawler-v0"
