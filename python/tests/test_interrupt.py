"""Ctrl-C: answered at once, without lost results. Each case is a process of its own, which gets a real signal."""

from __future__ import annotations

import signal
import subprocess
import sys
import textwrap

import pytest

# Generous for a busy machine; the answer itself is asserted to be quick by the work that remains.
LONGEST = 120

START = """
import os, signal, threading, time
import numpy as np
import nbc
bodies = np.full((64, 5, 5), 3, dtype=np.uint8)
def interrupt(): os.kill(os.getpid(), signal.SIGINT)
class Once:
    "Interrupts at the first progress."
    def __init__(self): self.calls = 0
    def __call__(self, done, all):
        self.calls += 1
        if self.calls == 1:
            self.at = time.monotonic()
            interrupt()
"""


def run(body: str) -> str:
    code = START + textwrap.dedent(body)
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=LONGEST)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_a_simulation_keeps_its_results():
    # Without an interrupt these trials take minutes: 64 bodies, 100,000 cycles each.
    out = run("""
        once = Once()
        try:
            nbc.simulate(bodies, [("00", 84)] + [("01", 84 * 2000)] * 50, progress=once, record=None)
        except nbc.Interrupted as end:
            print("answered" if time.monotonic() - once.at < 5 else "late")
            result = end.result
            stopped = result.faults["kind"] == "stopped"
            print(len(result), bool(stopped.all()), result.displacement.shape)
            expected = nbc.simulate(bodies[:1], [("00", 84)]).displacement[0, 0]
            first = result.displacement[:, 0]
            print(bool((first[np.isfinite(first)] == expected).all()))
        print(nbc.simulate(bodies, "00*1").ok.all())
    """)
    assert out.split("\n")[:4] == ["answered", "64 True (64, 51)", "True", "True"]


def test_a_search_is_as_before_and_an_evolution_keeps_its_generations(tmp_path):
    out = run(f"""
        run = nbc.Evolution(box=(3, 3), batch=8, generations=1000, fixed="10 cycles")
        try:
            nbc.evolve(run, seed=2, checkpoint={str(tmp_path / "run.nbc")!r}, progress=Once())
        except nbc.Interrupted as end:
            search = end.result
            made = search.generation
            print(0 < made < 1000)
            same = nbc.evolve(run, seed=2, generations=made)
            print(bool((same.archive.elites == search.archive.elites).all()))
            print(nbc.Search.resume({str(tmp_path / "run.nbc")!r}, run).summary == search.summary)
            search.step()
            print(search.generation == made + 1)
    """)
    assert out.split() == ["True"] * 4


def test_a_flock_is_as_before():
    out = run("""
        flock = nbc.Flock(bodies)
        flock.advance("01", 10)
        before, clock = flock.com, flock.clock
        threading.Timer(0.3, interrupt).start()
        try:
            flock.advance("01", 10_000_000)
        except KeyboardInterrupt:
            print(bool((flock.com == before).all() and (flock.clock == clock).all()))
        flock.advance("01", 10)
        print(bool((flock.com[0] == nbc.simulate(bodies[:1], "01*20steps").com[0, -1]).all()))
    """)
    assert out.split() == ["True", "True"]


def test_a_swarm_keeps_its_cycles():
    out = run("""
        swarm = nbc.loads("circuit f(a) -> (q) { q = not a }").compile().swarm()
        try:
            swarm.run([dict(a=i % 2) for i in range(2000)], hold=50, progress=Once())
        except KeyboardInterrupt:
            cycles = swarm.cycles
            print(0 < cycles < 100_000, swarm.bits.shape == (cycles, 1))
        swarm.step(a=0)
        print(swarm.cycles > cycles)
    """)
    assert out.split() == ["True"] * 3


def test_an_evaluation_keeps_its_results():
    out = run("""
        many = np.random.default_rng(1).integers(1, 9, size=(4000, 5, 5), dtype=np.uint8)
        once = Once()
        try:
            nbc.evaluate(many, progress=once)
        except nbc.Interrupted as end:
            print("answered" if time.monotonic() - once.at < 5 else "late")
            print(len(end.result), bool((end.result.outcome == "stopped").any()))
    """)
    assert out.split("\n")[:2] == ["answered", "4000 True"]


LONG_CALLS = ["nbc.simulate(bodies, [('00', 9_000_000)], record=None)", "nbc.Flock(bodies).advance('00', 10**7)"]


@pytest.mark.parametrize("call", LONG_CALLS)
def test_ctrl_c_ends_a_program(call):
    code = START + f"threading.Timer(0.3, lambda: print('begun', flush=True)).start()\n{call}"
    process = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert process.stdout is not None and process.stdout.readline() == "begun\n"
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate(timeout=LONGEST)
    assert process.returncode != 0 and ("KeyboardInterrupt" in errors or "Interrupted" in errors)
    assert "panicked" not in errors
