"""Trials and flocks."""

from __future__ import annotations

import copy
import json
import pickle
import threading

import numpy as np
import pytest

import nbc

SCHEDULE = "00*2 01*1 10*56steps 11*1"


def test_results_are_those_of_the_program_bit_for_bit(walkers, program, rows_of, tmp_path):
    walk = nbc.simulate(walkers[:4], SCHEDULE, world_width=60, start_x=20)
    for i, body in enumerate(walkers[:4]):
        file = tmp_path / "body.json"
        file.write_text(json.dumps({"body": rows_of(body)}))
        place = ["--world-width", 60, "--start-x", 20]
        found = json.loads(program("simulate", file, "--schedule", SCHEDULE, *place, "--format", "json"))
        expected = [np.nan if moved is None else moved for moved in found["displacement"]]
        np.testing.assert_array_equal(walk.displacement[i], expected)
        com = walk.com[i, :, 0]
        np.testing.assert_array_equal(com[np.isfinite(com)], found["com_x"])
        assert (walk.faults["env_step"][i] or None) == found["unstable_at"]


def test_shapes_and_kinds_of_bodies(walkers, rows_of):
    walk = nbc.simulate(walkers, SCHEDULE)
    assert walk.displacement.shape == (12, 4) and walk.com.shape == (12, 3 * 84 + 84 + 56 + 1, 2)
    assert len(walk) == 12 and walk.faults.shape == walk.ok.shape == (12,)
    for same in (walkers.astype(np.int64), list(walkers), [rows_of(body) for body in walkers], walkers.tolist(),
                 np.asfortranarray(walkers), np.repeat(walkers, 2, axis=0)[::2]):
        np.testing.assert_array_equal(nbc.simulate(same, SCHEDULE).com, walk.com)
    pairs = [("00", 168), ("01", 84), ("10", 56), ("11", 84)]
    np.testing.assert_array_equal(nbc.simulate(walkers, pairs).displacement, walk.displacement)
    assert nbc.simulate(walkers, SCHEDULE, record=None).com is None


def test_bodies_of_different_boxes_do_not_affect_each_other():
    bodies = [["343", "563"], ["33333"], ["3", "4", "3"]]
    together = nbc.simulate(bodies, SCHEDULE)
    for i, body in enumerate(bodies):
        np.testing.assert_array_equal(nbc.simulate([body], SCHEDULE).com[0], together.com[i])


def test_no_bodies_give_empty_arrays():
    walk = nbc.simulate(np.zeros((0, 3, 3), dtype=np.uint8), SCHEDULE)
    assert walk.displacement.shape == (0, 4) and walk.com.shape[0] == 0


def test_the_number_of_threads_does_not_matter(walkers):
    expected = nbc.simulate(walkers, SCHEDULE).com
    try:
        for threads in (1, 3):
            nbc.set_threads(threads)
            np.testing.assert_array_equal(nbc.simulate(walkers, SCHEDULE).com, expected)
    finally:
        nbc.set_threads(0)


def test_poses_are_the_points_whose_mean_is_the_center(walkers):
    walk = nbc.simulate(walkers[:3], SCHEDULE, record="poses", stride=12)
    for points, voxels, com in zip(walk.poses, walk.voxels, walk.com):
        assert points.shape[1:] == (16, 2) and voxels.shape == (9, 4)
        np.testing.assert_allclose(points.mean(axis=1), com[::12], atol=1e-9)


def test_materials_of_ones_own():
    soft = {"name": "soft", "kind": "soft"}
    own = [*nbc.PAPER_MATERIALS, soft]
    as_paper = nbc.simulate([["323"]], "00*1")
    with_own = nbc.simulate([["393"]], "00*1", materials=own)
    np.testing.assert_array_equal(as_paper.com, with_own.com)


def test_a_third_stimulus():
    touch = {"name": "touch", "kind": "sensor", "stimulus": 3, "absent": 1.1, "present": 0.6}
    own = [*nbc.PAPER_MATERIALS, touch]
    assert nbc.simulate([["393"]], "001*1", materials=own).com[0, -1, 0] != (
        nbc.simulate([["393"]], "000*1", materials=own).com[0, -1, 0]
    )
    pairs = nbc.simulate([["393"]], [("001", 84)], materials=own)
    np.testing.assert_array_equal(pairs.com, nbc.simulate([["393"]], "001*1", materials=own).com)
    with pytest.raises(nbc.NbcError, match="invalid stimulus pattern `00`"):
        nbc.simulate([["393"]], "00*1", materials=own)


def test_a_fault_is_a_value(walkers):
    exploding = [{"name": "a", "kind": "actuator", "period": 2, "phase": 90.0, "range": [0.6, 1.6]}]
    walk = nbc.simulate([["1111", "1111", "1111", "1111"]], "00*2", materials=exploding)
    assert walk.faults["kind"].tolist() in (["unstable"], [""])
    assert walk.ok.tolist() == [walk.faults["env_step"][0] == 0]


def test_a_flock_does_what_a_trial_does(walkers):
    walk = nbc.simulate(walkers, SCHEDULE)
    with nbc.Flock(walkers) as flock:
        np.testing.assert_array_equal(flock.com, walk.com[:, 0])
        for pattern, steps in (("00", 100), ("00", 68), ("01", 84), ("10", 56), ("11", 84)):
            flock.advance(pattern, steps)
        assert set(flock.clock.tolist()) == {392}
        np.testing.assert_array_equal(flock.com, walk.com[:, -1])
        assert [pose.shape for pose in flock.poses()] == [(16, 2)] * 12
        assert flock.voxels(0).shape == (9, 4) and len(flock) == 12


def test_each_robot_of_a_flock_has_its_own_stimuli(walkers):
    patterns = ["00", "01", "10", "11"] * 3
    flock, other = nbc.Flock(walkers), nbc.Flock(walkers)
    flock.advance(patterns)
    other.advance(np.array([[digit == "1" for digit in pattern] for pattern in patterns]))
    np.testing.assert_array_equal(flock.com, other.com)
    for i, pattern in enumerate(patterns[:4]):
        np.testing.assert_array_equal(nbc.simulate(walkers[i : i + 1], f"{pattern}*1").com[0, -1], flock.com[i])


def test_a_flock_goes_back_to_a_snapshot(walkers):
    flock = nbc.Flock(walkers)
    flock.advance("01")
    state = flock.snapshot()
    flock.advance("10")
    there = flock.com
    flock.restore(state)
    assert flock.clock.tolist() == [84] * 12
    flock.advance("10")
    np.testing.assert_array_equal(flock.com, there)
    with pytest.raises(ValueError, match="other bodies"):
        nbc.Flock([["33"]]).restore(state)


def test_a_flock_and_its_states_can_be_pickled_and_copied(walkers):
    flock = nbc.Flock(walkers, world_width=60, start_x=20)
    flock.advance("01", 30)
    flock.advance("01", 12)
    state = flock.snapshot()
    flock.advance(["00", "01", "10", "11"] * 3, 7)
    flock.advance(["10"] * 12, 5)
    others = [pickle.loads(pickle.dumps(flock)), copy.copy(flock), copy.deepcopy(flock)]
    later, kept = flock.com, [pickle.loads(pickle.dumps(state)), copy.deepcopy(state), state]
    for other in others:
        assert other.clock.tolist() == [54] * 12
        np.testing.assert_array_equal(other.com, later)
        other.advance("11", 9)
    np.testing.assert_array_equal(flock.com, later)
    flock.advance("11", 9)
    for each, own in zip(others, kept):
        np.testing.assert_array_equal(each.com, flock.com)
        np.testing.assert_array_equal(each.faults, flock.faults)
        each.restore(own)
        assert each.clock.tolist() == [42] * 12
        each.advance(["00", "01", "10", "11"] * 3, 7)
        again = pickle.loads(pickle.dumps(each))
        for one in (each, again):
            one.advance("10", 5)
            np.testing.assert_array_equal(one.com, later)
    with pytest.raises(ValueError, match="other bodies, or of another world"):
        nbc.Flock(walkers, world_width=70).restore(state)
    flock.close()
    with pytest.raises(ValueError, match="closed"):
        pickle.dumps(flock)


def test_a_flock_can_be_used_from_several_threads(walkers):
    flock = nbc.Flock(walkers)
    threads = [threading.Thread(target=lambda: [flock.advance("01", 10) for _ in range(5)]) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert flock.clock.tolist() == [200] * 12
    np.testing.assert_array_equal(flock.com, nbc.simulate(walkers, "01*200steps").com[:, -1])


def test_progress_is_reported(walkers):
    seen = []
    nbc.simulate(np.repeat(walkers, 4, axis=0), "00*20", progress=lambda done, all: seen.append((done, all)))
    assert seen and all(0 < done <= all == 48 * 1680 for done, all in seen)
    assert seen == sorted(seen)
    nbc.simulate(walkers, "00*1", progress=True)


def test_poses_are_recorded_in_the_same_pass(walkers):
    seen = []
    walk = nbc.simulate(walkers, SCHEDULE, record="poses", progress=lambda done, all: seen.append((done, all)))
    assert seen == sorted(seen) and all(done <= all_ == 12 * 392 for done, all_ in seen)
    only = nbc.simulate(walkers, SCHEDULE)
    np.testing.assert_array_equal(walk.com, only.com)
    np.testing.assert_array_equal(walk.displacement, only.displacement)


class Foreign:
    """An array of another library, such as JAX, which is neither a sequence nor numpy's."""

    def __init__(self, array):
        self.array = np.asarray(array)

    def __array__(self, dtype=None, copy=None):
        return np.array(self.array, dtype=dtype)


class Exchanged:
    """An array that can only be exchanged."""

    def __init__(self, array):
        self.array = np.asarray(array)

    def __dlpack__(self, **options):
        return self.array.__dlpack__(**options)

    def __dlpack_device__(self):
        return self.array.__dlpack_device__()


@pytest.mark.parametrize("kind", [Foreign, Exchanged])
def test_arrays_of_other_libraries_are_taken(walkers, kind):
    expected = nbc.simulate(walkers, "01*1").com
    for bodies in (kind(walkers), [kind(body) for body in walkers], kind(walkers.astype(np.int32))):
        np.testing.assert_array_equal(nbc.simulate(bodies, "01*1").com, expected)
    flock = nbc.Flock(kind(walkers))
    flock.advance(kind(np.tile([0, 1], (12, 1))), kind(np.array(84)))
    np.testing.assert_array_equal(flock.com, expected[:, -1])
    assert nbc.rows(kind(walkers[0])) == nbc.rows(walkers[0]) and nbc.invalid(kind(walkers)) == nbc.invalid(walkers)
    assert nbc.evogym.from_structure(kind([[3, 3]])).tolist() == [[3, 3]]
    with pytest.raises(TypeError, match="dtype float32"):
        nbc.simulate(kind(walkers.astype(np.float32)), "01*1")


def test_materials_of_numpy_numbers():
    plain = {"name": "a", "kind": "actuator", "period": 84, "phase": 90.0, "range": [0.75, 1.5]}
    numpy = {**plain, "period": np.int64(84), "phase": np.float32(90), "range": np.array([0.75, 1.5])}
    expected = nbc.simulate([["111"]], "00*1", materials=[plain]).com
    np.testing.assert_array_equal(nbc.simulate([["111"]], "00*1", materials=[numpy]).com, expected)
    vary = {"friction": np.float32(0.25)}
    run = nbc.Evolution(objective="gate", vary=vary, batch=np.int64(3), shape=(np.int64(4), np.uint8(5)))
    assert run.fields["sample"]["vary"]["friction"] == 0.25 and run.shape == (4, 5)
