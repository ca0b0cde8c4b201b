"""Bodies evolve by CPPN and MAP-Elites, each with a controller that it learns by PPO in its life.

    pip install stable-baselines3
    python cppn_walkers.py

prints the best body of each generation and its rewards in an episode. The bodies are for Evolution Gym's Walker-v0:
the genome's sensors are taken as actuators. `ppo_walker.py` has the learning.
"""

from __future__ import annotations

import os

import numpy as np
import numpy.typing as npt
from ppo_walker import learn

import nbc

SHORT = os.environ.get("NBC_EXAMPLE") == "short"
GENERATIONS, UPDATES = (1, 1) if SHORT else (8, 10)
RUN = nbc.Evolution(
    shape=(5, 5), batch=3 if SHORT else 7, newcomers=1, genome="cppn",
    descriptors=["voxels in 4 bins", "active in 4 bins"],
)
# Evolution Gym's voxel for each code: 3 drives the width, 4 the height.
STRUCTURE = np.array([0, 1, 2, 3, 4, 3, 4, 3, 4])


def evaluate(bodies: npt.NDArray[np.uint8]) -> nbc.Evaluation:
    """What each body is rewarded with what it learns; those that cannot walk are invalid."""
    reasons = nbc.invalid(bodies)
    learned = [np.nan if reason else learn(STRUCTURE[body], UPDATES)[1] for body, reason in zip(bodies, reasons)]
    walked = np.array(learned)
    outcome = np.where(np.isnan(walked), "invalid", "measured")
    distance = np.repeat(walked[:, None], 4, axis=1)
    behavior = np.where(walked > 0, "RRRR", "LLLL")
    return nbc.Evaluation(outcome=outcome, fitness=distance[:, :2], displacement=distance, behavior=behavior)


def main() -> None:
    """Evolves, and prints the best of each generation."""
    search = nbc.Search(RUN, seed=1)
    for generation in range(1, GENERATIONS + 1):
        candidates = search.ask()
        search.tell(candidates, evaluate(candidates.bodies))
        elites = search.archive.elites
        best = elites[elites["fitness"][:, 0].argmax()]
        print(f"generation {generation}: {best['fitness'][0]:.2f}, {len(elites)} niches", flush=True)
        print("\n".join(" ".join(str(code) for code in row) for row in STRUCTURE[best["body"]]), flush=True)


if __name__ == "__main__":
    main()
