"""MAP-Elites in plain numpy, in batches as QDax has them: fitnesses, descriptors and extra scores of a batch.

A function of that shape is what QDax's `MAPElites` takes as `scoring_function`; with JAX, wrap it in
`jax.pure_callback`. Here the loop around it is twenty lines of numpy, so that the example needs nothing else.

    python batched_map_elites.py
"""

from __future__ import annotations

import os
from typing import Dict, Tuple

import numpy as np
import numpy.typing as npt

import nbc

SIDE, BATCH = 4, 64
GENERATIONS = 2 if os.environ.get("NBC_EXAMPLE") == "short" else 100
RUN = nbc.Evolution(shape=(SIDE, SIDE), fixed="4 cycles", descriptors=["active in 8 bins", "behavior"])

Bodies = npt.NDArray[np.uint8]
Scores = Tuple[npt.NDArray[np.float64], npt.NDArray[np.int32], Dict[str, npt.NDArray[np.float64]]]


def scoring_function(batch: Bodies) -> Scores:
    """Fitnesses (N,), descriptors (N, 2) and extra scores of a batch of bodies; -inf for those without a score."""
    fitnesses = np.full(len(batch), -np.inf)
    descriptors = np.zeros((len(batch), 2), dtype=np.int32)
    displacement = np.full((len(batch), 4), np.nan)
    valid = np.flatnonzero([reason == "" for reason in nbc.invalid(batch)])
    if len(valid):
        result = nbc.evaluate(batch[valid], RUN)
        there = valid[result.measured]
        fitnesses[there] = result.fitness[result.measured, 0]
        displacement[there] = result.displacement[result.measured]
        if result.niche is not None:
            descriptors[there] = result.niche[result.measured]
    return fitnesses, descriptors, {"displacement": displacement}


def main() -> None:
    """Fills a repertoire, and prints its coverage and QD-score."""
    random = np.random.default_rng(1)
    genotypes = np.zeros((8, 16, SIDE, SIDE), dtype=np.uint8)
    fitnesses = np.full((8, 16), -np.inf)
    batch = random.integers(0, 9, size=(BATCH, SIDE, SIDE), dtype=np.uint8)
    for _ in range(GENERATIONS):
        scores, niches, _ = scoring_function(batch)
        for body, score, (active, function) in zip(batch, scores, niches):
            if score > fitnesses[active, function]:
                fitnesses[active, function], genotypes[active, function] = score, body
        filled = genotypes[np.isfinite(fitnesses)]
        parents = filled[random.integers(len(filled), size=BATCH)] if len(filled) else batch
        changes = random.random(parents.shape) < 2 / SIDE**2
        batch = np.where(changes, random.integers(0, 9, size=parents.shape), parents).astype(np.uint8)
    found = np.isfinite(fitnesses)
    print(f"{found.sum()} of {found.size} niches, QD-score {fitnesses[found].sum():.1f}")


if __name__ == "__main__":
    main()
