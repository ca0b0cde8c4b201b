"""Records what Evolution Gym's tasks reward, for `tests/test_tasks.py`.

In a Python 3.10 with nbc and Evolution Gym 2.0.0 (``pip install evogym==2.0.0``), in the folder ``python``:

    python benchmarks/record_tasks.py

writes ``tests/data/tasks.npz``. For each task and each of three random bodies it has the body, the rewards of 500 env
steps (or fewer, if the task ends) under random actions of numpy's generator with the seed 10 * task + body, the first
observation, and the goals of the task that has some.
"""

from __future__ import annotations

import random
import warnings
from pathlib import Path

import evogym
import numpy as np

from nbc.evogym.comparison import record

BODIES = 3
STEPS = 500
KEYS = ("body", "rewards", "first", "goals")
# The seeds of the other tasks were given without it.
LAST = "Catcher-v0"


def main() -> None:
    """Records all tasks."""
    warnings.simplefilter("ignore")
    found = {}
    for number, name in enumerate(sorted(evogym.BASELINE_ENV_NAMES, key=lambda name: (name == LAST, name))):
        for n in range(BODIES):
            seed = 10 * number + n
            random.seed(seed)
            body, connections = evogym.sample_robot((4, 4) if n == 2 else (5, 5))
            episode = record(name, body, np.random.default_rng(seed), STEPS, connections)
            values = (body.astype(np.uint8), episode.rewards, episode.first, episode.goals)
            found.update({f"{name}/{n}/{key}": np.array(value) for key, value in zip(KEYS, values)})
        print(name, flush=True)
    np.savez_compressed(Path(__file__).parent.parent / "tests/data/tasks.npz", **found)


if __name__ == "__main__":
    main()
