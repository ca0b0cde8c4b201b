"""Compares every observation and reward of Evolution Gym's tasks there and here, under the same random actions.

In a Python 3.10 with Evolution Gym 2.0.0 and nbc:

    python benchmarks/observations.py 500 3

The arguments are the env steps and the random bodies of each task; names of tasks may follow. For each episode the
command prints how many env steps agree to 1e-9 before the first that does not, and which parts of the observation
differ then. If the points of the robot still agree in the last env step, only these parts were decided by a last bit;
otherwise the walks go different ways from there.
"""

from __future__ import annotations

import random
import sys
import warnings
from typing import List

import numpy as np

import nbc
from nbc.evogym import TASKS, sample_robot
from nbc.evogym.tasks import TaskWorlds

TOLERANCE = 1e-9


def main() -> None:
    """Prints a table in Markdown."""
    warnings.simplefilter("ignore")
    arguments = sys.argv[1:] or ["500", "3"]
    steps, bodies = int(arguments[0]), int(arguments[1])
    print("| task | body | env steps | rewards | observations | first to differ | robot at the end |")
    print("|---" * 7 + "|")
    for name in arguments[2:] or TASKS:
        for number in range(bodies):
            random.seed(1 + number)
            body, _ = sample_robot((4, 4) if number == 2 else (5, 5))
            (found,) = nbc.evogym.compare(name, [body], steps=steps, seed=1 + number)
            parts, ends = _parts(name, body)
            differences = np.abs(found.observations - found.there.observations)
            agreed, total = found.observed(TOLERANCE), len(found.rewards)
            first, last = "", ""
            if agreed < total:
                differs = [
                    f"{part} by {differences[agreed, start:end].max():.0e}"
                    for part, start, end in zip(parts, [0, *ends], ends)
                    if not (differences[agreed, start:end] <= TOLERANCE).all()
                ]
                first = ", ".join(differs)
                robot = parts.index("shape")
                last = f"{differences[-1, [0, *ends][robot] : ends[robot]].max():.0e}"
            cells = [name, number + 1, total, found.agreed(TOLERANCE), agreed, first, last]
            print("| " + " | ".join(map(str, cells)) + " |", flush=True)


def _parts(name: str, body: np.ndarray) -> "tuple[List[str], List[int]]":
    """The names of the parts of an observation, and where they end."""
    task = TASKS[name]
    now = TaskWorlds(task, [task.make_world(body)]).now
    names = [getattr(part, "func", part).__name__ for part in task.observes]
    return names, np.cumsum([part(now).shape[1] for part in task.observes]).tolist()


if __name__ == "__main__":
    main()
