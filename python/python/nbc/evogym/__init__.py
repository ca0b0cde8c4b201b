"""Evolution Gym: its worlds, simulator and tasks under its names, with its numbers, and the interchange of bodies.

A script of Evolution Gym runs here when its imports are changed: ``evogym`` becomes ``nbc.evogym``, ``evogym.envs``
becomes ``nbc.evogym.envs``, and ``gymnasium.make("Walker-v0", …)`` becomes ``gymnasium.make("nbc/Walker-v0", …)``.
Evolution Gym itself is not needed; the environments need gymnasium. docs/evolution-gym.md is the guide.

Bodies of ``nbc`` in other modules have codes of their own: there 4 is a horizontal actuator in antiphase.
`to_structure` and `from_structure` translate.
"""

from __future__ import annotations

from .comparison import Comparison, compare
from .exchange import actions, connections, from_structure, to_structure
from .picture import draw as draw_world
from .picture import save_gif
from .sim import EvoSim, Scenes
from .tasks import TASKS, Task
from .utils import __all__ as _helpers
from .utils import *
from .viewer import EvoViewer
from .world import EvoWorld, WorldObject

__all__ = [
    "TASKS",
    "Comparison",
    "EvoSim",
    "EvoViewer",
    "EvoWorld",
    "Scenes",
    "Task",
    "WorldObject",
    "actions",
    "compare",
    "connections",
    "draw_world",
    "from_structure",
    "save_gif",
    "to_structure",
]

__all__ += _helpers
