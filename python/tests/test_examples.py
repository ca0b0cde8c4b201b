"""Everything that readers may copy runs: examples, docstrings, the guide and its notebook."""

from __future__ import annotations

import doctest
import hashlib
import importlib
import json
import os
import pkgutil
import re
import subprocess
import sys
from pathlib import Path

import pytest

import nbc

EXAMPLES = Path(__file__).resolve().parents[1] / "examples"
MODULES = ["nbc"] + [
    module.name for module in pkgutil.walk_packages(nbc.__path__, "nbc.") if not module.name.endswith("._nbc")
]


@pytest.mark.parametrize("name", MODULES)
def test_docstrings(name):
    if name in ("nbc.evogym.base", "nbc.evogym.envs", "nbc.evogym.vector"):
        pytest.importorskip("gymnasium")
    found = doctest.testmod(importlib.import_module(name), optionflags=doctest.NORMALIZE_WHITESPACE)
    assert found.failed == 0


def test_every_public_name_has_a_docstring():
    silent = [name for name in nbc.__all__ if not name.startswith("__") and name.isidentifier()
              and not getattr(getattr(nbc, name), "__doc__", None)]
    assert silent == []


@pytest.mark.parametrize("example", sorted(EXAMPLES.glob("*.py")), ids=lambda path: path.stem)
def test_examples(example, tmp_path):
    if "evolution_gym" in example.name:
        pytest.importorskip("evogym")
    if example.stem in ("ppo_walker", "cppn_walkers"):
        pytest.importorskip("stable_baselines3")
    if example.stem in ("eyes", "learn"):
        pytest.importorskip("sklearn")
    environment = {**os.environ, "NBC_EXAMPLE": "short", "MPLBACKEND": "agg"}
    done = subprocess.run([sys.executable, str(example)], cwd=tmp_path, env=environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


def test_a_research_object_names_what_is_there(tmp_path):
    example = str(EXAMPLES / "ro_crate.py")
    subprocess.run([sys.executable, example], cwd=tmp_path, check=True, capture_output=True)
    graph = json.loads((tmp_path / "out/ro-crate-metadata.json").read_text())["@graph"]
    entities = {entity["@id"]: entity for entity in graph}
    assert entities["#run/small/seed-1/generations"]["value"] == 2
    content = (tmp_path / "out/small/seed-1/checkpoint.nbc").read_bytes()
    checkpoint = entities["small/seed-1/checkpoint.nbc"]
    assert checkpoint["contentSize"] == str(len(content))
    assert checkpoint["sha256"] == hashlib.sha256(content).hexdigest()

    def references(value):
        if isinstance(value, list):
            return [name for one in value for name in references(one)]
        if isinstance(value, dict):
            return [value["@id"]] if set(value) == {"@id"} else references(list(value.values()))
        return []

    known = {name for name in references(graph) if not name.startswith("https://w3id.org/ro/crate/")}
    assert known <= set(entities)
    subprocess.run([sys.executable, example, "out/small/seed-1", "MIT"], cwd=tmp_path, check=True)
    graph = json.loads((tmp_path / "out/small/seed-1/ro-crate-metadata.json").read_text())["@graph"]
    own = next(entity for entity in graph if entity["@id"] == "./")
    assert {"@id": "checkpoint.nbc"} in own["hasPart"] and own["mentions"]
    (tmp_path / "bare").mkdir()
    none = subprocess.run([sys.executable, example, "bare", "MIT"], cwd=tmp_path, capture_output=True, text=True)
    assert none.returncode == 1 and "no runs below bare" in none.stderr


@pytest.mark.parametrize(("page", "least"), [("docs/python.md", 8), ("docs/evolution-gym.md", 3)])
def test_the_guides(root, tmp_path, page, least):
    """The blocks of a page as one program, which imports all that it needs."""
    if "gym" in page:
        pytest.importorskip("gymnasium")
    blocks = re.findall(r"```python\n(.*?)```", (root / page).read_text(), flags=re.DOTALL)
    assert len(blocks) >= least
    (tmp_path / "tests").mkdir()
    for folder in ("circuits", "library", "tests/benchmarks"):
        (tmp_path / folder).symlink_to(root / folder)
    (tmp_path / "guide.py").write_text("\n".join(blocks))
    environment = {**os.environ, "MPLBACKEND": "agg"}
    done = subprocess.run([sys.executable, "guide.py"], cwd=tmp_path, env=environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize(
    ("name", "shows"),
    [("latch", {"image/svg+xml": 3, "text/html": 1}), ("evolution_gym", {"image/png": 3, "image/gif": 1})],
)
def test_notebooks(name, shows):
    import nbclient
    import nbformat

    if "gym" in name:
        pytest.importorskip("gymnasium")
    notebook = nbformat.read(EXAMPLES / f"{name}.ipynb", as_version=4)
    # Jupyter runs a notebook in its folder.
    place = {"metadata": {"path": str(EXAMPLES)}}
    nbclient.NotebookClient(notebook, timeout=1800, startup_timeout=1800, resources=place).execute()
    kinds = [kind for cell in notebook.cells for output in cell.get("outputs", []) for kind in output.get("data", {})]
    assert all(kinds.count(kind) >= least for kind, least in shows.items()), kinds


def test_types():
    mypy = pytest.importorskip("mypy.api")
    package = Path(__file__).resolve().parents[1]
    out, errors, status = mypy.run(["--config-file", str(package / "pyproject.toml"), str(package / "python/nbc"),
                                    str(package / "examples")])
    assert status == 0, out + errors
