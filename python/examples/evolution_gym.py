"""Replays a body in Evolution Gym, where that is installed (Python up to 3.10), with the same actuation as in nbc.

The paper's world: flat ground of 500 voxels, code 3 driven by a sine of 84 env steps between 0.6 and 1.6. The paths of
the center of mass are printed side by side.

    python evolution_gym.py
"""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt
from evogym import EvoSim, EvoWorld

import nbc

BODY = ["33333", "33233", "30003"]
CYCLES, GROUND = 3, 500


def in_evolution_gym(body: npt.NDArray[np.uint8], steps: int) -> npt.NDArray[np.float64]:
    """The path of the center of mass in voxels, shape (steps + 1,)."""
    structure, joined = nbc.evogym.to_structure(body)
    ground = np.full((1, GROUND), 5)
    world = EvoWorld()
    world.add_from_array("ground", ground, 0, 0, nbc.evogym.connections(ground))
    world.add_from_array("robot", structure, GROUND // 2 - structure.shape[1] // 2, 1, joined)
    sim = EvoSim(world)
    sim.reset()
    actuators = sim.get_actuator_indices("robot").size
    path = [sim.object_pos_at_time(sim.get_time(), "robot")[0].mean()]
    for step in range(steps):
        phase = 2 * math.pi * (step % nbc.CYCLE_STEPS) / (nbc.CYCLE_STEPS - 1)
        sim.set_action("robot", np.full(actuators, 0.6 + (math.sin(phase) + 1) / 2))
        sim.step()
        path.append(sim.object_pos_at_time(sim.get_time(), "robot")[0].mean())
    return np.array(path)


def main() -> None:
    """Prints both paths at the end of each cycle."""
    body = np.array([[int(code) for code in row] for row in BODY], dtype=np.uint8)
    ours = nbc.simulate(body[None], f"00*{CYCLES}", world_width=GROUND)
    theirs = in_evolution_gym(body, CYCLES * nbc.CYCLE_STEPS)
    if ours.com is not None:
        for cycle in range(CYCLES + 1):
            at = cycle * nbc.CYCLE_STEPS
            print(f"cycle {cycle}: nbc {ours.com[0, at, 0]:.6f}, Evolution Gym {theirs[at]:.6f}")


if __name__ == "__main__":
    main()
