"""Records what Evolution Gym's tasks reward and show, for `tests/test_tasks.py`.

In a Python 3.10 with nbc and Evolution Gym 2.0.0 (``pip install evogym==2.0.0``), in the folder ``python``:

    python benchmarks/record_tasks.py

writes ``tests/data/tasks.npz``. For each task and each of three random bodies it has the body, the rewards of 500 env
steps (or fewer, if the task ends) under random actions of numpy's generator with the seed 10 * task + body, the first
observation, a weighted sum of the values of each later one, which differs if any of them does, and the goals of the
task that has some.
"""

from __future__ import annotations

import multiprocessing
import random
import warnings
from pathlib import Path

import evogym
import numpy as np

from nbc.evogym.comparison import record, weights

BODIES = 3
STEPS = 500
KEYS = ("body", "rewards", "first", "goals", "observed")
# The seeds of the other tasks were given without it.
LAST = "Catcher-v0"
NAMES = sorted(evogym.BASELINE_ENV_NAMES, key=lambda name: (name == LAST, name))


def main() -> None:
    """Records all tasks, each episode in a process of its own: a second world of Traverser-v0 ends the process."""
    path = Path(__file__).parent.parent / "tests/data/tasks.npz"
    keys = [(name, n) for name in NAMES for n in range(BODIES)]
    found = {}
    with multiprocessing.Pool(1, maxtasksperchild=1) as pool:
        for (name, n), values in zip(keys, pool.imap(episode, keys, chunksize=1)):
            found.update({f"{name}/{n}/{key}": np.array(value) for key, value in zip(KEYS, values)})
            print(name, n, flush=True)
    np.savez_compressed(path, **found)


def episode(key):
    """What is recorded of a task and the number of a body."""
    warnings.simplefilter("ignore")
    name, n = key
    seed = 10 * NAMES.index(name) + n
    random.seed(seed)
    body, connections = evogym.sample_robot((4, 4) if n == 2 else (5, 5))
    found = record(name, body, np.random.default_rng(seed), STEPS, connections)
    observed = found.observations @ weights(len(found.first))
    return body.astype(np.uint8), found.rewards, found.first, found.goals, observed


if __name__ == "__main__":
    main()
