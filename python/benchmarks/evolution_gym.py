"""Speed and results of nbc and of Evolution Gym on the same bodies in one run.

Random full bodies of rigid, soft and horizontal actuator voxels walk on flat ground under the paper's sine. Evolution
Gym simulates one body after another, as its users do in a process; nbc simulates them in one call on one thread, and 64
times as many bodies in another. The two take turns, round after round. Measured is the CPU time of env steps (in nbc
with making worlds), so that other work on the machine matters little; shown are medians over the rounds with their
range. Needs Evolution Gym (Python up to 3.10).

    python evolution_gym.py [BODIES] [CYCLES] [GROUND] [SIDE] [ROUNDS]
"""

from __future__ import annotations

import os
import platform
import sys
import time
from importlib.metadata import version
from pathlib import Path
from typing import Callable, List, Tuple

import numpy as np
import numpy.typing as npt
from evogym import EvoSim, EvoWorld

import nbc

Bodies = npt.NDArray[np.uint8]
Walked = npt.NDArray[np.float64]


def in_evolution_gym(body: Bodies, steps: int, ground: int) -> Tuple[float, float]:
    """Seconds, and voxels walked."""
    structure, joined = nbc.evogym.to_structure(body)
    floor = np.full((1, ground), 5)
    world = EvoWorld()
    world.add_from_array("ground", floor, 0, 0, nbc.evogym.connections(floor))
    world.add_from_array("robot", structure, ground // 2 - len(body) // 2, 1, joined)
    sim = EvoSim(world)
    sim.reset()
    start = sim.object_pos_at_time(0, "robot")[0].mean()
    actions = nbc.evogym.actions(body, [("00", steps)])
    began = time.process_time()
    for widths in actions:
        sim.set_action("robot", widths)
        sim.step()
    seconds = time.process_time() - began
    return seconds, sim.object_pos_at_time(sim.get_time(), "robot")[0].mean() - start


def timed(work: Callable[[], Walked]) -> Tuple[float, Walked]:
    """Seconds of CPU time, and the result."""
    began = time.process_time()
    result = work()
    return time.process_time() - began, result


def machine() -> str:
    """The processor with its cores, and the versions."""
    lines = Path("/proc/cpuinfo").read_text().splitlines()
    names = [line.split(":")[1].strip() for line in lines if line.startswith("model name")]
    load = ", ".join(f"{load:.1f}" for load in os.getloadavg())
    return (f"{names[0] if names else platform.machine()}, {os.cpu_count()} cores, load average {load}, "
            f"Python {platform.python_version()}, Evolution Gym {version('evogym')}, nbc {nbc.__version__}")


def main() -> None:
    """Prints a table of env steps per second of CPU time."""
    numbers = [int(word) for word in sys.argv[1:]]
    count, cycles, ground, side, rounds = (numbers + [8, 2, 500, 5, 5][len(numbers) :])[:5]
    steps = cycles * nbc.CYCLE_STEPS
    many = np.random.default_rng(1).integers(1, 4, size=(64 * count, side, side), dtype=np.uint8)
    bodies = many[:count]

    def theirs() -> Tuple[float, Walked]:
        results = [in_evolution_gym(body, steps, ground) for body in bodies]
        return sum(seconds for seconds, _ in results), np.array([moved for _, moved in results])

    def ours(bodies: Bodies) -> Tuple[float, Walked]:
        return timed(lambda: nbc.simulate(bodies, f"00*{cycles}", world_width=ground, record=None).displacement[:, 0])

    nbc.set_threads(1)
    kinds: List[Tuple[str, int, Callable[[], Tuple[float, Walked]]]] = [
        ("Evolution Gym, one after another", count, theirs),
        (f"nbc, {count} at once", count, lambda: ours(bodies)),
        (f"nbc, {len(many)} at once", len(many), lambda: ours(many)),
    ]
    speeds, walked = np.empty((rounds, len(kinds))), [np.empty(0)] * len(kinds)
    for turn in range(rounds):
        for kind, (_, size, work) in enumerate(kinds):
            seconds, walked[kind] = work()
            speeds[turn, kind] = size * steps / seconds
    print(f"{time.strftime('%Y-%m-%d')}: {machine()}")
    print(f"{count} bodies of {side} x {side}, {cycles} cycles of {nbc.CYCLE_STEPS} env steps, ground {ground}, "
          f"medians of {rounds} rounds with their range")
    for (words, _, _), own in zip(kinds, speeds.T):
        ratio = own / speeds[:, 0]
        print(f"{words:34} {np.median(own):10,.0f} ({own.min():,.0f} to {own.max():,.0f}) env steps/CPU s, "
              f"{np.median(ratio):.1f} times ({ratio.min():.1f} to {ratio.max():.1f})")
    difference = np.abs(walked[1] - walked[0]).max()
    print(f"largest difference of the voxels walked: {difference:.1e} of {np.abs(walked[1]).max():.2f}")


if __name__ == "__main__":
    main()
