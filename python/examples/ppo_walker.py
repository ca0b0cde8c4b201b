"""A robot learns to walk by PPO: stable-baselines3 with many copies of it at once.

    pip install stable-baselines3
    python ppo_walker.py

prints what the robot is rewarded in an episode of Walker-v0 with random targets and with those that it learned, and
writes ``ppo_walker.zip``. A reward of 1 is a walk of ten voxels; reaching the goal at the end of the ground adds 1.
"""

from __future__ import annotations

import os
from typing import Any

import numpy as np
import numpy.typing as npt
import torch
from gymnasium import spaces
from gymnasium.vector import AutoresetMode
from stable_baselines3 import PPO
from stable_baselines3.common.vec_env import VecEnv, VecNormalize

from nbc.evogym.envs import TaskVectorEnv

TASK = "Walker-v0"
BODY = [[3, 3, 3, 3, 3], [3, 3, 3, 3, 3], [3, 3, 0, 3, 3], [3, 3, 0, 3, 3], [3, 3, 0, 3, 3]]
WORLDS, STEPS = 32, 128
UPDATES = 2 if os.environ.get("NBC_EXAMPLE") == "short" else 60


class Copies(VecEnv):
    """Copies of one robot, each in a world of its own. Actions are from -1 to 1, as PPO likes them."""

    def __init__(self, task: str, body: Any, count: int) -> None:
        self._tasks = TaskVectorEnv(task, [body] * count, AutoresetMode.SAME_STEP)
        observed = self._tasks.single_observation_space
        actions = spaces.Box(-1.0, 1.0, self._tasks.single_action_space.shape, np.float32)
        super().__init__(count, observed, actions)

    def reset(self) -> npt.NDArray[Any]:
        """Puts all copies back to their start."""
        return self._tasks.reset()[0]

    def step_async(self, actions: npt.NDArray[Any]) -> None:
        """Notes what to do."""
        self._targets = 1.1 + 0.5 * np.clip(actions, -1, 1)

    def step_wait(self) -> tuple[Any, Any, Any, Any]:
        """Does it. A copy whose episode ends starts again at once."""
        observed, rewards, terminated, truncated, info = self._tasks.step(self._targets)
        infos: list[dict[str, Any]] = [{} for _ in range(self.num_envs)]
        for n in np.flatnonzero(terminated | truncated):
            infos[n] = {"terminal_observation": info["final_obs"][n], "TimeLimit.truncated": bool(truncated[n])}
        return observed, rewards, terminated | truncated, infos

    def close(self) -> None:
        """Frees the simulations."""
        self._tasks.close()

    def get_attr(self, name: str, indices: Any = None) -> list[Any]:
        """The same attribute for each copy."""
        return [getattr(self._tasks, name, None)] * self.num_envs

    def set_attr(self, name: str, value: Any, indices: Any = None) -> None:
        """Copies have no attributes of their own."""
        raise NotImplementedError

    def env_method(self, method_name: str, *method_args: Any, indices: Any = None, **method_kwargs: Any) -> list[Any]:
        """Copies have no methods of their own."""
        raise NotImplementedError

    def env_is_wrapped(self, wrapper: Any, indices: Any = None) -> list[bool]:
        """Nothing is wrapped."""
        return [False] * self.num_envs


def walk(robots: Any, model: PPO | None) -> float:
    """The mean sum of rewards of an episode."""
    observed, total, over = robots.reset(), np.zeros(robots.num_envs), np.zeros(robots.num_envs, dtype=bool)
    random = np.random.default_rng(1)
    while not over.all():
        if model is None:
            actions = random.uniform(-1, 1, (robots.num_envs, *robots.action_space.shape))
        else:
            actions = model.predict(observed, deterministic=True)[0]
        observed, rewards, done, _ = robots.step(actions)
        total += np.where(over, 0.0, rewards)
        over |= done
    return float(total.mean())


def learn(body: Any, updates: int, every: int = 0) -> tuple[PPO, float]:
    """What a body learns in so many updates of PPO, and what it is rewarded then. Prints the rewards after every so
    many updates, if asked."""
    robots = VecNormalize(Copies(TASK, body, WORLDS))
    model = PPO("MlpPolicy", robots, n_steps=STEPS, batch_size=WORLDS * STEPS // 4, n_epochs=4, seed=1, device="cpu")
    for update in range(1, updates + 1):
        model.learn(WORLDS * STEPS, reset_num_timesteps=update == 1)
        if every and update % every == 0:
            print(f"after {update * WORLDS * STEPS} env steps: {rate(robots, model):.2f}", flush=True)
    rewards = rate(robots, model)
    robots.close()
    return model, rewards


def rate(robots: VecNormalize, model: PPO) -> float:
    """What the robots are rewarded as they are."""
    robots.training, robots.norm_reward = False, False
    walked = walk(robots, model)
    robots.training, robots.norm_reward = True, True
    return walked


def main() -> None:
    """Learns, and says what was gained."""
    torch.set_num_threads(2)
    before = walk(Copies(TASK, BODY, WORLDS), None)
    model, after = learn(BODY, UPDATES, every=20)
    model.save("ppo_walker")
    print(f"{before:.2f} with random targets, {after:.2f} with those that it learned")


if __name__ == "__main__":
    main()
