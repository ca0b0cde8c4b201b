"""Circuits: from source files to swarms of robots, their tests, timing and pictures."""

from __future__ import annotations

import html
import json
import os
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Dict, Iterable, List, Mapping, Optional, Sequence, Tuple, TypedDict, Union

import numpy as np
import numpy.typing as npt

from . import _nbc
from .closing import Closing
from .errors import Diagnostic, Interrupted, diagnostics_of
from .evolution import Evolution
from .names import Effort, Level, Objective, unknown
from .numbers import amount, array_of, count, is_array
from .progress import Progress, reporting
from .result import Judged, Result

if TYPE_CHECKING:
    from typing_extensions import Unpack

__all__ = [
    "Circuit",
    "Compiled",
    "Hardened",
    "Port",
    "Program",
    "Property",
    "Report",
    "Swarm",
    "TestResult",
    "Yield",
    "load",
    "loads",
]

Path = Union[str, "os.PathLike[str]"]
Row = Union[Mapping[str, int], Sequence[int], npt.NDArray[Any]]


class _Compiling(TypedDict, total=False):
    library: Optional[Path]
    swarm: Optional[str]
    objective: Objective
    effort: Effort
    runs: Path


class _Testing(_Compiling, total=False):
    level: Optional[Level]
    progress: Progress


class _Proving(_Compiling, total=False):
    steps: int
    work: int
    seconds: float
    physics: bool
    progress: Progress


class _Running(_Compiling, total=False):
    safe_colors: bool
    progress: Progress


@dataclass(frozen=True)
class Port:
    """An input or output port with its width in bits."""

    name: str
    width: int


class TestResult(Judged):
    """The verdict of a test, for one swarm in one world or at the level of logic.

    ``text`` is the truth table with expected and observed outputs, and the failures.
    """

    __test__ = False  # pytest would collect the class for its name.

    circuit: str
    title: str
    passed: bool
    level: str
    """``logic`` or ``physics``."""
    swarm: Optional[str]
    """The declared swarm that was tested, if there is one."""
    world: Optional[str]
    """The world of the swarm; None at the level of logic."""
    file: str
    line: int
    rows: Tuple[Mapping[str, Any], ...]
    """The rows: ``inputs``, ``expected``, ``observed``, ``passed``, ``cycles``, ``line``, and the robots at fault."""
    warnings: Tuple[Diagnostic, ...]

    def _is_good(self) -> bool:
        return self.passed


class Property(Judged):
    """A property of all steps of a circuit, and what is known of it.

    ``text`` is all of this in lines, as ``nbc prove`` prints it.
    """

    circuit: str
    title: str
    verdict: str
    """``proved``, ``refuted`` or ``undecided``."""
    how: str
    """What the verdict is based on."""
    method: Optional[str] = None
    """What proves it: ``induction`` or ``invariant``."""
    steps: Optional[int] = None
    """The steps of the induction or of the run that refutes it, or the first steps in which it is known to hold."""
    invariant: Tuple[str, ...] = ()
    """The clauses that hold in every step, if an invariant proves it."""
    empty: Optional[str] = None
    """Why the proof says nothing: nothing is ever checked."""
    test: Optional[str] = None
    """The test whose last row violates it, as text."""
    physics: Optional[bool] = None
    """Whether robots do what the test shows, if they were asked."""
    file: str
    line: int

    @property
    def statement(self) -> str:
        """As it is written."""
        return str(self.report["property"])

    @property
    def proved(self) -> bool:
        """Whether it holds in every step."""
        return self.verdict == "proved"

    def _is_good(self) -> bool:
        return self.proved


class Yield(Result):
    """In how many worlds of a sample a test passes."""

    circuit: str
    title: str
    swarm: Optional[str]
    """The declared swarm that was tested, if there is one."""
    robots: int
    """The number of its robots."""
    variation: Mapping[str, float]
    """The largest changes of the worlds."""
    fails_first: Tuple[Mapping[str, Any], ...]
    """The robots that fail first, those of most worlds first: ``net``, ``robot``, ``worlds``."""
    failures: Tuple[Mapping[str, Any], ...]
    """The worlds in which the test fails: ``world``, ``physics``, ``row``, ``line``, ``first``, ``fault``."""

    @property
    def vary(self) -> Mapping[str, float]:
        """The largest changes of the worlds."""
        return self.variation

    @property
    def passed(self) -> int:
        """The number of worlds in which the test passes."""
        return int(self.report["yield"]["passed"])

    @property
    def worlds(self) -> int:
        """The number of worlds."""
        return int(self.report["yield"]["worlds"])

    @property
    def interval(self) -> Tuple[float, float]:
        """The 95 % interval of the share of worlds in which it passes."""
        return self.report["yield"]["low"], self.report["yield"]["high"]

    @property
    def share(self) -> float:
        """The share of worlds in which the test passes."""
        return self.passed / self.worlds


class Hardened(Result):
    """The robots to leave out of a swarm, so that its tests pass in more worlds.

    ``text`` is what to write in the library.
    """

    without: Tuple[str, ...]
    """The names of the robots to leave out."""
    reached: bool
    """Whether the tests then pass in enough worlds."""
    tried: Tuple[Mapping[str, Any], ...]
    """The choices in their order: ``without``, ``robots``, ``yield``, ``fails_first``."""


@dataclass(frozen=True)
class Report:
    """The page of a run: every swarm with its verdict, schematic, spacetime diagram and a player."""

    results: Tuple[TestResult, ...]
    page: str = field(repr=False)
    """The page, one self-contained HTML text."""
    passed: bool
    """Whether all tests passed, and no robot of a simulation failed."""

    def save(self, path: Path) -> None:
        """Writes the page, whole or not at all."""
        _nbc.write_file(os.fspath(path), self.page)

    def _repr_html_(self) -> str:
        page = html.escape(self.page, quote=True)
        return f'<iframe sandbox="allow-scripts" srcdoc="{page}" style="width:100%;height:720px;border:0"></iframe>'


class Program:
    """A source file without errors: its circuits, tests and evolutions.

    A copy, also one for another process, reads the file again.
    """

    def __init__(self, path: str, text: Optional[str]) -> None:
        self.path = path
        """The path that was given."""
        self._text = text
        self._native = _nbc.Program(path, text, False)

    @property
    def warnings(self) -> Tuple[Diagnostic, ...]:
        """Its warnings."""
        return diagnostics_of(json.loads(self._native.diagnostics()))

    @property
    def circuits(self) -> Mapping[str, Circuit]:
        """The circuits of the file itself by name. ``circuits["adder[8]"]`` is an instance of a circuit with
        parameters."""
        return _Circuits({name: Circuit(self, name) for name in self._names()})

    @property
    def evolutions(self) -> Mapping[str, Evolution]:
        """The evolutions by name, those of the prelude included."""
        return _Evolutions({name: Evolution._of(native) for name, native in self._native.evolutions()})

    @property
    def images(self) -> Mapping[str, npt.NDArray[np.float64]]:
        """The sets of images by name, values from 0 to 1, shape (N, rows, columns) each."""
        return dict(self._native.images())

    @property
    def tests(self) -> Tuple[Mapping[str, Any], ...]:
        """The declared tests: ``circuit``, ``title``, ``file``, ``line`` and ports of each."""
        return tuple(json.loads(self._native.tests()))

    @property
    def claims(self) -> Tuple[Mapping[str, Any], ...]:
        """What is claimed of its circuits: ``circuit``, ``title``, ``file``, ``line`` and ``properties`` of each
        ``prove`` declaration."""
        claims = json.loads(self._native.claims())
        return tuple({**one, "properties": [each["property"] for each in one["properties"]]} for one in claims)

    def compile(
        self,
        circuit: Optional[str] = None,
        *,
        library: Optional[Path] = None,
        swarm: Optional[str] = None,
        objective: Objective = "area",
        effort: Effort = "normal",
        runs: Path = "out",
    ) -> Compiled:
        """Compiles a circuit to a swarm of robots, and proves that the swarm's logic is equal to the source.

        Args:
            circuit: its name, by default the last one of the file.
            library: a folder of robot files, ``shipped`` or ``three``; by default what the file declares.
            swarm: a declared swarm, if there are several for the circuit.
            objective: what mapping minimizes: ``area``, ``delay``, or the risk of a thin ``margin`` or of other worlds
                (``sturdy``).
            effort: ``fast`` or ``normal``.
            runs: the folder of evolution runs that the file's libraries may be from.

        Raises:
            NbcError: when the circuit cannot be built, or the library lacks a gate.
        """
        options = _options(library, swarm, objective, effort, runs)
        return Compiled(self, self._native.compile(circuit, options), circuit, options)

    def test(
        self,
        name: Optional[str] = None,
        *,
        level: Optional[Level] = None,
        progress: Progress = False,
        **options: Unpack[_Compiling],
    ) -> List[TestResult]:
        """Runs the tests of the file, each once for each swarm that is declared for its circuit.

        Args:
            name: only tests of this circuit or title.
            level: ``logic`` or ``physics``; by default physics for swarms of fewer than 40 robots.
            progress: whether to show a tqdm bar, or a function of the cycles done and all cycles of a swarm.

        The other arguments are those of `compile`. A test that fails is a result, not an exception.

        Raises:
            KeyError: when no test has that name.
            Interrupted: on Ctrl-C, with the results of the tests before.
        """
        compiling = _options(**options)
        chosen = self._chosen(name)
        results: List[TestResult] = []
        try:
            for number in chosen:
                results += self._test(number, level, progress, compiling)
        except KeyboardInterrupt:
            raise Interrupted(results) from None
        return results

    def prove(
        self,
        name: Optional[str] = None,
        *,
        steps: int = 10_000,
        work: int = 50_000_000,
        seconds: float = 60.0,
        physics: bool = False,
        progress: Progress = False,
        **options: Unpack[_Compiling],
    ) -> List[Property]:
        """Decides the properties that the file claims of its circuits, for all inputs and for ever, as ``nbc prove``
        does.

        Args:
            name: only what is claimed of this circuit, or under this title.
            steps: the most steps that are looked at one after the other.
            work: the most work for each claim, in calls of the solver, clauses that it learns, and
                hundreds of values that it derives.
            seconds: the most time for each claim.
            physics: whether to run each test that refutes a property with robots.
            progress: whether to show a tqdm bar, or a function of the properties that are decided and all properties.

        The other arguments are those of `compile`, for the robots. A property that is refuted is a result, not an
        exception.

        Raises:
            KeyError: when nothing is claimed under that name.
            NbcError: when a circuit has no steps.
            Interrupted: on Ctrl-C, with the properties of the claims before.
        """
        compiling = _options(**options)
        budget = (count(steps, "steps"), count(work, "work", most=2**64 - 1), amount(seconds, "seconds"))
        results: List[Property] = []
        try:
            for number in _numbers_of("claim", self.claims, name):
                with reporting(progress, " properties") as report:
                    found = json.loads(self._native.prove(number, budget, physics, compiling, report))
                results += _properties(found["data"], found["texts"])
        except KeyboardInterrupt:
            raise Interrupted(results) from None
        return results

    def yields(
        self,
        name: Optional[str] = None,
        *,
        vary: Union[str, Sequence[str]] = "10%",
        worlds: int = 100,
        times: Sequence[float] = (1.0,),
        seed: int = 1,
        progress: Progress = False,
        **options: Unpack[_Compiling],
    ) -> List[Yield]:
        """Runs the tests of the file in physics in samples of worlds, as ``nbc test --worlds`` does.

        Args:
            name: only tests of this circuit or title.
            vary: the largest changes of the worlds, such as ``friction=10%,gravity=5%``; ``10%`` alone is that of all
                factors. Each of several is a sample of its own.
            worlds: the number of worlds of each sample.
            times: the changes times each of these numbers are samples of their own.
            seed: the seed of the worlds.

        The other arguments are those of `test`.

        Raises:
            KeyError: when no test has that name.
            Interrupted: on Ctrl-C, with the yields that are complete.
        """
        compiling = _options(**options)
        sampling = _sampling([vary] if isinstance(vary, str) else vary, times, worlds, seed)
        with reporting(progress, " cycles") as report:
            try:
                return _yields(self._native.yields(self._chosen(name), sampling, compiling, report))
            except Interrupted as interrupt:
                interrupt.result = _yields(interrupt.result)
                raise

    def harden(
        self,
        circuit: Optional[str] = None,
        *,
        vary: str = "20%",
        worlds: int = 40,
        seed: int = 1,
        least_yield: float = 0.95,
        progress: Progress = False,
        **options: Unpack[_Compiling],
    ) -> Hardened:
        """Finds the robots to leave out of a circuit's swarm, as ``nbc build --harden`` does.

        The robots that fail first in other worlds are left out one by one, until the tests of the circuit pass in
        enough worlds.

        Args:
            circuit: its name, by default the last one of the file.
            vary: the largest changes of the worlds, as in `yields`.
            worlds: the number of worlds.
            seed: the seed of the worlds.
            least_yield: the share of worlds in which each test must pass.

        The other arguments are those of `compile`.

        Raises:
            NbcError: when the circuit has no test.
        """
        compiling = _options(**options)
        least = amount(least_yield, "least_yield", most=1.0)
        sampling = _sampling([vary], [1.0], worlds, seed)
        with reporting(progress, " cycles") as report:
            found = json.loads(self._native.harden(circuit, sampling, least, compiling, report))
        return Hardened(found["data"], found["text"])

    def run(
        self,
        *,
        safe_colors: bool = False,
        progress: Progress = False,
        **options: Unpack[_Compiling],
    ) -> Report:
        """Runs every test and simulation of the file in physics, and makes the page of ``nbc run``.

        Args:
            safe_colors: whether to use colors that people with any color vision can tell apart.

        The other arguments are those of `test`.
        """
        compiling = _options(**options)
        recorded = _nbc.Program(self.path, self._text, True)
        with reporting(progress, " cycles") as report:
            try:
                return _report(*recorded.run(compiling, safe_colors, report))
            except Interrupted as interrupt:
                interrupt.result = _report(*interrupt.result)
                raise

    def report(self, path: Path, **options: Unpack[_Running]) -> Report:
        """Runs the file as `run` does, and writes the page."""
        _check_path(path)
        report = self.run(**options)
        report.save(path)
        return report

    def __reduce__(self) -> Any:
        return Program, (self.path, self._text)

    def _chosen(self, name: Optional[str]) -> List[int]:
        """The numbers of the tests of that name."""
        return _numbers_of("test", self.tests, name)

    def _names(self) -> List[str]:
        return self._native.circuits()

    def _test(
        self, number: int, level: Optional[str], progress: Progress, compiling: Optional[_nbc._Options] = None
    ) -> List[TestResult]:
        with reporting(progress, " cycles") as report:
            records = self._native.test(number, level, compiling or _options(), report)
        return [_result(record) for record in json.loads(records)]

    def __repr__(self) -> str:
        return f"<Program {self.path}: {', '.join(self._names()) or 'no circuits'}>"


class _Circuits(Dict[str, "Circuit"]):
    """Circuits by name; instances of circuits with parameters are made on demand."""

    def __missing__(self, name: str) -> Circuit:
        base = self.get(str(name).split("[")[0])
        if base is None:
            raise KeyError(unknown("circuit", name, self))
        return Circuit(base.program, name)


class _Evolutions(Dict[str, Evolution]):
    """Evolutions by name."""

    def __missing__(self, name: str) -> Evolution:
        raise KeyError(unknown("evolution", name, self))


class Circuit:
    """A circuit of a program."""

    def __init__(self, program: Program, name: str) -> None:
        self.program = program
        """Its program."""
        self.name = name
        """Its name."""

    def compile(self, **options: Unpack[_Compiling]) -> Compiled:
        """Compiles it; see `Program.compile`."""
        return self.program.compile(self.name, **options)

    def test(self, **options: Unpack[_Testing]) -> List[TestResult]:
        """Runs its tests; see `Program.test`."""
        return self.program.test(self.name, **options)

    def prove(self, **options: Unpack[_Proving]) -> List[Property]:
        """Decides what is claimed of it; see `Program.prove`."""
        return self.program.prove(self.name, **options)

    def __repr__(self) -> str:
        return f"<Circuit {self.name} of {self.program.path}>"


class Compiled:
    """A circuit compiled to a swarm of robots. In a notebook it is shown as its schematic."""

    def __init__(
        self, program: Program, native: _nbc.Compiled, circuit: Optional[str], options: Mapping[str, Any]
    ) -> None:
        self.program = program
        """Its program."""
        self._native, self._circuit, self._options = native, circuit, dict(options)
        summary = json.loads(native.summary())
        self.name: str = summary["circuit"]
        """The circuit's name."""
        self.swarm_name: Optional[str] = summary["swarm"]
        """The declared swarm, if there is one."""
        self.inputs: Tuple[Port, ...] = tuple(Port(port["name"], port["width"]) for port in summary["inputs"])
        """The input ports."""
        self.outputs: Tuple[Port, ...] = tuple(Port(port["name"], port["width"]) for port in summary["outputs"])
        """The output ports."""
        self.robots: Tuple[Mapping[str, Any], ...] = tuple(summary["robots"])
        """The robots: the net that each drives, its name, function, behavior, body and materials."""
        self.warnings: Tuple[Diagnostic, ...] = diagnostics_of(summary["warnings"])
        """Warnings, for example about robots that make errors."""
        self._window = int(summary["window"])

    @property
    def timing(self) -> Mapping[str, Any]:
        """Static timing in cycles: ``hold``, ``critical_path``, ``robots`` (arrival, required, slack, fan-out), and
        ``memory`` (pulse, set-up and hold of latches)."""
        timing: Mapping[str, Any] = json.loads(self._native.timing())
        return timing

    @property
    def netlist(self) -> Any:
        """The netlist of robots as a networkx MultiDiGraph; see `graph`."""
        return self.graph()

    def graph(self, *, as_written: bool = False) -> Any:
        """The netlist as a networkx MultiDiGraph.

        A node is a port, a constant or a cell, with the attributes ``net`` (its name), ``kind`` and ``function``. An
        edge runs from a driver to a listener, with the attribute ``pin``.

        Args:
            as_written: the netlist of the source, before it is mapped to robots.
        """
        import networkx

        record = json.loads(self._native.netlist(as_written))
        graph = networkx.MultiDiGraph(name=record["name"])
        for node in record["nodes"]:
            graph.add_node(node.pop("id"), **node)
        graph.add_edges_from((driver, listener, {"pin": pin}) for driver, listener, pin in record["edges"])
        return graph

    def schematic(self, *, safe_colors: bool = False) -> str:
        """The circuit with its robots as gates, as SVG."""
        return self._native.schematic(safe_colors)

    def swarm(self) -> Swarm:
        """A swarm at its start."""
        return Swarm(self)

    def test(self, **options: Unpack[_Testing]) -> List[TestResult]:
        """Runs the circuit's tests with the options that it was compiled with; see `Program.test`."""
        return self.program.test(self.name, **{**self._options, **options})

    def report(self, path: Path, **options: Unpack[_Running]) -> Report:
        """Runs the program with the options that this circuit was compiled with, and writes the page; see
        `Program.report`."""
        return self.program.report(path, **{**self._options, **options})

    def __reduce__(self) -> Any:
        return _compiled_again, (self.program, self._circuit, self._options)

    def _repr_svg_(self) -> str:
        return self.schematic()

    def __repr__(self) -> str:
        return f"<Compiled {self.name}: {len(self.robots)} robots>"


class Swarm(Closing):
    """A swarm in full physics, simulated cycle by cycle. In a notebook it is shown in space and time.

    There is ground for a thousand cycles. If Ctrl-C ends a call, the cycle that is being simulated is completed.

    >>> import nbc
    >>> inverter = nbc.loads("circuit inverter(a) -> (q) { q = not a }").compile()
    >>> with inverter.swarm() as swarm:
    ...     swarm.run([{"a": 1}, {"a": 0}])
    [{'q': 0}, {'q': 1}]
    """

    def __init__(self, compiled: Compiled) -> None:
        self.compiled = compiled
        """The compiled circuit."""
        self._native: _nbc.Swarm = compiled._native.swarm()

    def step(self, values: Optional[Row] = None, *, cycles: int = 1, **ports: int) -> Dict[str, int]:
        """Simulates cycles with these values on the input ports, and returns those of the output ports.

        Args:
            values: a mapping from port to value, or values in the order of the ports; or name the ports:
                ``step(d=1, e=0)``. The value of a bus is a whole number. An array of booleans has the bits of all
                ports, as a row of `inputs`.
            cycles: how many cycles the values are held.

        Raises:
            ValueError: for missing or unknown ports, values that do not fit, and more cycles than a swarm keeps.
            RobotFault: when the simulation of a robot fails.
        """
        if values is not None and ports:
            raise TypeError("the values are given twice; name the ports, or give one mapping or sequence")
        row = self._row(ports if values is None else values)
        outputs = self._native.step([row], count(cycles, "cycles", least=1), None)
        return self._values(self.compiled.outputs, outputs[-1])

    def run(
        self, rows: Iterable[Row], *, hold: Optional[int] = None, progress: Progress = False
    ) -> List[Dict[str, int]]:
        """Holds each row of input values until all robots have settled, and returns the outputs at its end.

        Args:
            rows: the values of the input ports; see `step`.
            hold: cycles of each row; by default those of static timing, and two more.
            progress: whether to show a tqdm bar, or a function of the cycles done and all cycles.

        Raises:
            RobotFault: when the simulation of a robot fails.
        """
        held = int(self.compiled.timing["hold"]) + self.compiled._window + 1 if hold is None else hold
        each = count(held, "hold", least=1)
        packed = [self._row(row) for row in (array_of(rows) if is_array(rows) else rows)]
        with reporting(progress, " cycles") as report:
            outputs = self._native.step(packed, each, report)
        return [self._values(self.compiled.outputs, row) for row in outputs]

    @property
    def cycles(self) -> int:
        """Cycles done."""
        return self._native.cycles()

    @property
    def inputs(self) -> npt.NDArray[np.bool_]:
        """The bits of the input ports in each cycle, shape (cycles, bits): port after port, high bits first.
        ``run(inputs, hold=1)`` repeats them."""
        return self._native.bits()[0]

    @property
    def bits(self) -> npt.NDArray[np.bool_]:
        """The output of each robot at the end of each cycle, shape (cycles, robots)."""
        return self._native.bits()[1]

    @property
    def outputs(self) -> npt.NDArray[np.bool_]:
        """The bits of the output ports at the end of each cycle, shape (cycles, bits), in the order of `inputs`."""
        return self._native.bits()[2]

    @property
    def paths(self) -> npt.NDArray[np.float64]:
        """Horizontal places of the robots' centers of mass in voxels, shape (robots, 12 * cycles + 1)."""
        return self._native.paths()[0]

    def spacetime(self) -> str:
        """Each robot's path with its stimuli, as SVG."""
        return self._native.spacetime()

    def reset(self) -> None:
        """Starts again."""
        self._native.close()
        self._native = self.compiled._native.swarm()

    def _row(self, row: Row) -> List[bool]:
        ports = self.compiled.inputs
        if is_array(row):
            array = array_of(row)
            if array.dtype == np.bool_ and array.ndim == 1:
                return self._bits(array)
            row = array.tolist() if array.ndim == 1 else row
        if not isinstance(row, Mapping):
            if isinstance(row, (str, bytes)) or not isinstance(row, Sequence):
                shown = f"an array of the shape {array_of(row).shape}" if is_array(row) else f"a {type(row).__name__}"
                raise TypeError(f"the values are {shown}, expected a mapping, or a value for each port")
            if len(row) != len(ports):
                raise ValueError(f"{len(row)} values, expected {len(ports)}: {', '.join(port.name for port in ports)}")
            row = {port.name: value for port, value in zip(ports, row)}
        strange = set(row) - {port.name for port in ports}
        missing = [port.name for port in ports if port.name not in row]
        if strange or missing:
            known = [port.name for port in ports]
            if strange:
                raise ValueError(unknown("input port", min(map(str, strange)), known))
            raise ValueError(f"missing value of `{missing[0]}`; the input ports are {', '.join(known)}")
        bits: List[bool] = []
        for port in ports:
            value = count(row[port.name], f"the value of `{port.name}`", most=2**port.width - 1)
            bits += [bool(value >> bit & 1) for bit in reversed(range(port.width))]
        return bits

    def _bits(self, row: npt.NDArray[np.bool_]) -> List[bool]:
        expected = sum(port.width for port in self.compiled.inputs)
        if len(row) != expected:
            ports = ", ".join(f"{port.name}[{port.width}]" for port in self.compiled.inputs)
            raise ValueError(f"{len(row)} bits, expected {expected}: {ports}")
        return [bool(bit) for bit in row]

    @staticmethod
    def _values(ports: Sequence[Port], bits: Sequence[bool]) -> Dict[str, int]:
        values, rest = {}, list(bits)
        for port in ports:
            own, rest = rest[: port.width], rest[port.width :]
            values[port.name] = int("".join("1" if bit else "0" for bit in own), 2)
        return values

    def _repr_svg_(self) -> Optional[str]:
        return self.spacetime() if self.cycles else None


def load(path: Path) -> Program:
    """Reads and checks a source file.

    Raises:
        NbcError: when it cannot be read or has errors; its diagnostics have all of them with their places.
    """
    return Program(os.fspath(path), None)


def loads(text: str, path: str = "program.nb") -> Program:
    """Checks a source text as if it were in a file of that path.

    >>> import nbc
    >>> try:
    ...     nbc.loads("circuit f(a) -> (q) { q = b }")
    ... except nbc.NbcError as error:
    ...     print(error.diagnostics[0].code, error.diagnostics[0].span)
    unknown program.nb:1:27
    """
    return Program(path, text)


def _sampling(vary: Sequence[str], times: Sequence[float], worlds: int, seed: int) -> Dict[str, Any]:
    """A sample of worlds for the native half."""
    if not vary or not times:
        raise ValueError("vary and times need a value at least")
    return {
        "vary": [str(changes) for changes in vary],
        "times": [amount(factor, "times", most=1000.0) for factor in times],
        "worlds": count(worlds, "worlds", least=1),
        "seed": count(seed, "seed", most=2**64 - 1),
    }


def _numbers_of(what: str, declared: Sequence[Mapping[str, Any]], name: Optional[str]) -> List[int]:
    """The numbers of the declarations of that circuit or title."""
    known = [(one["circuit"], one["title"]) for one in declared]
    chosen = [number for number, names in enumerate(known) if name is None or name in names]
    if name is not None and not chosen:
        words = [word for names in known for word in names if word]
        raise KeyError(unknown(f"{what} of a circuit or title", name, dict.fromkeys(words)))
    return chosen


def _properties(claim: Mapping[str, Any], texts: Sequence[str]) -> List[Property]:
    """The properties of a claim."""
    of_claim = {"circuit": claim["circuit"], "title": claim.get("title", ""), "file": claim["file"]}
    return [Property(known, text, **of_claim) for known, text in zip(claim["properties"], texts)]


def _yields(records: str) -> List[Yield]:
    """The yields of the native half."""
    return [Yield(record["data"], record["text"]) for record in json.loads(records)]


def _options(
    library: Optional[Path] = None,
    swarm: Optional[str] = None,
    objective: Objective = "area",
    effort: Effort = "normal",
    runs: Path = "out",
) -> Dict[str, Any]:
    return {
        "library": None if library is None else os.fspath(library),
        "swarm": swarm,
        "objective": objective,
        "effort": effort,
        "runs": os.fspath(runs),
    }


def _compiled_again(program: Program, circuit: Optional[str], options: Mapping[str, Any]) -> Compiled:
    return program.compile(circuit, **options)


def _check_path(path: Path) -> None:
    """Raises NbcError if a file cannot be written, before anything is simulated for it."""
    where = os.fspath(path)
    folder = os.path.dirname(where) or os.curdir
    if os.path.isdir(where) or not os.access(folder, os.W_OK):
        _nbc.write_file(where, "")


def _report(page: str, records: str, passed: bool) -> Report:
    return Report(tuple(_result(record) for record in json.loads(records)), page, passed)


def _result(record: Mapping[str, Any]) -> TestResult:
    return TestResult(record["data"], record["text"], warnings=diagnostics_of(record["warnings"]))
