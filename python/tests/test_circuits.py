"""Circuits, swarms, tests and pictures."""

from __future__ import annotations

import json
import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest

import nbc
from conftest import ROOT

INVERTER = "circuit inverter(a) -> (q) { q = not a }"
ADDER = "circuit add(a[2], b[2]) -> (s[2]) { s = a + b }"


@pytest.fixture(scope="module")
def latch():
    return nbc.load(ROOT / "circuits/latch.nb").circuits["d_latch"].compile()


def test_a_latch_remembers(latch):
    assert len(latch.robots) == 5 and [port.name for port in latch.inputs] == ["d", "e"]
    with latch.swarm() as swarm:
        rows = [{"d": 0, "e": 1}, {"d": 1, "e": 1}, (1, 0), (0, 0), (0, 1)]
        assert [row["q"] for row in swarm.run(rows)] == [0, 1, 1, 1, 0]
        cycles = swarm.cycles
        assert swarm.bits.shape == (cycles, 5) and swarm.inputs.shape == swarm.outputs.shape == (cycles, 2)
        assert swarm.paths.shape == (5, 12 * cycles + 1)
        assert swarm.step(d=1, e=1, cycles=10) == {"q": 1, "nq": 0}
        assert ElementTree.fromstring(swarm.spacetime()).tag.endswith("svg")
        swarm.reset()
        assert swarm.cycles == 0 and swarm._repr_svg_() is None
    with pytest.raises(ValueError, match="the swarm is closed"):
        swarm.step(d=0, e=0)


def test_tests_are_those_of_the_program(program, root):
    path = root / "circuits/latch.nb"
    results = nbc.load(path).test(level="physics")
    found = json.loads(program("test", path, "--physics", "--format", "json"))
    for name, value in found["tests"][0].items():
        shown = getattr(results[0], name)
        assert (list(shown) if isinstance(value, list) else shown) == value, name
    assert results[0].passed and results[0].level == "physics" and "follows d while e is on" in str(results[0])


def test_netlist_and_timing(latch):
    graph = latch.netlist
    kinds = [data["kind"] for _, data in graph.nodes(data=True)]
    assert kinds.count("cell") == 5 and kinds.count("input") == kinds.count("output") == 2
    cells = [node for node, data in graph.nodes(data=True) if data["kind"] == "cell"]
    assert all(graph.in_degree(node) in (1, 2) for node in cells)
    assert len(latch.graph(as_written=True)) > len(graph) - 2
    timing = latch.timing
    assert timing["hold"] > 0 and len(timing["robots"]) == 5 and timing["memory"]
    assert ElementTree.fromstring(latch.schematic(safe_colors=True)).tag.endswith("svg")


def test_buses_are_numbers():
    swarm = nbc.loads(ADDER).compile(effort="fast").swarm()
    assert swarm.run([dict(a=1, b=2), dict(a=3, b=2)]) == [{"s": 3}, {"s": 1}]
    with pytest.raises(ValueError, match="the value of `a` is 4, expected 0 to 3"):
        swarm.step(a=4, b=0)


def test_options_of_compiling(tmp_path, latch):
    program = nbc.loads(INVERTER)
    assert program.compile(objective="delay", effort="fast", library="shipped").robots[0]["function"] == "not"
    for options, message in (
        (dict(objective="beauty"), "invalid objective `beauty`; expected area, delay, margin or sturdy"),
        (dict(effort="much"), "invalid effort"),
    ):
        with pytest.raises(ValueError, match=message):
            program.compile(**options)
    with pytest.raises(nbc.NbcError) as caught:
        program.compile(library=tmp_path)
    assert caught.value.diagnostics[0].code == "incomplete-library"
    with pytest.raises(nbc.NbcError):
        program.compile(library=tmp_path / "none")
    with pytest.raises(nbc.NbcError):
        program.compile("other")
    with pytest.raises(KeyError, match="there is no circuit called `other`; expected one of inverter"):
        program.circuits["other"]
    assert latch.warnings == () and program.warnings == ()


def test_step_wants_each_port_once(latch):
    swarm = latch.swarm()
    for use, message in (
        (lambda: swarm.step(d=1), "missing value of `e`"),
        (lambda: swarm.step(d=1, e=1, f=1), "no input port called `f`; expected one of d, e"),
        (lambda: swarm.step((1,)), "1 values, expected 2: d, e"),
        (lambda: swarm.step(d=2, e=0), "the value of `d` is 2, expected 0 to 1"),
        (lambda: swarm.step(d=1, e=1, cycles=0), "cycles is 0"),
    ):
        with pytest.raises(ValueError, match=message):
            use()
    with pytest.raises(TypeError, match="expected a whole number"):
        swarm.step(d=float("nan"), e=0)
    assert swarm.cycles == 0


def test_every_error_of_a_source_is_in_the_exception(tmp_path):
    with pytest.raises(nbc.NbcError) as caught:
        nbc.loads("circuit f(a) -> (q) { q = b }\ncircuit g(a) -> (q) { q = c }", "two.nb")
    places = [(one.code, one.span.file, one.span.line, one.span.column) for one in caught.value.diagnostics
              if one.severity == "error"]
    assert places == [("unknown", "two.nb", 1, 27), ("unknown", "two.nb", 2, 27)]
    with pytest.raises(nbc.NbcError) as caught:
        nbc.load(tmp_path / "none.nb")
    assert caught.value.diagnostics[0].code == "unreadable" and caught.value.diagnostics[0].span is None


def test_failing_tests_are_results():
    program = nbc.loads(INVERTER + '\ntest inverter "wrong" { a | q\n 0 | 0\n 1 | 0 }')
    (result,) = program.test(level="logic")
    assert not result.passed and [row["passed"] for row in result.rows] == [False, True]
    assert "FAIL" in result.text and "FAIL" in result._repr_html_()
    assert program.test("wrong", level="logic")[0].title == "wrong"
    with pytest.raises(ValueError, match="invalid level `dream`"):
        program.test(level="dream")
    with pytest.raises(KeyError):
        program.test("right")


def test_a_report_is_a_page_with_a_player(tmp_path, root):
    program = nbc.load(root / "circuits/sr_latch.nb")
    report = program.report(tmp_path / "page.html")
    page = (tmp_path / "page.html").read_text()
    assert report.passed and page == report.page and page.startswith("<!") and "<script" in page
    assert report._repr_html_().startswith('<iframe sandbox="allow-scripts" srcdoc=')
    with pytest.raises(nbc.NbcError):
        report.save(tmp_path / "no/folder.html")


def test_evolutions_of_a_file(root):
    runs = nbc.load(root / "library/evolve.nb").evolutions
    assert runs["gates5"].fields["objective"] == "gate" and "gates" in runs
    assert runs["gates7"].shape == (7, 7)


def test_pictures_of_robots():
    robot = nbc.library()[0]
    assert ElementTree.fromstring(robot._repr_svg_()).tag.endswith("svg")


def test_a_compiled_circuit_is_tested_with_its_options(tmp_path):
    program = nbc.loads(INVERTER + '\ntest inverter "turns" { a | q\n 0 | 1 }')
    robot = next(robot for robot in nbc.library() if robot.function == "not")
    source = ROOT / f"library/robots/{robot.name}.yaml"
    (tmp_path / source.name).write_text(source.read_text())
    compiled = program.compile(library=tmp_path)
    seen = []
    compiled.program.test = lambda name, **options: seen.append((name, options))  # type: ignore[method-assign]
    compiled.test(level="physics", effort="fast")
    assert seen == [("inverter", {"library": str(tmp_path), "swarm": None, "objective": "area", "effort": "fast",
                                  "runs": "out", "level": "physics"})]
    del compiled.program.test
    (result,) = compiled.test(level="physics")
    assert result.passed
    (tmp_path / source.name).unlink()
    with pytest.raises(nbc.NbcError):
        compiled.test(level="physics")


def test_gates_of_three_inputs_are_taken_from_their_library():
    text = "circuit all(a, b, c) -> (q) { q = a and b and c }\ntest all for all inputs { q = a and b and c }"
    program = nbc.loads(text)
    compiled = program.circuits["all"].compile(library="three")
    assert [robot["robot"] for robot in compiled.robots] == ["and3_5x5"]
    assert sorted(pin for _, _, pin in compiled.netlist.edges(data="pin")) == [0, 0, 1, 2]
    (result,) = compiled.test(level="physics")
    assert result.passed


def test_a_swarm_takes_the_arrays_that_it_returns(latch):
    first, second = latch.swarm(), latch.swarm()
    first.run([{"d": 1, "e": 1}, (0, 0)], hold=4)
    second.run(first.inputs, hold=1)
    for name in ("inputs", "bits", "outputs", "paths"):
        np.testing.assert_array_equal(getattr(first, name), getattr(second, name))
    assert first.step(first.inputs[0]) == second.step(np.array([1, 1])) == {"q": 1, "nq": 0}
    assert first.step(d=np.bool_(True), e=np.int64(1)).keys() == {"q", "nq"}
    assert first.inputs[-1].tolist() == [True, True]
    with pytest.raises(ValueError, match=r"5 bits, expected 2: d\[1\], e\[1\]"):
        first.step(first.bits[0])
    with pytest.raises(TypeError, match=r"an array of the shape \(16, 2\)"):
        first.step(np.zeros((16, 2), dtype=bool))
    with pytest.raises(TypeError, match="given twice"):
        first.step((1, 0), d=1)
    adder = nbc.loads(ADDER).compile(effort="fast").swarm()
    adder.run([dict(a=1, b=2)], hold=1)
    assert adder.inputs.tolist() == [[False, True, True, False]]
    adder.step(adder.inputs[0])
    assert adder.inputs.tolist() == [[False, True, True, False]] * 2


def test_a_robot_that_fails_has_no_output():
    swarm = "world w { stiffness: 10 }\ncircuit f(a) -> (q) { q = not a }\nswarm s { circuit: f, world: w }\n"
    program = nbc.loads(swarm + "test f {\n a | q\n 1 | 0\n}\nsimulate s with schedule (a) { 1 for 3 cycles }")
    (result,) = program.test()
    assert not result.passed and result.world == "w" and "became unstable in cycle" in result.text
    assert not program.run().passed
    with program.compile().swarm() as live:
        with pytest.raises(nbc.RobotFault, match="became unstable in cycle"):
            live.step(a=1, cycles=50)
        assert live.cycles == len(live.outputs) < 50


LIGHTS = """
circuit lights(car, clk) -> (main, side) {
    turn = register(turn xor car, clk)
    main = not turn
    side = turn
}
prove lights "one is green" { never main and side  always main or side }
prove lights { always car and before(main) => side  never side }
"""


def test_properties_are_proved_or_refuted():
    program = nbc.loads(LIGHTS)
    assert [claim["properties"] for claim in program.claims][0] == ["never main and side", "always main or side"]
    calls = []
    found = program.prove(progress=lambda done, all: calls.append((done, all)))
    assert [one.verdict for one in found] == ["proved", "proved", "proved", "refuted"]
    assert found[0].proved and found[0].method == "induction" and found[0].title == "one is green"
    never = found[3]
    assert (never.statement, never.steps, never.physics, never.line) == ("never side", 2, None, 8)
    assert never.test in never.text.replace("        ", "", 1).replace("\n        ", "\n") and "refuted" in str(never)
    assert program.prove("one is green", seconds=10)[1].proved
    # The circuit passes the test that refutes the property, as logic and with robots.
    (shown,) = nbc.loads(LIGHTS + never.test).test(never.statement, level="logic")
    assert shown.passed
    assert program.circuits["lights"].prove(physics=True)[3].physics is True
    with pytest.raises(KeyError, match="no claim of a circuit or title called `light`; did you mean `lights`"):
        program.prove("light")


def test_a_search_ends_with_its_budget():
    wide = nbc.loads("circuit wide(clk) -> (n[24]) { n = register(n + 1, clk) }\nprove wide { never n == 9000000 }")
    for budget in (dict(work=2000), dict(steps=3, work=100), dict(seconds=0)):
        (found,) = wide.prove(**budget)
        assert found.verdict == "undecided" and found.test is None and not found.proved
    with pytest.raises(ValueError, match="seconds is -1, expected 0 or more"):
        wide.prove(seconds=-1)
    with pytest.raises(nbc.NbcError) as caught:
        nbc.loads("circuit ring(a) -> (q) { q = not q }\nprove ring { never q }").prove()
    (found,) = nbc.loads("circuit c(a) -> (q) { q = a }\nprove c { assume a and not a\n never q }").prove()
    assert found.proved and found.empty == "no step satisfies the assumptions"
    assert caught.value.diagnostics[0].code == "no-steps"
