"""Learns circuits from four sets of examples, as `nbc learn` does.

The flowers, wines and tumors are those of scikit-learn; the ends of tic-tac-toe are played here.
"""

from __future__ import annotations

from typing import Any, Dict, Mapping, Set, Tuple

import numpy as np
import numpy.typing as npt
from sklearn import datasets

import nbc

LINES = [(0, 1, 2), (3, 4, 5), (6, 7, 8), (0, 3, 6), (1, 4, 7), (2, 5, 8), (0, 4, 8), (2, 4, 6)]


def measured(examples: Any, steps: float) -> Dict[str, npt.NDArray[np.int64]]:
    """A column for each measure as whole numbers: so many steps from its least to its greatest value. And the class."""
    low, high = examples.data.min(axis=0), examples.data.max(axis=0)
    whole = np.round((examples.data - low) / (high - low) * steps).astype(np.int64)
    columns = {str(name).replace(" ", "_"): column for name, column in zip(examples.feature_names, whole.T)}
    return {**columns, "class": examples.target}


def tic_tac_toe() -> Mapping[str, npt.NDArray[np.int64]]:
    """All boards at the end of a game: the fields of x, those of o, and whether x wins."""
    ends: Set[Tuple[str, bool]] = set()

    def play(board: str, player: str, other: str) -> None:
        won = any(all(board[field] == other for field in line) for line in LINES)
        if won or "." not in board:
            ends.add((board, won and other == "x"))
            return
        for field in range(9):
            if board[field] == ".":
                play(board[:field] + player + board[field + 1 :], other, player)

    play("." * 9, "x", "o")
    boards = sorted(ends)
    fields = {player: np.array([[int(field == player) for field in board] for board, _ in boards]) for player in "xo"}
    return {**fields, "wins": np.array([int(wins) for _, wins in boards])}


sets: Dict[str, Mapping[str, npt.NDArray[np.int64]]] = {
    "iris": measured(datasets.load_iris(), 31),
    "wine": measured(datasets.load_wine(), 63),
    "tumors": measured(datasets.load_breast_cancer(), 63),
    "tic_tac_toe": tic_tac_toe(),
}
for name, columns in sets.items():
    learned = nbc.learn(columns, f"{name}.nb", name=name)
    robots = learned.circuit.compile(library="three").robots
    print(f"{name}: {learned.held_out:.1%} of the rows held out, {learned.ands} AND gates, {len(robots)} robots")
