"""Evolution Gym's tasks as environments of gymnasium: one robot, or many at once.

``gymnasium.make("nbc/Walker-v0", body=body)`` makes `TaskEnv`, ``TaskVectorEnv("Walker-v0", bodies)`` many. After the
import of this module ``"Walker-v0"`` is known, too, unless Evolution Gym has made it. Names, observations, rewards and
ends are Evolution Gym's, and so are the names of the classes: `WalkingFlat` is Walker-v0.
"""

from __future__ import annotations

from ...registration import register_tasks
from ..vector import TaskVectorEnv, make_many
from . import balance, base, change_shape, climb, flip, jump, manipulate, multi_goal, traverse, walk
from .balance import *
from .base import *
from .change_shape import *
from .climb import *
from .flip import *
from .jump import *
from .manipulate import *
from .multi_goal import *
from .task import NamedTask, TaskEnv
from .traverse import *
from .walk import *

__all__ = ["NamedTask", "TaskEnv", "TaskVectorEnv", "make_many", "register_tasks"]
for _module in (balance, base, change_shape, climb, flip, jump, manipulate, multi_goal, traverse, walk):
    # As `from evogym.envs import *` has them.
    __all__ += [name for name in _module.__all__ if name not in __all__]

register_tasks()
# As after `import evogym.envs`; where that comes first or later, these names are Evolution Gym's own.
register_tasks(namespace="")
