"""The difference between the paths of nbc and of Evolution Gym for the robots of the library: that of rounding.

Needs Evolution Gym (Python up to 3.10).

    python rounding.py [SCHEDULE] [ROBOT]...
"""

from __future__ import annotations

import sys

import numpy as np
import numpy.typing as npt
from evogym import EvoSim, EvoWorld

import nbc

GROUND = 500
SMALL = 1e-9


def in_evolution_gym(body: npt.NDArray[np.uint8], schedule: str) -> npt.NDArray[np.float64]:
    """The path of the center of mass in voxels, shape (env steps + 1, 2)."""
    structure, joined = nbc.evogym.to_structure(body, as_actuators=True)
    floor = np.full((1, GROUND), 5)
    world = EvoWorld()
    world.add_from_array("ground", floor, 0, 0, nbc.evogym.connections(floor))
    world.add_from_array("robot", structure, GROUND // 2 - structure.shape[1] // 2, 1, joined)
    sim = EvoSim(world)
    sim.reset()
    path = [sim.object_pos_at_time(sim.get_time(), "robot").mean(axis=1)]
    for widths in nbc.evogym.actions(body, schedule):
        sim.set_action("robot", widths)
        sim.step()
        path.append(sim.object_pos_at_time(sim.get_time(), "robot").mean(axis=1))
    return np.array(path)


def main() -> None:
    """Prints the largest difference for each robot, and when it passes 1e-9 voxels."""
    schedule, *names = sys.argv[1:] or ["00*10"]
    for robot in nbc.library():
        if names and robot.name not in names:
            continue
        ours = nbc.simulate([robot], schedule, world_width=GROUND).com
        assert ours is not None
        difference = np.abs(in_evolution_gym(robot.body, schedule) - ours[0]).max(axis=1)
        first = np.flatnonzero(difference > SMALL)
        when = f"passes {SMALL:.0e} at env step {first[0]}" if len(first) else ""
        print(f"{robot.name:16} {difference.max():.1e} {when}", flush=True)


if __name__ == "__main__":
    main()
