"""Faults of nbc itself: a clear exception, after which the process goes on."""

from __future__ import annotations

import numpy as np
import pytest

import nbc


@pytest.mark.parametrize(("at_once", "where"), [(True, "a test at once"), (False, "a test in a thread")])
def test_a_panic_is_an_exception_after_which_all_else_works(walkers, at_once, where):
    flock, other = nbc.Flock(walkers), nbc.Flock(walkers)
    with pytest.raises(nbc.InternalError, match=f"a fault of nbc itself: {where}") as caught:
        flock._native.panic(at_once)
    assert isinstance(caught.value, Exception) and caught.value.diagnostics == ()
    with pytest.raises(RuntimeError, match="the flock was lost in an earlier fault"):
        flock.advance("01")
    flock.close()
    other.advance("01")
    np.testing.assert_array_equal(other.com, nbc.simulate(walkers, "01*1").com[:, -1])
