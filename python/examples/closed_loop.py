"""Closed-loop control: robots that are steered to stay near their start.

Each robot of the library that walks right under one pattern and left under another gets, cycle by cycle, the pattern
that leads it back.

    python closed_loop.py
"""

from __future__ import annotations

import numpy as np

import nbc


def main() -> None:
    """Steers for thirty cycles, and prints how far each robot is from its start."""
    robots = [robot for robot in nbc.library() if "L" in robot.behavior and "R" in robot.behavior]
    patterns = ("00", "01", "10", "11")
    right = [patterns[robot.behavior.index("R")] for robot in robots]
    left = [patterns[robot.behavior.index("L")] for robot in robots]
    with nbc.Flock([robot.body for robot in robots]) as flock:
        start = flock.com[:, 0]
        for _ in range(30):
            ahead = flock.com[:, 0] > start
            flock.advance([l if is_ahead else r for is_ahead, l, r in zip(ahead, left, right)])
        for robot, distance in zip(robots, np.abs(flock.com[:, 0] - start)):
            print(f"{robot.name}: {distance:.2f} voxels from its start")


if __name__ == "__main__":
    main()
