"""Comparison with Evolution Gym, where that is installed: the same episode there and here."""

from __future__ import annotations

import contextlib
import io
import random
import time
import warnings
from dataclasses import dataclass
from typing import Any, List, Optional, Sequence

import numpy as np
import numpy.typing as npt

from .exchange import structure_of
from .tasks import TaskWorlds, task_of
from .utils import sample_robot

__all__ = ["Comparison", "Episode", "compare", "record"]

_Floats = npt.NDArray[np.float64]


@dataclass
class Episode:
    """What Evolution Gym rewarded."""

    body: npt.NDArray[np.int64]
    """The structure of the robot."""
    rewards: _Floats
    """The reward of each env step."""
    first: _Floats
    """The observation at the start."""
    observations: _Floats
    """The observation after each env step, shape (env steps, values)."""
    goals: List[int]
    """The goals of BidirectionalWalker-v0, and where the package of Catcher-v0 begins; no other task has any."""
    seconds: float
    """The CPU time of its env steps."""


@dataclass
class Comparison:
    """An episode there and here, with the same actions."""

    task: str
    """The name of the task."""
    there: Episode
    """The episode of Evolution Gym."""
    rewards: _Floats
    """The rewards here."""
    observations: _Floats
    """The observations here."""
    seconds: float
    """The CPU time of the env steps here."""

    def agreed(self, tolerance: float = 1e-9) -> int:
        """The env steps before the first whose rewards differ by more."""
        return _agreed(np.abs(self.rewards - self.there.rewards), tolerance)

    def observed(self, tolerance: float = 1e-9) -> int:
        """The env steps before the first whose observations differ by more in any value."""
        return _agreed(np.abs(self.observations - self.there.observations).max(axis=1, initial=0), tolerance)

    def __str__(self) -> str:
        steps, speed = len(self.rewards), self.there.seconds / self.seconds
        shared = f"{self.agreed()} of {steps} rewards are equal to 1e-9, and {self.observed()} observations"
        return f"{self.task}: {shared}; {speed:.1f} times as fast"


def record(
    task: str,
    structure: npt.ArrayLike,
    actions: np.random.Generator,
    steps: int,
    connections: Optional[npt.ArrayLike] = None,
) -> Episode:
    """An episode of Evolution Gym under random targets.

    Raises:
        ImportError: where Evolution Gym is not installed.
    """
    body = structure_of(structure)
    with warnings.catch_warnings():
        # It takes its names back, which are those of `nbc.evogym.envs`, where that was imported before.
        warnings.simplefilter("ignore")
        import evogym.envs
    import gymnasium

    with contextlib.redirect_stdout(io.StringIO()):
        env: Any = gymnasium.make(task, body=body, connections=connections).unwrapped
        first, _ = env.reset()
    goals = [goal.x_goal for goal in getattr(env, "goals", [])]
    if hasattr(env, "offsetx"):
        goals = [env.offsetx, env.offsety]
    rewards: List[float] = []
    seen: List[_Floats] = []
    done, count, start = False, env.action_space.shape[0], time.process_time()
    while len(rewards) < steps and not done:
        observation, reward, done, _, _ = env.step(actions.uniform(0.6, 1.6, count))
        rewards.append(float(reward))
        seen.append(observation)
    spent = time.process_time() - start
    observations = np.array(seen).reshape(-1, len(first))
    return Episode(body, np.array(rewards), first, observations, goals, spent)


def compare(
    task: str = "Walker-v0",
    bodies: Optional[Sequence[npt.ArrayLike]] = None,
    *,
    connections: Optional[Sequence[Optional[npt.ArrayLike]]] = None,
    steps: int = 100,
    seed: int = 1,
) -> List[Comparison]:
    """Runs a task in Evolution Gym and here with the same random targets.

    Args:
        task: its name.
        bodies: structures; by default three random ones of 5 x 5.
        connections: the connections of each body, or None for a body whose neighbors are all joined.
        steps: env steps of each episode, at most.
        seed: of the bodies, targets and goals.

    Returns:
        A comparison for each body. In some walks rounding grows, and then their rewards differ; docs/evolution-gym.md
        tells from when on.

    Raises:
        ImportError: where Evolution Gym is not installed.
        ValueError: for a task that is not here.
    """
    task_of(task)
    found = []
    for number in range(3 if bodies is None else len(bodies)):
        random.seed(seed + number)
        body = sample_robot((5, 5))[0] if bodies is None else bodies[number]
        joined = None if connections is None else connections[number]
        there = record(task, body, np.random.default_rng(seed + number), steps, joined)
        found.append(_follow(task, there, np.random.default_rng(seed + number), joined))
    return found


def _follow(
    name: str, there: Episode, actions: np.random.Generator, connections: Optional[npt.ArrayLike] = None
) -> Comparison:
    task = task_of(name)
    worlds = TaskWorlds(task, [task.make_world(there.body, connections)])
    worlds.reset([0], [None], [there.goals or None])
    count, start = int(worlds.actuators[0]), time.process_time()
    rewards: List[float] = []
    seen: List[_Floats] = []
    for _ in there.rewards:
        rewards.append(float(worlds.step(actions.uniform(0.6, 1.6, count))[0][0]))
        seen.append(worlds.observe()[0])
    spent = time.process_time() - start
    return Comparison(name, there, np.array(rewards), np.array(seen).reshape(-1, len(there.first)), spent)


def weights(count: int) -> _Floats:
    """The weights of a sum that differs if any of so many values does."""
    return np.random.default_rng(count).uniform(0.5, 1.5, count)


def _agreed(differences: _Floats, tolerance: float) -> int:
    """How many are not larger than a tolerance before the first that is."""
    differs = np.flatnonzero(~(differences <= tolerance))
    return int(differs[0]) if len(differs) else len(differences)
