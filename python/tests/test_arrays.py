"""Arrays of torch and JAX, where they are installed."""

from __future__ import annotations

import numpy as np
import pytest

import nbc
from nbc.evogym import EvoSim, EvoWorld, Scenes

BODY = np.array([[3, 3, 3], [4, 1, 4], [3, 0, 3]])


@pytest.fixture(params=["torch", "jax"])
def made(request):
    """Makes an array of a library from one of numpy."""
    library = pytest.importorskip(request.param, reason=f"{request.param} is not installed")
    return library.from_numpy if request.param == "torch" else library.numpy.asarray


@pytest.fixture
def world():
    found = EvoWorld.of_task("Walker-v0")
    found.add_from_array("robot", BODY, 1, 1)
    return found


def test_bodies_and_stimuli(made, walkers):
    expected = nbc.simulate(walkers, "01*1").com
    for bodies in (made(walkers), [made(body) for body in walkers], made(walkers.astype(np.int32))):
        np.testing.assert_array_equal(nbc.simulate(bodies, "01*1").com, expected)
    with nbc.Flock(made(walkers)) as flock:
        flock.advance(made(np.tile([0, 1], (12, 1))), made(np.array(84)))
        np.testing.assert_array_equal(flock.com, expected[:, -1])
    assert nbc.rows(made(walkers[0])) == nbc.rows(walkers[0])
    with pytest.raises(TypeError, match="dtype float32"):
        nbc.simulate(made(walkers.astype(np.float32)), "01*1")


# JAX has no numbers of 64 bits unless it is told to; those of 32 bits are the same numbers in each library.
def _targets(*shape):
    return np.random.default_rng(3).uniform(0.6, 1.6, shape).astype(np.float32)


def test_targets_of_scenes(made, world):
    numpy, other = Scenes([world, world]), Scenes([world, world])
    for targets in _targets(20, 14):
        numpy.step(targets)
        other.step(made(targets))
    np.testing.assert_array_equal(numpy.points([0, 1], "robot"), other.points([0, 1], "robot"))
    simulations = EvoSim(world), EvoSim(world)
    for targets in _targets(20, 7):
        simulations[0].set_action("robot", targets)
        simulations[1].set_action("robot", made(targets))
        assert [sim.step() for sim in simulations] == [False, False]
    np.testing.assert_array_equal(*[sim.pos_at_time(20) for sim in simulations])


def test_actions_of_environments(made, world):
    pytest.importorskip("gymnasium")
    from nbc.evogym.envs import EvoGymBase, TaskEnv, TaskVectorEnv

    many = [TaskVectorEnv("Walker-v0", [BODY, BODY[:2]]) for _ in range(2)]
    for actions in _targets(20, 2, 7):
        left, right = many[0].step(actions), many[1].step(made(actions))
        np.testing.assert_array_equal(left[0], right[0])
        np.testing.assert_array_equal(left[1], right[1])
    alone, based = [TaskEnv("Walker-v0", BODY) for _ in range(2)], [EvoGymBase(world) for _ in range(2)]
    for action in _targets(20, 7):
        assert alone[0].step(action)[1] == alone[1].step(made(action))[1]
        assert not based[0].step({"robot": action}) and not based[1].step({"robot": made(action)})
    np.testing.assert_array_equal(*[each.get_relative_pos_obs("robot") for each in based])


def test_arrays_that_only_dlpack_exchanges():
    pytest.importorskip("gymnasium")
    from nbc.evogym.envs import TaskVectorEnv
    from test_physics import Exchanged

    many = [TaskVectorEnv("Walker-v0", [BODY, BODY]) for _ in range(2)]
    actions = _targets(2, 7)
    np.testing.assert_array_equal(many[0].step(actions)[0], many[1].step(Exchanged(actions))[0])


def test_a_tensor_with_a_gradient_is_taken(world):
    torch = pytest.importorskip("torch", reason="torch is not installed")
    targets = torch.ones(7, requires_grad=True)
    scenes = Scenes([world])
    scenes.step(targets)
    assert scenes.clock.tolist() == [1]
