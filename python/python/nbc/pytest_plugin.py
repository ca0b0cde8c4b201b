"""A pytest plugin that collects ``.nb`` files: each declared test is a test.

    pytest circuits/ --nb-level=logic -k latch -n 4

Notebooks of Mathematica end in ``.nb``, too. So a file is collected when its first word begins a declaration of the
language, or when the command line names it.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any, Iterator, List, Optional, Tuple, Union

import pytest

from .circuits import Program, TestResult, load
from .errors import NbcError

__all__ = ["NbFailure"]

# A byte-order mark, comments, and a word of `crates/lang/src/syntax/split.rs`.
_BEGIN = re.compile(
    rb"(?:\xef\xbb\xbf)?(?:\s*//[^\n]*\n)*\s*(?:circuit|enum|environment|evolution|file|images|let|library|material"
    rb"|prove|schedule|simulate|stimulus|swarm|test|use|world)\b"
)


def pytest_addoption(parser: pytest.Parser) -> None:
    """Adds the options."""
    group = parser.getgroup("nbc", "circuits of soft robots")
    group.addoption(
        "--nb-level",
        choices=("auto", "logic", "physics"),
        default="auto",
        help="the level of tests in .nb files: logic, physics, or auto: physics for swarms of fewer than 40 robots",
    )
    group.addoption("--no-nb", action="store_true", help="do not collect .nb files")


def pytest_collect_file(file_path: Path, parent: pytest.Collector) -> Optional[pytest.Collector]:
    """Collects a ``.nb`` file that is one of nbc's."""
    if file_path.suffix != ".nb" or parent.config.getoption("--no-nb"):
        return None
    if not parent.session.isinitpath(file_path) and not _is_ours(file_path):
        return None
    file: pytest.Collector = NbFile.from_parent(parent, path=file_path)
    return file


def _is_ours(path: Path) -> bool:
    """Whether a file begins as a text in the language does."""
    try:
        with path.open("rb") as file:
            return _BEGIN.match(file.read(1 << 16)) is not None
    except OSError:
        return False


class NbFailure(Exception):
    """A test of a circuit that failed."""

    def __init__(self, results: List[TestResult]) -> None:
        super().__init__("\n".join(result.text for result in results))


class NbFile(pytest.File):
    """A source file."""

    def collect(self) -> Iterator[pytest.Item]:
        """Checks the file. Its errors are shown as they are by ``nbc check``."""
        program = load(str(self.path))
        names: List[str] = []
        for number, test in enumerate(program.tests):
            name = f"{test['circuit']}: {test['title']}" if test["title"] else str(test["circuit"])
            names.append(name)
            repeated = names.count(name)
            shown = name if repeated == 1 else f"{name} ({repeated})"
            yield NbItem.from_parent(self, name=shown, program=program, number=number, line=int(test["line"]))

    def repr_failure(self, excinfo: pytest.ExceptionInfo[BaseException], style: Any = None) -> Any:
        """Diagnostics without a traceback."""
        return str(excinfo.value) if isinstance(excinfo.value, NbcError) else super().repr_failure(excinfo)


class NbItem(pytest.Item):
    """A declared test, for every swarm that is declared for its circuit."""

    def __init__(self, *, program: Program, number: int, line: int, **arguments: Any) -> None:
        super().__init__(**arguments)
        self.program, self.number, self.line = program, number, line

    def runtest(self) -> None:
        """Runs the test."""
        level = self.config.getoption("--nb-level")
        results = self.program._test(self.number, None if level == "auto" else level, False)
        failed = [result for result in results if not result.passed]
        if failed:
            raise NbFailure(failed)

    def repr_failure(self, excinfo: pytest.ExceptionInfo[BaseException], style: Any = None) -> Any:
        """The truth table and the failing rows, or diagnostics, without a traceback."""
        if isinstance(excinfo.value, (NbFailure, NbcError)):
            return str(excinfo.value)
        return super().repr_failure(excinfo, style)

    def reportinfo(self) -> Tuple[Union[Path, str], Optional[int], str]:
        """The place of the declaration."""
        return self.path, self.line - 1, self.name
