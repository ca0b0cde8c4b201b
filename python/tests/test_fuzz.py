"""A short run of the fuzzer of the entry points; CONTRIBUTING.md says how to run it for longer."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

FUZZER = Path(__file__).resolve().parents[1] / "fuzz/entry_points.py"


def test_random_arguments_end_in_exceptions_or_results(tmp_path):
    command = [sys.executable, str(FUZZER), "--seed", "1", "--calls", "150"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr[-3000:]
    ends = dict(reversed(line.split()) for line in done.stdout.splitlines())
    assert {"ValueError", "TypeError", "NbcError", "result"} <= set(ends), done.stdout
