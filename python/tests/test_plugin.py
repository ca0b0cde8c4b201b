"""The pytest plugin."""

from __future__ import annotations

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


def test_physics_is_the_default_for_small_swarms(pytester):
    pytester.makefile(".nb", good=GOOD)
    pytester.runpytest_subprocess("--nb-level=physics").assert_outcomes(passed=2)
    pytester.runpytest_subprocess("--no-nb").assert_outcomes()


def test_the_gallery_passes(pytester, root):
    result = pytester.runpytest_subprocess(str(root / "circuits"), "--nb-level=logic", "-p", "no:cacheprovider")
    assert result.ret == 0, result.stdout.str()
