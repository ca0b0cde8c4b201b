"""Wrong arguments: an exception of the right type, which says what was expected."""

from __future__ import annotations

import pickle

import numpy as np
import pytest

import nbc

BODY = np.full((1, 2, 3), 3, dtype=np.uint8)


@pytest.mark.parametrize(
    ("bodies", "error", "message"),
    [
        (BODY[0], ValueError, r"shape \(2, 3\), expected \(N, H, W\); for one body write `body\[None\]`"),
        (BODY[None], ValueError, r"expected \(N, H, W\)"),
        (BODY.astype(float), TypeError, "dtype float64, expected integers"),
        (BODY * np.nan, TypeError, "dtype float64, expected integers"),
        (BODY.astype(complex), TypeError, "dtype complex128"),
        (BODY.astype(bool), TypeError, "dtype bool"),
        (BODY.astype(str), TypeError, "dtype <U"),
        (BODY.astype(int) * 100, ValueError, "300 is not a material code"),
        (-BODY.astype(int), ValueError, "-3 is not a material code"),
        (BODY * 4, ValueError, r"bodies\[0\]: row 1, column 1: 12 is not a material code; expected 0 to 8"),
        (BODY * 0, ValueError, r"bodies\[0\]: the body has no voxels"),
        (np.zeros((2, 0, 0), dtype=np.uint8), ValueError, "has no voxels"),
        ([["33"], ["30", "03"]], ValueError, r"bodies\[1\]: the body is not in one piece"),
        ([["33", "3"]], ValueError, r"bodies\[0\]: row 2 has 1 voxels, expected 2 as in row 1"),
        ([["3!"]], ValueError, "`!` is not a material code"),
        ([[[3, 3], [3]]], ValueError, r"bodies\[0\]"),
        ([[3, 3]], ValueError, r"bodies\[0\] has the shape \(2,\)"),
        (["33"], TypeError, r"bodies\[0\] is a text"),
        ("33", TypeError, "of type str"),
        (None, TypeError, "of type NoneType"),
        (3, TypeError, "of type int"),
        ({"33"}, TypeError, "of type set"),
        ([np.full((101, 1), 3)], ValueError, "expected at most 100 x 100"),
        ([np.array([[np.nan]])], TypeError, "float64"),
        ([np.array([[None]])], TypeError, "object"),
    ],
)
def test_bodies(bodies, error, message):
    with pytest.raises(error, match=message):
        nbc.simulate(bodies, "00*1")
    with pytest.raises(error, match=message):
        nbc.Flock(bodies)
    with pytest.raises(error):
        nbc.evaluate(bodies)


@pytest.mark.parametrize(
    ("arguments", "error", "message"),
    [
        ({"schedule": []}, ValueError, "empty"),
        ({"schedule": [("00", 0)]}, ValueError, "is 0, expected 1 to"),
        ({"schedule": [("00", 1.5)]}, TypeError, "is 1.5, expected a whole number"),
        ({"schedule": [("02", 1)]}, ValueError, "`02` is not a pattern"),
        ({"schedule": [("", 1)]}, ValueError, "is not a pattern"),
        ({"schedule": [("0" * 33, 1)]}, ValueError, "is not a pattern"),
        ({"schedule": [(0, 1)]}, TypeError, "0 is not a pattern"),
        ({"schedule": [("00", 10_000_000), ("00", 1)]}, ValueError, "too long"),
        ({"schedule": ["00"]}, ValueError, "expected a pattern and a number"),
        ({"schedule": 3}, TypeError, "of type int"),
        ({"world_width": 2}, ValueError, "the world width 2 is too small"),
        ({"world_width": 10**7}, ValueError, "the world width 10000000 is too large"),
        ({"world_width": -1}, ValueError, "world_width is -1"),
        ({"world_width": float("nan")}, TypeError, "world_width is nan"),
        ({"start_x": 498}, ValueError, "off the ground, expected at most 497"),
        ({"record": "film"}, ValueError, "record is 'film'"),
        ({"record": "poses", "stride": 0}, ValueError, "stride is 0"),
        ({"materials": [{"name": "a", "kind": "stone"}]}, ValueError, "materials: unknown variant `stone`"),
        ({"materials": [{"name": "a", "kind": "actuator"}]}, ValueError, "materials: the material `a` lacks"),
        ({"materials": []}, ValueError, "materials: 0 materials, expected 1 to 35"),
        ({"materials": [{"name": "a", "kind": "actuator", "phase": float("nan")}]}, ValueError, "finite numbers"),
        ({"materials": "stone"}, TypeError, "of type str"),
        ({"progress": lambda: 0, "schedule": "00*400"}, TypeError, "takes 0 positional arguments"),
    ],
)
def test_arguments(arguments, error, message):
    arguments = {"bodies": np.repeat(BODY, 64, axis=0), "schedule": "00*1", **arguments}
    with pytest.raises(error, match=message):
        nbc.simulate(**arguments)


def test_paths_that_do_not_fit_into_memory_are_refused():
    with pytest.raises(MemoryError, match="GiB; simulate fewer bodies at once, or with `record=None`"):
        nbc.simulate(np.repeat(BODY, 1000, axis=0), "00*10000000steps")


def test_a_schedule_has_diagnostics_with_places():
    with pytest.raises(nbc.NbcError) as caught:
        nbc.simulate(BODY, "00*10 02*10 00*0")
    first, second = caught.value.diagnostics
    assert (first.code, first.message) == ("bad-schedule", "invalid stimulus pattern `02`")
    assert (first.span.line, first.span.column, first.span.end_column) == (1, 7, 9)
    assert second.span.start_byte == 12 + 3 and "write stimuli" in second.help
    copy = pickle.loads(pickle.dumps(caught.value))
    assert copy.diagnostics == caught.value.diagnostics and str(copy) == str(caught.value)


def test_a_closed_flock_is_refused():
    flock = nbc.Flock(BODY)
    flock.close()
    flock.close()
    for use in (lambda: flock.com, lambda: flock.advance("00"), flock.poses, flock.snapshot):
        with pytest.raises(ValueError, match="the flock is closed"):
            use()


@pytest.mark.parametrize(
    ("patterns", "steps", "error", "message"),
    [
        (["00", "01"], 1, ValueError, "2 patterns, expected 1"),
        ("0x", 1, ValueError, "`0x` is not a pattern"),
        ([0], 1, TypeError, "0 is not a pattern"),
        (np.zeros(2, dtype=bool), 1, ValueError, r"shape \(2,\), expected \(1, stimuli\)"),
        (np.full((1, 2), 2), 1, ValueError, "other than 0 and 1"),
        (np.full((1, 2), np.nan), 1, TypeError, "float64"),
        ("00", -1, ValueError, "steps is -1"),
        ("00", 0.5, TypeError, "steps is 0.5"),
        ("00", 10**8, ValueError, "expected 0 to 10000000"),
    ],
)
def test_flock_arguments(patterns, steps, error, message):
    flock = nbc.Flock(BODY)
    with pytest.raises(error, match=message):
        flock.advance(patterns, steps)
    assert flock.clock.tolist() == [0]
    with pytest.raises(IndexError):
        flock.voxels(1)


def test_evolutions():
    with pytest.raises(nbc.NbcError) as caught:
        nbc.Evolution(box=(0, 5), objective="beauty")
    assert {diagnostic.span.line for diagnostic in caught.value.diagnostics} == {3, 4}
    with pytest.raises(nbc.NbcError):
        nbc.Evolution.parse("evolution {")
    assert nbc.Evolution.parse("circuit f(a) -> (q) { q = not a }").fields["name"] == "gates"
    with pytest.raises(ValueError, match=r"bodies\[0\] must be 5 rows of 5 codes"):
        nbc.evaluate(BODY, nbc.Evolution())
    with pytest.raises(TypeError, match="of type str"):
        nbc.evaluate(BODY, "gates")
