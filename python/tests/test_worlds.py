"""Tests in samples of worlds, and hardening."""

from __future__ import annotations

import json

import pytest

import nbc

GATE = "circuit gate(a, b) -> (q) { q = a nand b }\ntest gate {\n    a b | q\n    0 0 | 1\n    1 1 | 0\n}\n"


def test_yields_are_those_of_the_program(program, root):
    options = ["--worlds", "6", "--vary", "all=30%", "--times", "1,2", "--seed", "3", "--format", "json"]
    expected = json.loads(program("test", "circuits/half_adder.nb", *options))["tests"]
    found = nbc.load(root / "circuits/half_adder.nb").yields(vary="30%", worlds=6, times=[1, 2], seed=3)
    assert [(one.passed, one.worlds, list(one.fails_first)) for one in found] == [
        (one["yield"]["passed"], 6, one["fails_first"]) for one in expected
    ]
    assert [one.vary["friction"] for one in found] == [0.3, 0.6]
    assert found[0].interval[0] <= found[0].share <= found[0].interval[1]
    assert str(found[0]).startswith("half_adder")


def test_hardening_leaves_out_what_fails_first(program, tmp_path):
    path = tmp_path / "gate.nb"
    path.write_text(GATE)
    expected = json.loads(
        program("build", path, "--objective", "delay", "--harden", "35%", "--worlds", "6", "--format", "json")
    )["hardened"]
    found = nbc.load(path).harden(vary="35%", worlds=6, objective="delay")
    assert (list(found.without), found.reached, list(found.tried)) == (
        expected["without"],
        expected["reached"],
        expected["tried"],
    )
    assert len(found.tried) > 0 and str(found)


def test_wrong_samples_are_refused():
    gate = nbc.loads(GATE)
    with pytest.raises(ValueError, match="has no amount"):
        gate.yields(vary="friction")
    with pytest.raises(ValueError, match="worlds is 0"):
        gate.yields(worlds=0)
    with pytest.raises(ValueError, match="need a value"):
        gate.yields(vary=[])
    with pytest.raises(ValueError, match="least_yield is 2"):
        gate.harden(least_yield=2)
    with pytest.raises(nbc.NbcError, match="no test of `lone`"):
        nbc.loads("circuit lone(a) -> (q) { q = not a }").harden()
