"""Env steps per second of Evolution Gym's tasks under random actions, there and here, in turn.

In a Python 3.10 with Evolution Gym 2.0.0 and nbc:

    python benchmarks/tasks.py 64 5

The arguments are the number of bodies (all different, 5 x 5) and the rounds. Both programs simulate in one thread; only
``set_action`` and ``step`` are timed, by the CPU time of the process. The command prints medians over the rounds with
their range.
"""

from __future__ import annotations

import contextlib
import io
import random
import statistics
import sys
import time
import warnings
from typing import List

import evogym
import evogym.envs
import gymnasium
import numpy as np

import nbc
from nbc.evogym import TASKS, Scenes

STEPS = 40
NAMES = ("Walker-v0", "UpStepper-v0", "ObstacleTraverser-v1", "Carrier-v0", "Pusher-v1", "CaveCrawler-v0")


def main() -> None:
    """Times the tasks."""
    warnings.simplefilter("ignore")
    count, rounds = (int(argument) for argument in (sys.argv[1:] or ("64", "5")))
    nbc.set_threads(1)
    random.seed(1)
    bodies = [evogym.sample_robot((5, 5))[0] for _ in range(count)]
    for name in NAMES:
        with contextlib.redirect_stdout(io.StringIO()):
            theirs = [gymnasium.make(name, body=body).unwrapped.sim for body in bodies[:8]]
        worlds = [TASKS[name].make_world(body) for body in bodies]
        many, one = Scenes(worlds), Scenes(worlds[:1])
        rates: List[List[float]] = [[], [], []]
        for turn in range(rounds):
            actions = np.random.default_rng(turn)
            sim = theirs[turn % len(theirs)]
            sim.reset()
            rates[0].append(_rate(1, lambda: _step(sim, actions)))
            for rate, scenes in ((rates[1], many), (rates[2], one)):
                for scene in range(len(scenes)):
                    scenes.reset(scene)
                size = sum(scenes.actuators(scene, "robot")[1] for scene in range(len(scenes)))
                rate.append(_rate(len(scenes), lambda: scenes.step(actions.uniform(0.6, 1.6, size))))
        there, here, alone = (statistics.median(rate) for rate in rates)
        spans = " ".join(f"{min(rate):.0f}-{max(rate):.0f}" for rate in rates)
        head = f"{name:22} {there:8.0f} {here:8.0f} ({here / there:4.0f} times)"
        print(f"{head} alone {alone:6.0f} ({alone / there:4.1f}) {spans}")


def _step(sim: "evogym.EvoSim", actions: np.random.Generator) -> None:
    sim.set_action("robot", actions.uniform(0.6, 1.6, sim.get_dim_action_space("robot")))
    sim.step()


def _rate(worlds: int, step: object) -> float:
    start = time.process_time()
    for _ in range(STEPS):
        step()  # type: ignore[operator]
    return STEPS * worlds / (time.process_time() - start)


if __name__ == "__main__":
    main()
