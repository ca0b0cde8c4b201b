"""Circuits of other tools, mapped and proved."""

from __future__ import annotations

import json

import pytest

import nbc

C17 = "tests/benchmarks/c17.aig"


def test_a_synthesis_is_that_of_the_program(program, root, tmp_path):
    theirs, ours = tmp_path / "theirs.nb", tmp_path / "ours.nb"
    options = ["--cells", "nand,not", "--what-if", "xor", "-o", theirs, "--format", "json"]
    expected = json.loads(program("synth", C17, *options))
    made = nbc.synthesize(root / C17, output=ours, cells=["nand", "not"], what_if=["xor"])
    for report in (expected, made.report):
        report.pop("seconds")
        report.pop("schema", None)
    assert made.report == expected and theirs.read_text() == ours.read_text()
    assert (made.cells, made.by_function, made.registers) == (6, {"nand": 6}, 0)
    assert str(made).startswith("6 cells (6 nand)") and made.report["proved"]


def test_wrong_syntheses_are_refused(root, tmp_path):
    file = root / C17
    with pytest.raises(nbc.NbcError, match="`nnad` is not a function"):
        nbc.synthesize(file, cells=["nnad"])
    with pytest.raises(nbc.NbcError, match="cannot read|not found"):
        nbc.synthesize(tmp_path / "none.blif")
    with pytest.raises(ValueError, match="unrecognized circuit format"):
        nbc.synthesize(file, output=tmp_path / "c17.txt")
    with pytest.raises(ValueError, match="cells and library"):
        nbc.synthesize(file, cells=["nand"], library="shipped")
    with pytest.raises(ValueError, match="invalid registers"):
        nbc.synthesize(file, registers="none")
    with pytest.raises(TypeError, match="cells is 'nand', expected a list of texts"):
        nbc.synthesize(file, cells="nand")
    with pytest.raises(TypeError, match="needs a file"):
        nbc.synthesize()
