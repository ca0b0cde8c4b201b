"""Small texts that would make much: refused within a moment, before anything is unfolded (docs/limits.md)."""

from __future__ import annotations

import subprocess
import sys
import textwrap

import pytest

WIDE = "circuit f(a[1000000]) -> (q) { q = a[0] }\n"

# Address space: what the interpreter and numpy take, and a gigabyte.
HEAD = """
import resource
resource.setrlimit(resource.RLIMIT_CPU, (20, 20))
import nbc
taken = int(open("/proc/self/statm").read().split()[0]) * resource.getpagesize()
resource.setrlimit(resource.RLIMIT_AS, (taken + 2**30, taken + 2**30))
"""


def refused(code: str) -> str:
    """What a process says that runs this code within limits of time and memory."""
    code = f"{HEAD}\ntry:\n{textwrap.indent(code, '    ')}\nexcept nbc.NbcError as error:\n    print(error)\n"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=300, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="limits of addresses are measured on Linux")
@pytest.mark.parametrize(
    ("text", "says"),
    [
        (WIDE + "test f {\n a | q\n repeat 199999 {\n 0 | -\n }\n}\n", "bits in rows of tests"),
        (
            "circuit leaf[n](a) -> (q) { q = a }\n"
            "circuit mid[m](a) -> (q) { for i in 0..1000 { _ = leaf[m * 1000 + i](a) }\n q = a }\n"
            "circuit top(a) -> (q) { for i in 0..2000 { _ = mid[i](a) }\n q = a }\n",
            "100000 circuits",
        ),
        (
            "circuit f(a[16]) -> (q[400000]) { q = {400000{a[0]}} }\n"
            "test f for all inputs { q = {400000{a[0]}} }\n",
            "bits in rows of tests",
        ),
    ],
)
def test_programs(text, says):
    assert says in refused(f"nbc.loads({text!r})")


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="limits of addresses are measured on Linux")
def test_swarms():
    text = (
        "circuit f(a[64], b[64]) -> (q[64]) {\n net t[3500][64]\n t[0] = a xor b\n for i in 1..3500 {\n"
        " t[i] = (t[i - 1] nand {t[i - 1][62..0], t[i - 1][63]}) xor b\n }\n q = t[3499]\n}\n"
    )
    assert "more than 400000 gates" in refused(f"nbc.loads({text!r}).compile()")
