"""Interchange with Evolution Gym."""

from __future__ import annotations

import numpy as np
import pytest

import nbc
from nbc import evogym


def test_bodies_go_there_and_back():
    random = np.random.default_rng(2)
    for _ in range(20):
        body = random.integers(0, 4, size=(4, 5))
        body[2] = 3
        structure, joined = evogym.to_structure(np.where(body > 0, body, 0)) if body.any() else (None, None)
        np.testing.assert_array_equal(evogym.from_structure(structure, joined), body)
        np.testing.assert_array_equal(evogym.from_structure(structure.astype(float), joined[::-1]), body)


def test_connections_are_those_of_evolution_gym():
    """`evogym.utils.get_full_connectivity` of this body, from Evolution Gym 2.0.0."""
    structure = np.array([[3, 0, 3], [3, 1, 3]])
    joined = evogym.connections(structure)
    assert sorted(map(tuple, joined.T.tolist())) == [(0, 3), (2, 5), (3, 4), (4, 5)]


@pytest.mark.parametrize(
    ("body", "message"),
    [
        ([["34", "33"]], r"row 1, column 2: 4 is an actuator in antiphase"),
        ([["33", "35"]], r"row 2, column 2: 5 is a sensor"),
    ],
)
def test_what_evolution_gym_lacks_is_refused(body, message):
    with pytest.raises(ValueError, match=message):
        evogym.to_structure(body[0])


@pytest.mark.parametrize(
    ("structure", "joined", "error", "message"),
    [
        ([[3, 4]], None, ValueError, "column 2: 4 is a vertical actuator"),
        ([[5, 5]], None, ValueError, "5 is a fixed voxel, such as terrain"),
        ([[3, 9]], None, ValueError, r"the structure at \(0, 1\) is 9, expected a whole number from 0 to 5"),
        ([[3, -1]], None, ValueError, r"the structure at \(0, 1\) is -1"),
        ([[3.5]], None, ValueError, "is 3.5, expected a whole number"),
        ([[np.nan]], None, ValueError, "is nan, expected a whole number"),
        ([["3"]], None, TypeError, "dtype"),
        ([3, 3], None, ValueError, r"shape \(2,\)"),
        ([[0, 0]], None, ValueError, "no voxels"),
        ([[3, 3]], [[], []], ValueError, "row 1, column 1 and row 1, column 2 are not connected"),
        ([[3, 3]], [[0, 0], [1, 5]], ValueError, r"the connection at \(1, 1\) is 5, expected .* from 0 to 1"),
        ([[3, 3, 3]], [[0, 0], [1, 2]], ValueError, "connected, but are not neighboring"),
        ([[3, 3]], [0, 1], ValueError, r"shape \(2,\), expected \(2, edges\)"),
    ],
)
def test_what_nbc_lacks_is_refused(structure, joined, error, message):
    with pytest.raises(error, match=message):
        evogym.from_structure(structure, joined)


def test_sensors_become_actuators_that_are_moved():
    body = ["345", "678"]
    structure, joined = evogym.to_structure(body, as_actuators=True)
    assert structure.tolist() == [[3, 3, 3], [3, 3, 3]] and joined.shape == (2, 7)
    widths = evogym.actions(body, "00*1 01*1 10*21steps")
    assert widths.shape == (189, 6) and widths.min() >= 0.6 and widths.max() <= 1.6
    assert widths[0, 2:].tolist() == [1.6, 1.6, 0.6, 0.6]
    assert widths[84, 2:].tolist() == [1.6, 0.6, 0.6, 1.6]
    assert widths[168, 2:].tolist() == [0.6, 1.6, 1.6, 0.6]
    np.testing.assert_allclose(widths[:, 0] + widths[:, 1], 2.2)
    np.testing.assert_allclose(widths[21, 0], 1.1 + np.sin(2 * np.pi * 21 / 83) / 2)
    with pytest.raises(ValueError, match="`as_actuators=True` makes it a horizontal actuator, to be moved by"):
        evogym.to_structure(body)
    with pytest.raises(ValueError, match="9 is not one of the paper's materials"):
        evogym.to_structure(["39"], as_actuators=True)


def test_a_robot_with_sensors_walks_as_in_evolution_gym():
    sim = pytest.importorskip("evogym")
    body = next(robot.body for robot in nbc.library() if robot.name == "nand_5x5")
    structure, joined = evogym.to_structure(body, as_actuators=True)
    ground, world = np.full((1, 60), 5), sim.EvoWorld()
    world.add_from_array("ground", ground, 0, 0, evogym.connections(ground))
    world.add_from_array("robot", structure, 30 - 5 // 2, 1, joined)
    theirs = sim.EvoSim(world)
    theirs.reset()
    for widths in evogym.actions(body, "01*84steps 10*28steps"):
        theirs.set_action("robot", widths)
        theirs.step()
    ours = nbc.simulate(body[None], "01*84steps 10*28steps", world_width=60).com[0, -1]
    np.testing.assert_allclose(theirs.object_pos_at_time(theirs.get_time(), "robot").mean(axis=1), ours, atol=1e-9)


def test_a_structure_can_be_simulated():
    body = evogym.from_structure([[3, 3, 3], [3, 0, 3]])
    assert nbc.simulate(body[None], "00*1").ok.all()


@pytest.mark.parametrize("number", [-1, 1, 5, np.int64(-2)])
def test_a_world_that_there_is_not_is_refused_and_the_others_stay(number):
    world = evogym.EvoWorld.of_task("Walker-v0")
    world.add_from_array("robot", np.array([[3, 3], [4, 4]]), 1, 1)
    scenes = evogym.Scenes([world])
    for use in (
        lambda: scenes.reset(number),
        lambda: scenes.points([number], "robot"),
        lambda: scenes.turns([0, number], "robot"),
        lambda: scenes.voxels(number, "robot"),
        lambda: scenes.actuators(number, "robot"),
    ):
        with pytest.raises(IndexError, match=f"there is no world {number}; the worlds count from 0 to 0"):
            use()
    scenes.step(np.ones(4))
    assert scenes.clock.tolist() == [1]


@pytest.mark.parametrize("shape", [(0, 5), (5, 0), (-1, 2)])
def test_a_random_robot_has_a_place_for_a_voxel(shape):
    with pytest.raises(ValueError, match=r"a side of robot_shape is (0|-1), expected 1 to 1000"):
        evogym.sample_robot(shape)


def test_a_shape_that_is_too_large_to_be_in_one_piece_is_given_up():
    with pytest.raises(ValueError, match=r"no body of the shape \(60, 60\) in one piece was found"):
        evogym.sample_robot((60, 60))
    assert evogym.sample_robot((60, 60), [0, 1, 1, 1, 1])[0].all()
    assert (evogym.sample_robot((20, 20), [0, 0, 0, 1, 1, 2])[0] == 5).any()
    with pytest.raises(ValueError, match=r"pd has the shape \(7,\), expected \(5,\), or \(6,\) with fixed voxels"):
        evogym.sample_robot((5, 5), [1] * 7)
