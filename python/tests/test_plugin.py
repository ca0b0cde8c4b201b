"""The pytest plugin."""

from __future__ import annotations

import re

from nbc.pytest_plugin import _BEGIN

GOOD = """
circuit inverter(a) -> (q) { q = not a }
test inverter "turns" { a | q
    0 | 1
    1 | 0 }
test inverter { a | q
    0 | 1 }
"""
WRONG = """
circuit wire(a) -> (q) { q = not not a }
test wire "wrong" { a | q
    0 | 1 }
"""


def test_each_test_of_a_file_is_a_test(pytester):
    pytester.makefile(".nb", good=GOOD, wrong=WRONG)
    result = pytester.runpytest_subprocess("--nb-level=logic", "-v")
    result.assert_outcomes(passed=2, failed=1)
    result.stdout.fnmatch_lines(["*good.nb::inverter: turns PASSED*", "*wrong.nb::wire: wrong FAILED*"])
    result.stdout.fnmatch_lines(['test wire "wrong": FAIL', "*expected*observed*"])
    assert "Traceback" not in result.stdout.str() and "runtest" not in result.stdout.str()


def test_tests_are_chosen_by_name_and_run_in_parallel(pytester):
    pytester.makefile(".nb", good=GOOD, wrong=WRONG)
    result = pytester.runpytest_subprocess("--nb-level=logic", "-k", "turns")
    result.assert_outcomes(passed=1, deselected=2)
    result = pytester.runpytest_subprocess("--nb-level=logic", "-n", "2")
    result.assert_outcomes(passed=2, failed=1)


def test_errors_of_a_file_are_shown_as_diagnostics(pytester):
    pytester.makefile(".nb", bad="circuit f(a) -> (q) { q = b }")
    result = pytester.runpytest_subprocess()
    result.assert_outcomes(errors=1)
    result.stdout.fnmatch_lines(["*bad.nb:1:27: error[[]unknown[]]*"])
    assert "Traceback" not in result.stdout.str()


FOREIGN = {
    "empty": b"",
    "comments": b"// Nothing is declared here.\n",
    "wolfram": b"(* Content-type: application/vnd.wolfram.mathematica *)\n\nNotebook[{\ncircuit}]\n",
    "bare": b"Notebook[{}]",
    "wide": "circuit f(a) -> (q) { q = a }".encode("utf-16"),
    "binary": bytes(range(256)),
    "prose": b"Notes on a test of circuits\n",
    "longer": b"circuits are not circuit\n",
}


def test_files_of_others_are_left_alone(pytester):
    for name, content in FOREIGN.items():
        (pytester.path / f"{name}.nb").write_bytes(content)
    (pytester.path / "missing.nb").symlink_to("nowhere.nb")
    (pytester.path / "folder.nb").mkdir()
    pytester.makepyfile("def test_own(): pass")
    commented = "\ufeff// A comment.\n  //! And another.\n\n" + GOOD.strip()
    (pytester.path / "good.nb").write_text(commented, encoding="utf-8")
    pytester.runpytest_subprocess("--nb-level=logic").assert_outcomes(passed=3)
    # What is named is shown with its errors.
    for name, told in (("wolfram", "*wolfram.nb:1:1: error*"), ("wide", "*wide.nb`: file is not valid UTF-8*")):
        named = pytester.runpytest_subprocess(f"{name}.nb")
        named.assert_outcomes(errors=1)
        named.stdout.fnmatch_lines([told])


def test_each_word_of_the_language_begins_a_file(root):
    text = (root / "crates/lang/src/syntax/split.rs").read_text()
    found = re.findall(r'"(\w+)"', text[text.index("KEYWORDS") : text.index("];")])
    assert "circuit" in found and [word for word in found if not _BEGIN.match(word.encode())] == []


def test_physics_is_the_default_for_small_swarms(pytester):
    pytester.makefile(".nb", good=GOOD)
    pytester.runpytest_subprocess("--nb-level=physics").assert_outcomes(passed=2)
    pytester.runpytest_subprocess("--no-nb").assert_outcomes()


def test_the_gallery_passes(pytester, root):
    result = pytester.runpytest_subprocess(str(root / "circuits"), "--nb-level=logic", "-p", "no:cacheprovider")
    assert result.ret == 0, result.stdout.str()
