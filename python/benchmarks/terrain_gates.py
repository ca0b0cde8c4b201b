"""Whether gates still compute on uneven and soft ground, and with a neighbor in the way.

    python benchmarks/terrain_gates.py 4

simulates each two-input robot of the library in each place under the same random patterns, 32 after a first one, each
held for the clock of the robot, and prints the share in which it walked the wrong way in the last cycle. The argument
is the number of times that this is done, each time with other patterns.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator

import numpy as np
import numpy.typing as npt

import nbc
from nbc.evogym import EvoWorld, Scenes, actions, to_structure

WIDTH, MIDDLE = 240, 120
PATTERNS = 32
RIGID, SOFT, FIXED = 1, 2, 5


def heights(name: str) -> npt.NDArray[np.int64]:
    """How high the fixed ground is in each column."""
    columns = np.arange(WIDTH)
    if name == "single voxels":
        return (columns % 12 == 0).astype(np.int64)
    if name == "low stairs":
        return np.minimum(columns // 8 % 6, 5 - columns // 8 % 6)
    if name == "steep stairs":
        return np.minimum(columns // 4 % 6, 5 - columns // 4 % 6)
    return np.zeros(WIDTH, dtype=np.int64)


def place(name: str, robot: nbc.Robot) -> EvoWorld:
    """A world with a robot in the middle."""
    high = heights(name)
    world = EvoWorld()
    rows = int(high.max()) + 1
    ground = np.where(np.arange(rows)[::-1, None] <= high, FIXED, 0)
    world.add_from_array("ground", ground, 0, 0)
    structure, _ = to_structure(robot.body, as_actuators=True)
    width = structure.shape[1]
    base = int(high[MIDDLE : MIDDLE + width].max()) + 1
    if name == "soft ground":
        world.add_from_array("soft", np.full((2, WIDTH), SOFT), 0, 1)
        base += 2
    for voxel, beside in ((RIGID, "blocks beside it"), (FIXED, "walls beside it")):
        if name == beside:
            world.add_from_array("left", np.full((3, 3), voxel), MIDDLE - 5, 1)
            world.add_from_array("right", np.full((3, 3), voxel), MIDDLE + width + 2, 1)
    if name == "its twin beside it":
        world.add_from_array("twin", structure, MIDDLE + width + 2, 1)
    world.add_from_array("robot", structure, MIDDLE, base)
    return world


PLACES = ("flat", "single voxels", "low stairs", "steep stairs", "soft ground", "blocks beside it",
          "its twin beside it", "walls beside it")


def walked(name: str, robots: list[nbc.Robot], patterns: npt.NDArray[np.int64]) -> Iterator[tuple[nbc.Robot, float]]:
    """The share of patterns for which each robot walked the wrong way; NaN if it became unstable."""
    for clock in sorted({int(robot.character["clock"]) for robot in robots}):
        own = [robot for robot in robots if robot.character["clock"] == clock]
        # The twin has the patterns in another order, so that they bump into each other.
        orders = (patterns, patterns[::-1])
        schedules = [" ".join(f"{a}{b}*{clock}" for a, b in order) for order in orders]
        drives = []
        scenes = Scenes([place(name, robot) for robot in own])
        for number, robot in enumerate(own):
            kinds = [schedules[each == "twin"] for each in scenes.names[number] if each in ("robot", "twin")]
            drives.append(np.concatenate([actions(robot.body, schedule) for schedule in kinds], axis=1))
        steps = nbc.CYCLE_STEPS * clock
        right = []
        for number in range(len(patterns)):
            for step in range(number * steps, (number + 1) * steps):
                if step == (number + 1) * steps - nbc.CYCLE_STEPS:
                    before = centers(scenes)
                scenes.step(np.concatenate([drive[step] for drive in drives]))
            right.append(centers(scenes) > before)
        for robot, found, fault in zip(own, np.transpose(right), scenes.faults):
            expected = np.array([robot.behavior[2 * a + b] == "R" for a, b in patterns])
            yield robot, float("nan") if fault else float((found != expected)[1:].mean())


def centers(scenes: Scenes) -> npt.NDArray[np.float64]:
    """Where each robot is, in voxels."""
    return np.array([scenes.points([number], "robot")[0][:, 0].mean() for number in range(len(scenes))])


def main() -> None:
    """Prints the table."""
    rounds = int(sys.argv[1]) if len(sys.argv) > 1 else 4
    robots = [robot for robot in nbc.library() if len(robot.behavior) == 4 and "R" in robot.behavior and "L" in
              robot.behavior]
    table: dict[tuple[str, str], float] = {}
    for seed in range(rounds):
        patterns = np.random.default_rng(seed).integers(0, 2, (PATTERNS + 1, 2))
        for name in PLACES:
            for robot, wrong in walked(name, robots, patterns):
                table[name, robot.name] = table.get((name, robot.name), 0.0) + wrong / rounds
    print("| robot | clock | " + " | ".join(PLACES) + " |")
    print("|---|---|" + "---|" * len(PLACES))
    for robot in robots:
        cells = [f"{100 * table[name, robot.name]:.0f} %" for name in PLACES]
        print(f"| `{robot.name}` | {robot.character['clock']} | {' | '.join(cells).replace('nan %', 'unstable')} |")


if __name__ == "__main__":
    main()
