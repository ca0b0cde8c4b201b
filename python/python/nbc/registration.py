"""Tells gymnasium the tasks of `nbc.evogym.envs`. ``import nbc`` does so when gymnasium is imported, before or after
it, and imports nothing else for it."""

from __future__ import annotations

from importlib.machinery import ModuleSpec
from importlib.util import find_spec
from types import ModuleType
from typing import Dict, Optional

__all__ = ["EPISODES", "find_gymnasium", "register_tasks"]

EPISODES: Dict[str, int] = {
    "Walker-v0": 500,
    "BidirectionalWalker-v0": 1000,
    "BridgeWalker-v0": 500,
    "CaveCrawler-v0": 1000,
    "Jumper-v0": 500,
    "Flipper-v0": 600,
    "Balancer-v0": 600,
    "Balancer-v1": 600,
    "UpStepper-v0": 600,
    "DownStepper-v0": 500,
    "ObstacleTraverser-v0": 1000,
    "ObstacleTraverser-v1": 1000,
    "Hurdler-v0": 1000,
    "GapJumper-v0": 1000,
    "PlatformJumper-v0": 1000,
    "Traverser-v0": 600,
    "Lifter-v0": 300,
    "Catcher-v0": 400,
    "Carrier-v0": 500,
    "Carrier-v1": 1000,
    "Pusher-v0": 500,
    "Pusher-v1": 600,
    "BeamToppler-v0": 1000,
    "BeamSlider-v0": 1000,
    "Thrower-v0": 300,
    "AreaMaximizer-v0": 600,
    "AreaMinimizer-v0": 600,
    "WingspanMazimizer-v0": 600,
    "HeightMaximizer-v0": 500,
    "Climber-v0": 400,
    "Climber-v1": 600,
    "Climber-v2": 1000,
}
"""The env steps of an episode of each task."""


def register_tasks(namespace: str = "nbc/") -> None:
    """Makes the tasks known to gymnasium as ``nbc/Walker-v0`` and so on, where such names are not taken."""
    from gymnasium.envs.registration import register, registry

    for name, steps in EPISODES.items():
        if namespace + name not in registry:
            register(
                namespace + name,
                entry_point="nbc.evogym.envs:TaskEnv",
                vector_entry_point="nbc.evogym.envs:make_many",
                max_episode_steps=steps,
                kwargs={"task": name},
            )


def find_gymnasium() -> Optional[ModuleSpec]:
    """The spec of gymnasium, which registers the tasks when it is loaded; None where it is not installed."""
    spec = find_spec("gymnasium")
    if spec is None or spec.loader is None:
        return None
    load = spec.loader.exec_module

    def load_and_register(module: ModuleType) -> None:
        load(module)
        register_tasks()

    spec.loader.exec_module = load_and_register  # type: ignore[method-assign]
    return spec
