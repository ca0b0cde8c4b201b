"""Eyes in front, gates behind: bodies that see digits are eyes, and a circuit is learned from what they say.

An eye sees an image from a fresh start for one cycle of a swarm. Its bit is 1 if it walked to the right. The arguments
are the folders of runs whose bodies are taken, such as out/seeds/seed-1; without any, a short run is made.
"""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import List, Sequence

import numpy as np
import numpy.typing as npt
from sklearn import datasets

import nbc

SHORT = os.environ.get("NBC_EXAMPLE") == "short"
SEEING = Path(__file__).resolve().parents[2] / "library" / "seeing.nb"
CYCLE = 84

digits = datasets.load_digits()
images, labels = digits.images / 16, digits.target
if SHORT:
    images, labels = images[:120], labels[:120]
numbers = np.arange(len(labels))
training = np.flatnonzero(numbers % 5 != 0)
# The searches have seen some of the first hundred.
held_out = np.flatnonzero((numbers % 5 == 0) & (numbers >= 100))


def archives() -> List[nbc.Archive]:
    """Those of the runs, or a small one."""
    if sys.argv[1:]:
        return [nbc.read_archive(Path(run) / "checkpoint.nbc") for run in sys.argv[1:]]
    search = nbc.Search(nbc.load(SEEING).evolutions["zeros_and_ones"], seed=1)
    search.step()
    return [search.archive]


def look(bodies: Sequence[npt.NDArray[np.uint8]], chosen: npt.NDArray[np.int64]) -> npt.NDArray[np.int64]:
    """A row for each of these images, with a bit for each body."""
    walks = [nbc.simulate(bodies, [(images[i], CYCLE)], materials=materials, record=None) for i in chosen]
    return np.array([walk.displacement[:, 0] > 0 for walk in walks], dtype=np.int64)


def choose(bits: npt.NDArray[np.int64], seen: npt.NDArray[np.int64], count: int) -> List[int]:
    """Eyes one after another, each the one that adds most to how far apart all pairs of digits are."""
    share = np.array([bits[seen == digit].mean(axis=0) for digit in range(10)])
    apart = np.array([(share[i] - share[j]) ** 2 for i in range(10) for j in range(i)])
    chosen: List[int] = []
    for _ in range(min(count, bits.shape[1])):
        gain = np.sqrt(apart[:, chosen].sum(axis=1, keepdims=True) + apart).sum(axis=0)
        gain[chosen] = -1
        chosen.append(int(np.argmax(gain)))
    return chosen


found = archives()
materials = found[0].materials
best = [np.argsort(-archive.elites["fitness"][:, 0], kind="stable")[:10] for archive in found]
bodies = [archive.elites["body"][i] for archive, places in zip(found, best) for i in places]
some = np.concatenate([training[labels[training] == digit][: 2 if SHORT else 25] for digit in range(10)])
eyes = choose(look(bodies, some), labels[some], 48)
bits = look([bodies[eye] for eye in eyes], numbers)

for count in [len(eyes)] if SHORT else [16, 32, 48]:
    shown = bits[held_out, :count] @ (1 << np.arange(count)[::-1])
    lines = [f"{hex(eye)},{digit}\n" for eye, digit in zip(shown, labels[held_out])]
    Path("held_out.csv").write_text("eye,digit\n" + "".join(lines))
    for gates in [200, 1000, 4000]:
        rows = {"eye": bits[training, :count], "digit": labels[training]}
        learned = nbc.learn(rows, "read.nb", name="read", gates=gates, hold_out=0)
        Path("eyes.nb").write_text('use "read.nb"\n\ntest read "held out" from "held_out.csv" at least 1%\n')
        (result,) = nbc.load("eyes.nb").test(level="logic")
        robots = learned.circuit.compile(library="three", effort="fast").robots
        right = sum(row["passed"] for row in result.rows)
        print(f"{count} eyes, {learned.ands} AND gates, {len(robots)} robots: {right} of {len(result.rows)} images")
