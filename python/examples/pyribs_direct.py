"""pyribs searches for gates: its grid archive and emitters, our evaluation, a direct encoding.

The numbers that pyribs evolves are scores: each voxel has one for each of nine codes, and the highest wins. Only bodies
that can walk are simulated; the others have no fitness. The archive has a niche for each behavior and number of voxels.

    python pyribs_direct.py
"""

from __future__ import annotations

import os

import numpy as np
import numpy.typing as npt
from ribs.archives import GridArchive
from ribs.emitters import EvolutionStrategyEmitter
from ribs.schedulers import Scheduler

import nbc

SIDE, CODES = 3, 9
GENERATIONS = 2 if os.environ.get("NBC_EXAMPLE") == "short" else 60


def develop(solutions: npt.NDArray[np.float64]) -> npt.NDArray[np.uint8]:
    """The bodies of scores, shape (N, SIDE, SIDE)."""
    scores = solutions.reshape(len(solutions), SIDE, SIDE, CODES)
    bodies: npt.NDArray[np.uint8] = scores.argmax(axis=-1).astype(np.uint8)
    return bodies


def evaluate(bodies: npt.NDArray[np.uint8], run: nbc.Evolution) -> tuple[npt.NDArray[np.float64], ...]:
    """Fitness and measures: the number of voxels, and the bits of the function."""
    fitness = np.full(len(bodies), -1.0)
    measures = np.zeros((len(bodies), 2))
    measures[:, 0] = (bodies > 0).sum(axis=(1, 2))
    can_walk = np.array([reason == "" for reason in nbc.invalid(bodies)])
    if can_walk.any():
        result = nbc.evaluate(bodies[can_walk], run)
        there = np.flatnonzero(can_walk)[result.measured]
        fitness[there] = result.fitness[result.measured, 1]
        walks_right = result.displacement[result.measured] > 0
        measures[there, 1] = walks_right @ [1, 2, 4, 8]
    return fitness, measures


def main() -> None:
    """Evolves, and prints how far each behavior of the archive walks."""
    run = nbc.Evolution(shape=(SIDE, SIDE), fixed="4 cycles")
    dimensions = SIDE * SIDE * CODES
    archive = GridArchive(
        solution_dim=dimensions, dims=[SIDE * SIDE, 16], ranges=[(0.5, SIDE * SIDE + 0.5), (-0.5, 15.5)], seed=1,
        learning_rate=None, threshold_min=-np.inf,
    )
    start = np.random.default_rng(1).normal(size=dimensions)
    emitters = [EvolutionStrategyEmitter(archive, x0=start, sigma0=0.5, batch_size=32, seed=seed) for seed in range(2)]
    scheduler = Scheduler(archive, emitters)
    for _ in range(GENERATIONS):
        solutions = scheduler.ask()
        fitness, measures = evaluate(develop(solutions), run)
        scheduler.tell(fitness, measures)
    found = archive.data()
    gates: dict[int, float] = {}
    for objective, (_, function) in zip(found["objective"], found["measures"]):
        if objective > 0:
            gates[int(function)] = max(objective, gates.get(int(function), 0.0))
    for function, distance in sorted(gates.items()):
        letters = "".join("LR"[function >> pattern & 1] for pattern in range(4))
        print(f"{letters}: walks {distance:.2f} voxels at least")


if __name__ == "__main__":
    main()
