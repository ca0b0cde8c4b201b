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
        ([[3, 9]], None, ValueError, "9 is not a voxel of Evolution Gym"),
        ([[3, -1]], None, ValueError, "-1 is not a voxel"),
        ([[3.5]], None, ValueError, "expected whole numbers"),
        ([[np.nan]], None, ValueError, "expected whole numbers"),
        ([["3"]], None, TypeError, "dtype"),
        ([3, 3], None, ValueError, r"shape \(2,\)"),
        ([[0, 0]], None, ValueError, "no voxels"),
        ([[3, 3]], [[], []], ValueError, "row 1, column 1 and row 1, column 2 are not connected"),
        ([[3, 3]], [[0, 0], [1, 5]], ValueError, "connected, but are not neighboring"),
        ([[3, 3]], [0, 1], ValueError, r"shape \(2,\), expected \(2, edges\)"),
    ],
)
def test_what_nbc_lacks_is_refused(structure, joined, error, message):
    with pytest.raises(error, match=message):
        evogym.from_structure(structure, joined)


def test_a_structure_can_be_simulated():
    body = evogym.from_structure([[3, 3, 3], [3, 0, 3]])
    assert nbc.simulate(body[None], "00*1").ok.all()
