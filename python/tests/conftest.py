"""What the tests share."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from typing import Any, Callable, List

import numpy as np
import pytest

pytest_plugins = ["pytester"]

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture
def root() -> Path:
    """The folder of the project."""
    return ROOT


@pytest.fixture
def built_program() -> str:
    """The program `nbc` that is built without Python."""
    places = [os.environ.get("NBC_PROGRAM"), ROOT / "target/release/nbc", ROOT / "target/debug/nbc"]
    found = next((str(place) for place in places if place and Path(place).exists()), None)
    if found is None:
        assert "CI" not in os.environ, "the program is built before these tests"
        pytest.skip("the program is not built")
    return found


@pytest.fixture
def program() -> Callable[..., str]:
    """The program of the package: runs it with arguments, and returns its standard output."""

    def run(*arguments: Any) -> str:
        words = [sys.executable, "-m", "nbc", *map(str, arguments)]
        return subprocess.run(words, check=True, capture_output=True, text=True, cwd=ROOT).stdout

    return run


@pytest.fixture
def walkers() -> np.ndarray:
    """Some bodies of 3 x 3 that walk."""
    random = np.random.default_rng(5)
    bodies = random.integers(1, 9, size=(12, 3, 3), dtype=np.uint8)
    bodies[:, 2, :] = 3
    return bodies


@pytest.fixture
def rows_of() -> Callable[[np.ndarray], List[str]]:
    """A body as rows of digits."""
    return lambda body: ["".join(map(str, row)) for row in body.tolist()]
