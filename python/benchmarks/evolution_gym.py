"""Speed and results of nbc and of Evolution Gym on the same bodies in one run.

Random full bodies of rigid, soft and horizontal actuator voxels walk on flat ground under the paper's sine. Evolution
Gym simulates one body after another, as its users do in a process; nbc simulates them in one call on one thread, and 64
times as many bodies in another. Measured is the CPU time of env steps (in nbc with making worlds), so that other work
on the machine matters little. Needs Evolution Gym (Python up to 3.10).

    python evolution_gym.py [BODIES] [CYCLES] [GROUND]
"""

from __future__ import annotations

import os
import platform
import sys
import time
from importlib.metadata import version
from pathlib import Path
from typing import Callable, Tuple

import numpy as np
import numpy.typing as npt
from evogym import EvoSim, EvoWorld

import nbc

SIDE = 5


def signal(steps: int) -> npt.NDArray[np.float64]:
    """The paper's sine: the target width in each env step."""
    phase = 2 * np.pi * (np.arange(steps) % nbc.CYCLE_STEPS) / (nbc.CYCLE_STEPS - 1)
    return 0.6 + (np.sin(phase) + 1) / 2


def in_evolution_gym(body: npt.NDArray[np.uint8], steps: int, ground: int) -> Tuple[float, float]:
    """Seconds, and voxels walked."""
    structure, joined = nbc.evogym.to_structure(body)
    floor = np.full((1, ground), 5)
    world = EvoWorld()
    world.add_from_array("ground", floor, 0, 0, nbc.evogym.connections(floor))
    world.add_from_array("robot", structure, ground // 2 - SIDE // 2, 1, joined)
    sim = EvoSim(world)
    sim.reset()
    actuators = sim.get_actuator_indices("robot").size
    start = sim.object_pos_at_time(0, "robot")[0].mean()
    began = time.process_time()
    for target in signal(steps):
        sim.set_action("robot", np.full(actuators, target))
        sim.step()
    seconds = time.process_time() - began
    return seconds, sim.object_pos_at_time(sim.get_time(), "robot")[0].mean() - start


def timed(work: Callable[[], npt.NDArray[np.float64]]) -> Tuple[float, npt.NDArray[np.float64]]:
    """Seconds of the fastest of three runs, and the result."""
    best, result = float("inf"), np.empty(0)
    for _ in range(3):
        began = time.process_time()
        result = work()
        best = min(best, time.process_time() - began)
    return best, result


def machine() -> str:
    """The processor with its cores, and the versions."""
    lines = Path("/proc/cpuinfo").read_text().splitlines()
    names = [line.split(":")[1].strip() for line in lines if line.startswith("model name")]
    return (f"{names[0] if names else platform.machine()}, {os.cpu_count()} cores, Python {platform.python_version()}, "
            f"Evolution Gym {version('evogym')}, nbc {nbc.__version__}")


def main() -> None:
    """Prints a table of env steps per second of CPU time."""
    numbers = [int(word) for word in sys.argv[1:]]
    count, cycles, ground = (numbers + [8, 2, 500][len(numbers) :])[:3]
    steps = cycles * nbc.CYCLE_STEPS
    many = np.random.default_rng(1).integers(1, 4, size=(64 * count, SIDE, SIDE), dtype=np.uint8)
    bodies = many[:count]
    theirs = [in_evolution_gym(body, steps, ground) for body in bodies]
    seconds = sum(each for each, _ in theirs)

    def ours(bodies: npt.NDArray[np.uint8]) -> npt.NDArray[np.float64]:
        return nbc.simulate(bodies, f"00*{cycles}", world_width=ground, record=None).displacement[:, 0]

    rows = [("Evolution Gym, one after another", count * steps / seconds)]
    nbc.set_threads(1)
    for words, batch in ((f"nbc, {count} at once", bodies), (f"nbc, {len(many)} at once", many)):
        best, walked = timed(lambda: ours(batch))
        rows.append((words, len(batch) * steps / best))
    difference = np.abs(walked[:count] - np.array([moved for _, moved in theirs])).max()
    print(f"{time.strftime('%Y-%m-%d')}: {machine()}")
    print(f"{count} bodies of {SIDE} x {SIDE}, {cycles} cycles of {nbc.CYCLE_STEPS} env steps, ground {ground}")
    for words, speed in rows:
        print(f"{words:36} {speed:12,.0f} env steps/CPU s {speed / rows[0][1]:8.1f} x")
    print(f"largest difference of the voxels walked: {difference:.1e} of {np.abs(walked[:count]).max():.2f}")


if __name__ == "__main__":
    main()
