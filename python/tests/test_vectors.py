"""Many robots at once, as gymnasium means vector environments."""

from __future__ import annotations

import copy
import pickle

import numpy as np
import pytest

gymnasium = pytest.importorskip("gymnasium")

from nbc.evogym.envs import TaskEnv, TaskVectorEnv  # noqa: E402

BODY = np.array([[3, 3, 3], [4, 1, 4], [3, 0, 3]])
MODES = gymnasium.vector.AutoresetMode


def _alone(task, seed, options=None):
    return TaskEnv(task, BODY).reset(seed=seed, options=options)[0]


@pytest.mark.parametrize("task", ["Catcher-v0", "BidirectionalWalker-v0"])
def test_a_world_has_the_seed_of_a_single_environment(task):
    many = TaskVectorEnv(task, [BODY] * 3)
    observed, _ = many.reset(seed=5)
    assert many.np_random_seed == (5, 6, 7)
    for n in range(3):
        np.testing.assert_array_equal(observed[n], _alone(task, 5 + n))
    assert len(np.unique(observed, axis=0)) > 1
    np.testing.assert_array_equal(many.reset(seed=[9, 6, None])[0][:2], [_alone(task, 9), _alone(task, 6)])
    single = gymnasium.vector.SyncVectorEnv([lambda: TaskEnv(task, BODY)] * 3)
    for _ in range(2):
        np.testing.assert_array_equal(many.reset(seed=5)[0], single.reset(seed=5)[0])
        np.testing.assert_array_equal(many.reset()[0], single.reset()[0])


def test_a_mask_resets_some_worlds():
    many = TaskVectorEnv("Catcher-v0", [BODY] * 3)
    many.reset(seed=1)
    for _ in range(4):
        before = many.step(np.full((3, 7), 1.4))[0]
    mask = np.array([False, True, False])
    after, _ = many.reset(seed=4, options={"reset_mask": mask})
    np.testing.assert_array_equal(after[[0, 2]], before[[0, 2]])
    np.testing.assert_array_equal(after[1], _alone("Catcher-v0", 5))
    assert many._steps.tolist() == [4, 0, 4] and many.np_random_seed == (1, 5, 3)
    many.step(np.full((3, 7), 1.4))


def test_worlds_have_options_of_their_own_and_keep_them():
    many = TaskVectorEnv("Catcher-v0", [BODY] * 3, "SameStep", max_episode_steps=2)
    places = [[-6, 5], None, [4, 0]]
    first, _ = many.reset(seed=1, options={"goals": places})
    for n, goals in enumerate(places):
        np.testing.assert_array_equal(first[n], _alone("Catcher-v0", 1 + n, {"goals": goals}))
    for _ in range(2):
        again, _, _, truncated, _ = many.step(np.ones((3, 7)))
    assert truncated.all()
    np.testing.assert_array_equal(again[[0, 2]], first[[0, 2]])
    many.reset(options={"goals": [1, 1], "reset_mask": np.array([True, False, False])})
    assert many._goals == [[1, 1], None, [4, 0]]
    many.reset()
    assert many._goals == [None] * 3


@pytest.mark.parametrize("mode", ["NextStep", MODES.SAME_STEP, "Disabled"])
def test_worlds_that_end_are_reset_as_the_mode_says(mode):
    """The same three steps as gymnasium's own vector of single environments, of two env steps each."""
    def single():
        return gymnasium.wrappers.TimeLimit(TaskEnv("UpStepper-v0", BODY), 2)

    theirs = gymnasium.vector.SyncVectorEnv([single] * 2, autoreset_mode=mode)
    ours = TaskVectorEnv("UpStepper-v0", [BODY] * 2, mode, max_episode_steps=2)
    assert ours.metadata["autoreset_mode"] is MODES(mode)
    np.testing.assert_array_equal(ours.reset(seed=1)[0], theirs.reset(seed=1)[0])
    targets = np.random.default_rng(1).uniform(0.6, 1.6, (5, 2, 7))
    for step in range(5):
        if mode == "Disabled" and step in (2, 4):
            with pytest.raises(ValueError, match=r"the worlds \[0, 1\] have ended; `reset` with a `reset_mask`"):
                ours.step(targets[step])
            mask = np.array([True, True])
            after = ours.reset(options={"reset_mask": mask})[0]
            np.testing.assert_array_equal(after, theirs.reset(options={"reset_mask": mask})[0])
        (*own, info), (*others, found) = ours.step(targets[step]), theirs.step(targets[step])
        for one, other in zip(own, others):
            np.testing.assert_array_equal(one, other)
        assert info.keys() == found.keys()
        if "final_obs" in found:
            np.testing.assert_array_equal(np.stack(info["final_obs"]), np.stack(found["final_obs"]))


def test_gymnasium_makes_vectors():
    many = gymnasium.make_vec("nbc/UpStepper-v0", num_envs=2, body=BODY, render_mode="rgb_array")
    assert isinstance(many.unwrapped, TaskVectorEnv) and many.unwrapped.max_episode_steps == 600
    many = gymnasium.wrappers.vector.RecordEpisodeStatistics(many)
    many.reset(seed=1)
    many.step(many.action_space.sample())
    pictures = many.render()
    assert len(pictures) == 2 and pictures[0].shape == (360, 640, 3)
    one_by_one = gymnasium.make_vec("nbc/UpStepper-v0", num_envs=2, body=BODY, vectorization_mode="sync")
    np.testing.assert_array_equal(one_by_one.reset(seed=1)[0], many.reset(seed=1)[0])
    assert TaskVectorEnv("UpStepper-v0", [BODY]).render() is None


def test_a_vector_can_be_pickled_and_copied():
    many = TaskVectorEnv("Catcher-v0", [BODY, BODY[:2]], "SameStep", max_episode_steps=4)
    many.reset(seed=3, options={"goals": [[2, 1], None]})
    targets = np.random.default_rng(2).uniform(0.6, 1.6, (9, 2, 7))
    for step in range(3):
        many.step(targets[step])
    others = [pickle.loads(pickle.dumps(many)), copy.deepcopy(many)]
    for step in range(3, 9):
        *own, _ = many.step(targets[step])
        for other in others:
            for one, two in zip(own, other.step(targets[step])):
                np.testing.assert_array_equal(one, two)


@pytest.mark.parametrize(
    ("use", "error", "message"),
    [
        (lambda many: many.reset(seed=[1]), ValueError, "there are 1 seeds, expected 2, one for each world"),
        (lambda many: many.reset(seed=[1.5, 2]), TypeError, "the seed is 1.5, expected a whole number"),
        (lambda many: many.reset(options={"reset_mask": [0, 1]}), TypeError, "dtype int64, expected booleans"),
        (lambda many: many.reset(options={"reset_mask": [True]}), ValueError, r"shape \(1,\), expected \(2,\)"),
        (lambda many: many.reset(options={"reset_mask": [False] * 2}), ValueError, "no True, so no world is reset"),
        (lambda many: many.reset(options={"goals": [[1, 2]]}), ValueError, "goals for 1 worlds, expected 2"),
        (lambda many: many.reset(options={"goals": [1]}), ValueError, "there are 1 goals, expected two numbers"),
        (lambda many: many.reset(options={"goals": [-1000, 0]}), ValueError, "x is -979, expected 0 to"),
        (lambda many: many.step(np.ones((2, 6))), ValueError, r"the shape \(2, 6\), expected \(2, 7\)"),
        (lambda many: many.step([[np.inf] * 7] * 2), ValueError, r"action at \(0, 0\) is inf, expected a finite"),
    ],
)
def test_what_a_vector_cannot_do_is_refused_and_leaves_it_whole(use, error, message):
    many = TaskVectorEnv("Catcher-v0", [BODY] * 2)
    many.reset(seed=1)
    before = many.step(np.full((2, 7), 1.2))[0]
    with pytest.raises(error, match=message):
        use(many)
    np.testing.assert_array_equal(many._worlds.observe(), before)
    assert many._goals == [None] * 2 and many.np_random_seed == (1, 2)
    many.step(np.full((2, 7), 1.2))


def test_what_makes_no_vector_is_refused():
    with pytest.raises(ValueError, match="the number of bodies is 0, expected 1 to 100000"):
        TaskVectorEnv("Walker-v0", [])
    with pytest.raises(ValueError, match="the render mode is 'human', expected 'img', 'rgb_array'"):
        TaskVectorEnv("Walker-v0", [BODY], render_mode="human")
    with pytest.raises(ValueError, match="there is no render option `width`, expected hide_background"):
        TaskVectorEnv("Walker-v0", [BODY], render_mode="img", render_options={"width": 3})
    with pytest.raises(ValueError, match="'Sometimes' is not a valid AutoresetMode"):
        TaskVectorEnv("Walker-v0", [BODY], "Sometimes")
