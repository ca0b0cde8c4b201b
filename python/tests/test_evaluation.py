"""Evaluation by the paper's protocol and the gate objective."""

from __future__ import annotations

import shutil

import numpy as np
import pytest

import nbc


def test_the_papers_protocol_is_what_its_simulations_say():
    bodies = np.array([robot.body for robot in nbc.library() if robot.body.shape == (5, 5)][:6])
    result = nbc.evaluate(bodies)
    fixed = np.stack([nbc.simulate(bodies, f"{p}*10").displacement[:, 0] for p in ("00", "01", "10", "11")], axis=1)
    sweep = nbc.simulate(bodies, "00*10 01*10 10*10 11*10").displacement
    consistent = ((fixed > 0) == (sweep > 0)).all(axis=1)
    np.testing.assert_array_equal(result.outcome == "measured", consistent)
    np.testing.assert_array_equal(result.displacement[consistent], fixed[consistent])
    np.testing.assert_array_equal(result.fitness[consistent, 1], np.abs(fixed[consistent]).min(axis=1))
    np.testing.assert_allclose(result.fitness[consistent, 0], np.abs(sweep[consistent]).sum(axis=1), rtol=1e-15)
    letters = ["".join("LR"[int(d > 0)] for d in row) for row in fixed[consistent]]
    assert result.behavior[consistent].tolist() == letters
    assert np.isnan(result.fitness[~consistent]).all() and (result.niche[~consistent] == -1).all()


def test_the_library_is_made_of_gates():
    robots = [robot for robot in nbc.library() if robot.body.shape == (5, 5)]
    result = nbc.evaluate(robots, nbc.Evolution(objective="gate"))
    assert result.measured.all()
    assert result.behavior.tolist() == [robot.behavior for robot in robots]
    assert (result.fitness[:, 0] > 0.5).all(), "every output is right from some cycle on"


def test_a_robot_of_three_stimuli_walks_under_eight_patterns(root):
    robot = next(robot for robot in nbc.library("three") if robot.name == "and3_5x5")
    assert (robot.behavior, robot.function, robot.displacement.shape) == ("LLLLLLLR", "and3", (8,))
    assert robot.materials == nbc.THREE_MATERIALS and nbc.THREE_MATERIALS[:8] == nbc.PAPER_MATERIALS
    schedules = [f"{pattern:03b}*10" for pattern in range(8)]
    walked = [nbc.simulate([robot], each).displacement[0, 0] for each in schedules]
    assert walked == robot.displacement.tolist()
    run = nbc.load(root / "library/three.nb").evolutions["three_gates"]
    assert run.axes == (("voxels", 3), ("active", 3), ("class", 14))
    with pytest.warns(nbc.InvalidBodyWarning):
        result = nbc.evaluate([robot, np.zeros((5, 5), dtype=int)], run)
    assert result.behavior.tolist() == ["LLLLLLLR", ""] and result.displacement.shape == (2, 8)
    assert result.outcome.tolist() == ["measured", "invalid"] and np.isnan(result.displacement[1]).all()
    # The class of all functions that are an AND of three inputs, some of which may be inverted.
    assert result.niche[0, 2] == 1


def test_a_folder_of_robots_is_a_library(root, tmp_path):
    shutil.copy(root / "library/three/and3_5x5.yaml", tmp_path)
    assert [robot.name for robot in nbc.library(tmp_path)] == ["and3_5x5"]
    with pytest.raises(nbc.NbcError, match="missing"):
        nbc.library(tmp_path / "missing")


def test_gates_are_tried_in_other_worlds_too():
    run = nbc.Evolution(objective="gate", vary={"all": 0.2, "missed": 0.01}, worlds=2)
    sample = run.fields["sample"]
    assert sample["worlds"] == 2
    assert (sample["vary"]["drag"], sample["vary"]["missed"], sample["vary"]["dead"]) == (0.2, 0.01, 0)
    with pytest.raises(nbc.NbcError, match="`vary` has no effect"):
        nbc.Evolution(vary={"friction": 0.1})


def test_some_behaviors_are_searched_voxel_by_voxel():
    voxels = dict(genome="voxels", crossover=0.5, shape=(3, 3), batch=4)
    run = nbc.Evolution(objective="wave", behaviors=["xor", "RLLR"], symmetry="npn", **voxels)
    assert run.fields["genome"] == {"voxels": {"crossover": 0.5}}
    search = nbc.Search(run, seed=1)
    for _ in range(3):
        search.step()
    elites = search.archive.elites
    assert len(elites) > 0 and set(elites["behavior"]) <= {"LRRL", "RLLR"}
    with pytest.raises(nbc.NbcError, match="`crossover` has no effect"):
        nbc.Evolution(crossover=0.5)


def test_niches_count_voxels():
    run = nbc.Evolution(descriptors=["voxels in 5 bins", "active in 5 bins", "sensory in 5 bins", "behavior"])
    result = nbc.evaluate([["33333", "55555", "33333", "44444", "66666"]], run)
    if result.measured[0]:
        assert result.niche[0, :3].tolist() == [4, 3, 2]
    assert run.axes == (("voxels", 5), ("active", 5), ("sensory", 5), ("behavior", 16))


def test_a_passive_body_is_inconsistent_or_stands_still():
    result = nbc.evaluate([["22222"] * 5])
    assert result.outcome[0] in ("measured", "inconsistent")
    assert not result.measured[0] or result.behavior[0] == "LLLL"


def test_rules_are_a_word_or_a_list_of_matters():
    assert nbc.Evolution(rules="code").fields["rules"] == "code"
    assert nbc.Evolution(rules=["repair", "sensors"]).fields["rules"] == ["sensors", "repair"]
    with pytest.raises(nbc.NbcError, match="colors"):
        nbc.Evolution(rules=["colors"])
