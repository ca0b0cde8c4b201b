"""Speed of Evolution Gym's tasks under random actions, there and here, in turn: whole env steps of the environments,
with observations and rewards.

In a Python 3.10 with Evolution Gym 2.0.0 and nbc:

    python benchmarks/tasks.py 64 5

The arguments are the number of bodies (all different, 5 x 5) and the rounds; names of tasks may follow. In each round
the original steps one of the first eight bodies, then `TaskVectorEnv` steps all bodies here, then an environment of
`gymnasium.make` steps one. Only ``step`` is timed, by the CPU time of the process, and both programs simulate in one
thread. The command prints medians over the rounds with their range, as a table in Markdown.
"""

from __future__ import annotations

import contextlib
import io
import random
import statistics
import sys
import time
import warnings
from typing import Any, List

import evogym
import evogym.envs
import gymnasium
import numpy as np

import nbc
from nbc.evogym import TASKS
from nbc.evogym.envs import TaskVectorEnv

STEPS = 40


def main() -> None:
    """Times the tasks."""
    warnings.simplefilter("ignore")
    arguments = sys.argv[1:] or ["64", "5"]
    count, rounds = int(arguments[0]), int(arguments[1])
    nbc.set_threads(1)
    random.seed(1)
    bodies = [evogym.sample_robot((5, 5))[0] for _ in range(count)]
    print(f"| task | Evolution Gym | {count} at once | one alone |\n|---|---|---|---|")
    for name in arguments[2:] or TASKS:
        with contextlib.redirect_stdout(io.StringIO()):
            theirs = [gymnasium.make(name, body=body) for body in bodies[: min(8, rounds)]]
        many = TaskVectorEnv(name, bodies)
        alone = [gymnasium.make(f"nbc/{name}", body=body) for body in bodies[: min(8, rounds)]]
        rates: List[List[float]] = [[], [], []]
        for turn in range(rounds):
            for rate, env in zip(rates, (theirs[turn % len(theirs)], many, alone[turn % len(alone)])):
                rate.append(_rate(env, np.random.default_rng(turn)))
        there = statistics.median(rates[0])
        cells = [f"{there:,.0f} ({_span(rates[0])})"]
        for rate in rates[1:]:
            here = statistics.median(rate)
            cells.append(f"{here:,.0f} ({here / there:.{0 if here > 10 * there else 1}f} times; {_span(rate)})")
        print(f"| {name} | {' | '.join(cells)} |", flush=True)
        for env in (*theirs, many, *alone):
            env.close()


def _span(rates: List[float]) -> str:
    return f"{min(rates):,.0f} to {max(rates):,.0f}"


def _rate(env: Any, actions: np.random.Generator) -> float:
    """Env steps per second; an episode that ends is followed by another."""
    drawn = actions.uniform(0.6, 1.6, (STEPS, *env.action_space.shape))
    worlds, spent = getattr(env, "num_envs", 1), 0.0
    with contextlib.redirect_stdout(io.StringIO()):
        env.reset()
        env.step(drawn[0])
        for action in drawn:
            start = time.process_time()
            _, _, terminated, truncated, _ = env.step(action)
            spent += time.process_time() - start
            if worlds == 1 and (terminated or truncated):
                env.reset()
    return STEPS * worlds / spent


if __name__ == "__main__":
    main()
