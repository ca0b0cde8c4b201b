"""Throws values of wrong types, shapes and sizes at every public entry point. Only results and exceptions of Python
are accepted: a crash ends the process, and a panic, which is an `InternalError`, or an exception of no documented type
ends the run.

The same seed makes the same calls. Each call is written to standard error before it is made with ``--trace``, so that
the call of a crash is known.

    python fuzz/entry_points.py [--seed 1] [--seconds 60] [--calls N] [--trace]
"""

from __future__ import annotations

import argparse
import os
import random
import sys
import tempfile
import time
import warnings
from pathlib import Path
from typing import Any, Callable, Dict, List, Tuple

import numpy as np

import nbc
from evogym_points import evogym_points

MEMORY = 4 << 30
ACCEPTED = [ValueError, TypeError, LookupError, OverflowError, OSError, MemoryError, nbc.NbcError]
try:
    # Its own for seeds that are no numbers.
    from gymnasium.error import Error as GymnasiumError

    ACCEPTED.append(GymnasiumError)
except ImportError:
    pass
SOURCE = """
circuit inverter(a) -> (q) { q = not a }
circuit add(a[2], b[2]) -> (s[2]) { s = a + b }
test inverter "turns" { a | q
    0 | 1 }
"""


class Odd:
    """An object whose every use fails, or answers nonsense."""

    def __init__(self, random: random.Random) -> None:
        self.answer = random.choice([None, -1, "x", 2**70, [], ValueError("odd")])

    def _answer(self, *_: Any, **__: Any) -> Any:
        if isinstance(self.answer, Exception):
            raise self.answer
        return self.answer

    __array__ = __dlpack__ = __index__ = __len__ = __getitem__ = __iter__ = __fspath__ = __float__ = _answer


class Maker:
    """Random values, most of them wrong."""

    def __init__(self, seed: int, folder: Path) -> None:
        self.random = random.Random(seed)
        self.folder = folder

    def number(self) -> Any:
        return self.random.choice([
            0, 1, 2, 3, 7, -1, 84, 101, 255, 256, 2**31, 2**32 - 1, 2**63, 2**64, -(2**70), 10**400, 0.5, -0.0, 1e308,
            float("nan"), float("inf"), True, None, "1", b"1", 1j, np.int8(3), np.uint64(2**64 - 1), np.float32(2),
            np.bool_(True), np.array(2), np.array([2]), np.datetime64("2026"), Odd(self.random),
        ])

    def text(self) -> Any:
        return self.random.choice([
            "", "a", "00*1", "01*1 10*1", "00*0", "02*1", "00*1steps", "*", "00*999999999999", "0" * 40 + "*1", "é",
            "\0", "\ud800", "a" * 100_000, "inverter", "invrter", "add", "add[3]", "turns", "logic", "area", "shipped",
            "com", "poses", "gates", "{ } (", "circuit f(a) -> (q) { q = a }", "evolution { from: gates }", SOURCE,
            str(self.folder), str(self.folder / "run.nbc"), str(self.folder / "no/file"), "/dev/null", "/", ".",
            self.folder, b"bytes", np.str_("00*1"), bytearray(b"00*1"),
        ])

    def array(self) -> Any:
        side = lambda: self.random.choice([0, 1, 1, 2, 2, 3, 3, 4, 5, 101])
        shape = tuple(side() for _ in range(self.random.choice([0, 1, 2, 3, 3, 3, 4])))
        made = np.random.default_rng(self.random.randrange(2**32)).integers(-1, 11, size=shape)
        kinds = ["u1", "u1", "u1", "i1", "i8", "u8", "f8", "f2", "?", "c16", "U3", "S2", "O", "M8[s]", ">i4"]
        kind = self.random.choice(kinds)
        made = np.abs(made).astype(kind) if kind != "S2" else np.abs(made).astype("U2").astype(kind)
        change = self.random.choice([np.asarray, np.asarray, np.asfortranarray, lambda a: a.T,
                                     np.ma.array, lambda a: a.tolist()])
        return change(np.asarray(made))

    def body(self) -> Any:
        rows = [[["333"]], [["343", "563"]], [["30", "03"]], [["3", "33"]], [["z"]], [["9!"]], [[""]], [[]], [],
                [[[3]]], [["333"], None], [["333"], np.full((2, 2), 3)], list(nbc.library()[:1]), ["333"], "333"]
        return self.random.choice([self.random.choice(rows), self.array(), self.array(), self.any(1)])

    def material(self) -> Dict[Any, Any]:
        keys = ["name", "kind", "period", "phase", "range", "stimulus", "absent", "present", "x", 3, None, ("a",)]
        words = ["a", "b", "rigid", "soft", "actuator", "sensor", "stone"]
        made = {"name": self.random.choice(words), "kind": self.random.choice(words[2:])}
        for _ in range(self.random.randrange(6)):
            made[self.random.choice(keys)] = self.random.choice([self.number(), [0.6, 1.6], 84, 1, 0.0, self.text()])
        return made

    def materials(self) -> Any:
        made = [self.material() for _ in range(self.random.randrange(4))]
        return self.random.choice([made, made, None, nbc.PAPER_MATERIALS, self.any(1)])

    def any(self, depth: int = 2) -> Any:
        make = [self.number, self.text, self.array, lambda: Odd(self.random), lambda: None]
        if depth:
            make += [lambda: [self.any(depth - 1) for _ in range(self.random.randrange(4))],
                     lambda: (self.any(depth - 1), self.any(depth - 1)),
                     lambda: {self.random.choice(["a", "b", "q", 1]): self.any(depth - 1)}]
        return self.random.choice(make)()

    def some(self, *usual: Any) -> Any:
        """Mostly one of the usual values, so that the call gets further than its first check."""
        return self.random.choice(usual) if self.random.random() < 0.6 else self.any()

    def options(self, **choices: Callable[[], Any]) -> Dict[str, Any]:
        return {name: make() for name, make in choices.items() if self.random.random() < 0.4}


def entry_points(make: Maker) -> List[Tuple[str, Callable[[], Any]]]:
    """Every public entry point with random arguments."""
    some, options, folder = make.some, make.options, make.folder
    run = nbc.Evolution(shape=(2, 3), batch=2, generations=2, fixed="1 cycles")
    program = nbc.loads(SOURCE)
    compiled = program.compile("inverter", effort="fast")
    world = dict(materials=make.materials, world_width=lambda: some(500, 60), start_x=lambda: some(None, 1))
    compiling = dict(library=lambda: some(None, "shipped"), swarm=lambda: some(None), objective=lambda: some("area"),
                     effort=lambda: some("fast"), runs=lambda: some("out"))
    spells = [("00", 1), ("01", 3)]
    callback = lambda: some(False, True, lambda done, all: None)

    def flock() -> None:
        with nbc.Flock([["343", "563"], ["333"]]) as flock:
            flock.advance(some("00", ["01", "10"], np.zeros((2, 2), dtype=int)), some(1, 2))
            flock.voxels(some(0))
            flock.restore(some(flock.snapshot()))

    def search() -> None:
        search = nbc.Search(some(run), some(1))
        candidates = search.ask()
        result = search.evaluate(some(candidates))
        search.tell(some(candidates), some(result))
        search.archive.heatmap(some("voxels"), some("behavior"))
        search.save(some(folder / "run.nbc"))

    def told() -> None:
        search = nbc.Search(run)
        candidates = search.ask()
        size = len(candidates)
        search.tell(candidates, nbc.Evaluation(
            some(np.full(size, "measured"), ["faulty"] * size), some(np.ones((size, 2))), some(np.ones((size, 4))),
            some(np.full(size, "RRRL"), [""] * size)))
        search.step()

    def swarm() -> None:
        with compiled.swarm() as swarm:
            swarm.step(some((1,), {"a": 1}, np.array([True])), cycles=some(1))
            swarm.run(some([(1,)], np.zeros((1, 1), dtype=bool)), hold=some(1))

    return [
        ("simulate", lambda: nbc.simulate(make.body(), some("00*1", spells), record=some("com", "poses", None),
                                          stride=some(1, 12), progress=callback(), **options(**world))),
        ("Flock", lambda: nbc.Flock(make.body(), **options(**world)).advance(make.any(), make.number())),
        ("a flock", flock),
        ("evaluate", lambda: nbc.evaluate(make.body(), some(run))),
        ("invalid", lambda: nbc.invalid(make.body(), materials=make.materials())),
        ("rows", lambda: nbc.rows(make.any())),
        ("Evolution", lambda: nbc.Evolution(**options(
            shape=lambda: some((2, 3)), base=lambda: some("gates"), name=lambda: some("e"), batch=make.number,
            generations=make.number, newcomers=make.number, objective=lambda: some("gate"), symmetry=make.text,
            niche=make.text, fixed=lambda: some("1 cycles"), descriptors=lambda: some(["behavior"]), rules=make.text,
            vary=lambda: some({"friction": 0.1}, {"all": make.number()}), worlds=make.number, box=make.any))),
        ("Evolution.parse", lambda: nbc.Evolution.parse(make.text(), some("file"))),
        ("Search", search),
        ("tell", told),
        ("Search.resume", lambda: nbc.Search.resume(make.text(), some(run))),
        ("evolve", lambda: nbc.evolve(some(run), seed=some(1), generations=some(0, 1), progress=callback(),
                                      checkpoint=some(None, folder / "run.nbc"), checkpoint_every=some(0, 60.0))),
        ("read_archive", lambda: nbc.read_archive(make.text())),
        ("load", lambda: nbc.load(make.text())),
        ("loads", lambda: nbc.loads(make.text(), some("a.nb"))),
        ("compile", lambda: program.compile(some("inverter"), **options(**compiling))),
        ("circuits", lambda: program.circuits[make.text()].compile(**options(**compiling))),
        ("test", lambda: program.test(some("turns", None), level=some("logic"), **options(**compiling))),
        ("report", lambda: program.report(some(folder / "no/page.html"), safe_colors=some(True))),
        ("schematic", lambda: compiled.schematic(safe_colors=make.any())),
        ("graph", lambda: compiled.graph(as_written=make.any())),
        ("a swarm", swarm),
        ("set_threads", lambda: nbc.set_threads(some(2))),
        ("to_structure", lambda: nbc.evogym.to_structure(make.any(), as_actuators=make.any())),
        ("from_structure", lambda: nbc.evogym.from_structure(make.any(), some(None))),
        ("actions", lambda: nbc.evogym.actions(some(["345"]), some("00*1", spells))),
        *evogym_points(make),
    ]


def fuzz(seed: int, seconds: float, calls: int, trace: bool) -> Dict[str, int]:
    """Makes calls until the time is over, and returns how many came to each end."""
    limit_memory()
    warnings.simplefilter("ignore")
    ends: Dict[str, int] = {}
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)  # Some of the texts are paths to be written.
        make = Maker(seed, Path(folder))
        points, stop, made = entry_points(make), time.monotonic() + seconds, 0
        while made < calls and time.monotonic() < stop:
            name, call = make.random.choice(points)
            made += 1
            if trace:
                print(made, name, file=sys.stderr, flush=True)
            try:
                call()
                end = "result"
            except Exception as error:
                if isinstance(error, nbc.InternalError) or not isinstance(error, tuple(ACCEPTED)):
                    print(f"seed {seed}, call {made}: {name}", file=sys.stderr)
                    raise
                end = type(error).__name__
            ends[end] = ends.get(end, 0) + 1
    return ends


def limit_memory() -> None:
    """A call that asks for too much memory fails instead of taking the machine down."""
    try:
        import resource
    except ImportError:
        return
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, resource.getrlimit(resource.RLIMIT_AS)[1]))


def main() -> None:
    """Fuzzes, and prints how the calls ended."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=60)
    parser.add_argument("--calls", type=int, default=10**9)
    parser.add_argument("--trace", action="store_true")
    arguments = parser.parse_args()
    for end, count in sorted(fuzz(**vars(arguments)).items(), key=lambda item: -item[1]):
        print(f"{count:8} {end}")


if __name__ == "__main__":
    main()
