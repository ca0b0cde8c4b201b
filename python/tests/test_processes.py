"""Other processes and threads: fork, spawn, pools; memory over many calls."""

from __future__ import annotations

import multiprocessing
import os
import resource
import subprocess
import sys
import textwrap
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import nbc

SCHEDULE = "01*1"

# Ends a test that hangs, on a machine of any load.
LONGEST = 1800


def displacement(body: np.ndarray) -> float:
    return float(nbc.simulate(body[None], SCHEDULE).displacement[0, 0])


@pytest.mark.parametrize("method", ["fork", "spawn", "forkserver"])
def test_processes_of_every_kind(walkers, method):
    expected = nbc.simulate(walkers, SCHEDULE).displacement[:, 0].tolist()
    with multiprocessing.get_context(method).Pool(2) as pool:
        assert pool.map(displacement, list(walkers)) == expected


def test_threads_side_by_side(walkers):
    expected = nbc.simulate(walkers, SCHEDULE).displacement[:, 0].tolist()
    with ThreadPoolExecutor(6) as pool:
        assert list(pool.map(displacement, list(walkers))) == expected


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork here")
def test_a_flock_is_inherited_by_a_fork():
    code = """
        import os, nbc
        flock = nbc.Flock([["343", "563"]])
        flock.advance("01")
        child = os.fork()
        flock.advance("10")
        assert flock.clock.tolist() == [168]
        if child:
            assert os.waitpid(child, 0)[1] == 0
        print("done")
    """
    command = [sys.executable, "-c", textwrap.dedent(code)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=LONGEST)
    assert done.returncode == 0 and done.stdout.count("done") == 2, done.stderr


def test_a_flock_in_use_is_refused_in_a_fork():
    # The advance takes hours. Forks before it has begun are repeated.
    code = """
        import os, threading, nbc
        flock = nbc.Flock([["343", "563"]] * 8)
        threading.Thread(target=lambda: flock.advance("01", 10_000_000), daemon=True).start()
        code = 2
        while code == 2:
            child = os.fork()
            if child == 0:
                try:
                    flock.com
                except RuntimeError as error:
                    os._exit(0 if "was in use when this process was forked" in str(error) else 1)
                os._exit(2)
            code = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
        print(code, flush=True)
        os._exit(0)
    """
    command = [sys.executable, "-W", "ignore", "-c", textwrap.dedent(code)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=LONGEST)
    assert done.stdout.split() == ["0"], done.stderr


def test_memory_stays_flat_over_ten_thousand_calls():
    body, run = [["34", "33"]], nbc.Evolution(shape=(2, 2), fixed="1 cycles", batch=2)
    program = nbc.loads("circuit f(a) -> (q) { q = not a }")

    def calls(times: int) -> None:
        for _ in range(times):
            nbc.simulate(body, "00*1steps")
            flock = nbc.Flock(body)
            flock.advance("01", 1)
            flock.poses()
            try:
                nbc.simulate([["9"]], "00*1")
            except ValueError:
                pass
            try:
                nbc.simulate(body, "99*1")
            except nbc.NbcError:
                pass
            program.tests, program.circuits, run.fields

    calls(500)
    before = resident()
    calls(10_000)
    assert resident() - before < 8_000, "kilobytes"


def resident() -> int:
    """Kilobytes of this process in memory."""
    try:
        with open("/proc/self/status") as status:
            return int(next(line for line in status if line.startswith("VmRSS")).split()[1])
    except OSError:
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
