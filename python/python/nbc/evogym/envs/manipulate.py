"""The names of ``evogym.envs.manipulate``."""

from .base import *
from .base import __all__ as _base
from .task import NamedTask

__all__ = [
    "CarrySmallRect",
    "CarrySmallRectToTable",
    "CatchSmallRect",
    "LiftSmallRect",
    "PushSmallRect",
    "PushSmallRectOnOppositeSide",
    "SlideBeam",
    "ThrowSmallRect",
    "ToppleBeam",
    *_base,
]


class CarrySmallRect(NamedTask):
    """Carrier-v0."""

    TASK = "Carrier-v0"


class CarrySmallRectToTable(NamedTask):
    """Carrier-v1."""

    TASK = "Carrier-v1"


class PushSmallRect(NamedTask):
    """Pusher-v0."""

    TASK = "Pusher-v0"


class PushSmallRectOnOppositeSide(NamedTask):
    """Pusher-v1."""

    TASK = "Pusher-v1"


class ThrowSmallRect(NamedTask):
    """Thrower-v0."""

    TASK = "Thrower-v0"


class CatchSmallRect(NamedTask):
    """Catcher-v0."""

    TASK = "Catcher-v0"


class ToppleBeam(NamedTask):
    """BeamToppler-v0."""

    TASK = "BeamToppler-v0"


class SlideBeam(NamedTask):
    """BeamSlider-v0."""

    TASK = "BeamSlider-v0"


class LiftSmallRect(NamedTask):
    """Lifter-v0."""

    TASK = "Lifter-v0"
