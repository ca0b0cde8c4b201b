"""Bodies whose neighbors are not all joined: as Evolution Gym simulates them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from nbc import evogym
from nbc.evogym.tasks import TaskWorlds

RECORDED = np.load(Path(__file__).parent / "data/connections.npz")
NUMBERS = sorted({key.split("/")[0] for key in RECORDED.files if "/" in key})

# A slit from above ends at two points, and sides of the voxels around it end in the same point. Last bits decide
# whether such sides cross, so from some env step on these bodies are in contact or not. The env steps that are
# the same:
SAME = {"1": 5, "4": 1, "6": 1, "8": 0, "11": 5}


def _world(structure, joined):
    world = evogym.EvoWorld()
    world.add_from_array("ground", np.full((1, 20), 5), 0, 0)
    world.add_from_array("robot", structure, 8, 1, joined)
    return world


@pytest.mark.parametrize("number", NUMBERS)
def test_slits_move_as_those_of_evolution_gym(number):
    structure, joined, positions = (RECORDED[f"{number}/{key}"] for key in ("structure", "joined", "positions"))
    sim = evogym.EvoSim(_world(structure, joined))
    actions, steps = np.random.default_rng(int(number)), RECORDED["steps"].tolist()
    assert sim.object_pos_at_time(0, "robot").shape == positions.shape[1:]
    for step in range(1, SAME.get(number, max(steps)) + 1):
        sim.set_action("robot", actions.uniform(0.6, 1.6, sim.get_dim_action_space("robot")))
        is_unstable = sim.step()
        assert is_unstable == (step == RECORDED[f"{number}/fault"])
        if is_unstable:
            return
        if step in steps:
            found = sim.object_pos_at_time(step, "robot")
            np.testing.assert_allclose(found, positions[steps.index(step)], atol=1e-9, err_msg=f"env step {step}")


def test_slits_share_lanes_with_other_bodies():
    bodies = [(RECORDED[f"{number}/structure"], RECORDED[f"{number}/joined"]) for number in NUMBERS]
    many = evogym.Scenes([_world(*body) for body in bodies])
    alone = [evogym.Scenes([_world(*body)]) for body in bodies]
    counts = [each.actuators(0, "robot")[1] for each in alone]
    random = np.random.default_rng(1)
    for _ in range(30):
        targets = [random.uniform(0.6, 1.6, count) for count in counts]
        many.step(np.concatenate(targets))
        for each, own in zip(alone, targets):
            each.step(own)
    for n, each in enumerate(alone):
        np.testing.assert_array_equal(many.points([n], "robot"), each.points([0], "robot"))


def test_a_task_keeps_the_connections_of_its_robot():
    pytest.importorskip("gymnasium")
    from nbc.evogym.envs import TaskEnv, TaskVectorEnv, make_many

    structure, joined = RECORDED["8/structure"], RECORDED["8/joined"]
    env = TaskEnv("Catcher-v0", structure, joined)
    first, _ = env.reset(seed=1)
    whole = TaskEnv("Catcher-v0", structure).reset(seed=1)[0]
    assert len(first) > len(whole)
    assert env.reset(seed=2)[0].shape == first.shape
    many = TaskVectorEnv("Catcher-v0", [structure] * 2, connections=[joined, None])
    np.testing.assert_array_equal(many.reset(seed=1)[0][0], first)
    same = make_many("Catcher-v0", 2, structure, joined)
    np.testing.assert_array_equal(same.reset(seed=1)[0][0], first)
    with pytest.raises(ValueError, match="there are connections of 1 bodies, expected 2"):
        TaskVectorEnv("Catcher-v0", [structure] * 2, connections=[joined])


def test_an_object_that_its_connections_do_not_join_is_refused():
    world = _world([[3, 3], [3, 3]], [[0, 1], [2, 3]])
    with pytest.raises(ValueError, match="the connections of the object `robot` do not join it into one piece"):
        evogym.EvoSim(world)
    assert TaskWorlds(evogym.TASKS["Walker-v0"], [evogym.TASKS["Walker-v0"].make_world([[3]], [[], []])]).actuators == 1
