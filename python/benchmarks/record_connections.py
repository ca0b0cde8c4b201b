"""Records how Evolution Gym simulates bodies whose neighbors are not all joined, for `tests/test_connections.py`.

In a Python 3.10 with Evolution Gym 2.0.0 (``pip install evogym==2.0.0``), in the folder ``python``:

    python benchmarks/record_connections.py

writes ``tests/data/connections.npz``. For each body it has the structure, the neighbors that are left apart, and the
positions of the points after some env steps on flat ground, under random actions of numpy's generator with the number
of the body as its seed, and the env step in which it became unstable, or 0.
"""

from __future__ import annotations

from pathlib import Path

import evogym
import numpy as np

STEPS = (1, 2, 5, 10, 20, 40, 80)
# Slits from below, above, left and right, among actuators and rigid voxels, without an end, legs and ears.
BODIES = (
    (["33", "33"], [(2, 3)]),
    (["34", "43"], [(0, 1)]),
    (["33", "44"], [(0, 2)]),
    (["23", "32"], [(1, 3)]),
    (["11", "31"], [(0, 1)]),
    (["1131", "3113"], [(1, 2)]),
    (["34", "32", "43"], [(2, 3)]),
    (["333", "343", "434"], [(6, 7), (7, 8)]),
    (["343", "333", "303"], [(0, 1), (1, 2)]),
    (["3333", "3403", "3333"], [(1, 2), (8, 9)]),
    (["343", "434"], [(1, 4)]),
    (["2132", "3123"], [(1, 2)]),
)


def main() -> None:
    """Records all bodies."""
    found = {}
    for number, (rows, apart) in enumerate(BODIES):
        structure = np.array([[int(code) for code in row] for row in rows])
        all_of = evogym.get_full_connectivity(structure)
        joined = np.array([pair for pair in all_of.T.tolist() if tuple(sorted(pair)) not in apart]).T
        world = evogym.EvoWorld()
        world.add_from_array("ground", np.full((1, 20), 5), 0, 0)
        world.add_from_array("robot", structure, 8, 1, joined)
        sim = evogym.EvoSim(world)
        actions, positions, fault = np.random.default_rng(number), [], 0
        for step in range(1, max(STEPS) + 1):
            sim.set_action("robot", actions.uniform(0.6, 1.6, sim.get_dim_action_space("robot")))
            if sim.step():
                fault = step
                break
            if step in STEPS:
                positions.append(sim.object_pos_at_time(step, "robot"))
        keys = {"structure": structure.astype(np.uint8), "joined": joined, "positions": np.array(positions),
                "fault": fault}
        found.update({f"{number}/{key}": np.array(value) for key, value in keys.items()})
    path = Path(__file__).parent.parent / "tests/data/connections.npz"
    np.savez_compressed(path, steps=np.array(STEPS), **found)


if __name__ == "__main__":
    main()
