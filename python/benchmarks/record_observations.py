"""Records what Evolution Gym's tasks observe, for `tests/test_tasks.py`.

In a Python 3.10 with nbc and Evolution Gym 2.0.0 (``pip install evogym==2.0.0``), in the folder ``python``:

    python benchmarks/record_observations.py

writes ``tests/data/observations.npz``: for the first body of each task in ``tests/data/tasks.npz``, under the same
actions, a weighted sum of the values of each observation of 200 env steps. Such a sum differs if any of them does.
"""

from __future__ import annotations

import random
import sys
import warnings
from pathlib import Path

import evogym
import numpy as np

from nbc.evogym.comparison import record, weights

STEPS = 200
LAST = "Catcher-v0"
DATA = Path(__file__).parent.parent / "tests/data"


def main() -> None:
    """Records all tasks, or adds the named ones to the file."""
    warnings.simplefilter("ignore")
    path, recorded = DATA / "observations.npz", np.load(DATA / "tasks.npz")
    found = dict(np.load(path)) if sys.argv[1:] else {}
    for number, name in enumerate(sorted(evogym.BASELINE_ENV_NAMES, key=lambda name: (name == LAST, name))):
        if sys.argv[1:] and name not in sys.argv[1:]:
            continue
        random.seed(10 * number)
        body, connections = evogym.sample_robot((5, 5))
        episode = record(name, body, np.random.default_rng(10 * number), STEPS, connections)
        assert (body == recorded[f"{name}/0/body"]).all() and (episode.first == recorded[f"{name}/0/first"]).all()
        found[name] = episode.observations @ weights(len(episode.first))
        np.savez_compressed(path, **found)
        print(name, flush=True)


if __name__ == "__main__":
    main()
