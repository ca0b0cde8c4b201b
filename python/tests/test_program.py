"""The program of the package, as a user starts it: each command is a process of its own."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import sysconfig
import time
import urllib.request
from pathlib import Path
from typing import Any, List

import pytest

import nbc

NBC = [sys.executable, "-m", "nbc"]
# Ends a command that hangs, on a machine of any load.
LONGEST = 1800
FAILS = """
circuit wire(a) -> (q) { q = not not a }
test wire "wrong" { a | q
    0 | 1 }
"""


def run(words: List[Any], folder: Path, **options: Any) -> subprocess.CompletedProcess[bytes]:
    return subprocess.run(words, cwd=folder, capture_output=True, timeout=LONGEST, check=False, **options)


def start(words: List[Any], folder: Path) -> subprocess.Popen[str]:
    """A command whose Ctrl-C is not ignored, as it would be in the background of a shell."""

    def heed() -> None:
        signal.signal(signal.SIGINT, signal.SIG_DFL)

    pipe = subprocess.PIPE
    return subprocess.Popen([*NBC, *words], cwd=folder, stdout=pipe, stderr=pipe, text=True, preexec_fn=heed)


LINES = [
    (0, ["--version"]),
    (0, ["explain", "unknown"]),
    (0, ["library", "list"]),
    (0, ["library", "list", "--format", "json"]),
    (0, ["simulate", "nand", "--schedule", "00*2 11*2"]),
    (0, ["test", "good.nb"]),
    (0, ["build", "good.nb"]),
    (1, ["test", "fails.nb", "--logic"]),
    (2, ["rum"]),
    (2, ["check", "missing.nb"]),
    (2, ["check", b"\xff.nb"]),
    (2, ["check", "--format", "json", b"\xff.nb"]),
]


@pytest.mark.parametrize("status, words", LINES, ids=[" ".join(map(str, words)) for _, words in LINES])
def test_it_prints_what_the_program_prints(status, words, built_program, tmp_path):
    (tmp_path / "good.nb").write_text("circuit f(a) -> (q) { q = not a }\ntest f { a | q\n    0 | 1 }\n")
    (tmp_path / "fails.nb").write_text(FAILS)
    there = run([*NBC, *words], tmp_path)
    assert there.returncode == status, there.stderr
    expected = run([built_program, *words], tmp_path)
    assert (there.stdout, there.stderr, status) == (expected.stdout, expected.stderr, expected.returncode)


def test_the_script_is_the_program(tmp_path):
    script = Path(sysconfig.get_path("scripts")) / "nbc"
    assert run([script, "--version"], tmp_path).stdout.decode() == f"nbc {nbc.__version__}\n"


def test_it_starts_without_numpy(tmp_path):
    done = run([sys.executable, "-X", "importtime", "-m", "nbc", "explain", "unknown"], tmp_path)
    loaded = [line.split("|")[-1].strip() for line in done.stderr.decode().splitlines()]
    assert done.returncode == 0 and "nbc._nbc" in loaded
    assert "numpy" not in loaded and "nbc.bodies" not in loaded


def test_a_package_has_its_names_before_they_are_imported(tmp_path):
    code = "import nbc; print(nbc.errors.NbcError is nbc.NbcError, 'simulate' in dir(nbc)); nbc.nothing"
    done = run([sys.executable, "-c", code], tmp_path)
    assert done.stdout == b"True True\n"
    assert b"AttributeError: module 'nbc' has no attribute 'nothing'" in done.stderr


def test_ctrl_c_ends_an_evolution_with_a_checkpoint(tmp_path):
    run_of = "evolution small { from: gates, box: 3 x 3, batch: 4, newcomers: 1, generations: 900000, seed: 2 }"
    (tmp_path / "small.nb").write_text(run_of)
    checkpoint = tmp_path / "out/small/seed-2/checkpoint.nbc"
    evolve = start(["evolve", "small.nb", "--checkpoint-every", "0"], tmp_path)
    while not checkpoint.exists() and evolve.poll() is None:
        time.sleep(0.01)
    evolve.send_signal(signal.SIGINT)
    out, errors = evolve.communicate(timeout=LONGEST)
    assert evolve.returncode == 4, errors
    assert out.endswith("interrupted; `--resume` continues the run\n\n") and "Traceback" not in errors
    more = run([*NBC, "evolve", "small.nb", "--resume", "--generations", "1"], tmp_path)
    assert more.returncode == 0, more.stderr


def test_ctrl_c_ends_the_server_of_the_page(tmp_path):
    play = start(["play", "--no-open"], tmp_path)
    assert play.stdout is not None
    with urllib.request.urlopen(play.stdout.readline().strip(), timeout=LONGEST) as page:
        assert page.status == 200 and b"<html" in page.read()
    play.send_signal(signal.SIGINT)
    _, errors = play.communicate(timeout=LONGEST)
    assert (play.returncode, "Traceback" in errors) == (0, False), errors


def test_editors_are_served(tmp_path):
    messages = ['{"jsonrpc":"2.0","id":1,"method":"initialize","params":{"capabilities":{}}}']
    messages += ['{"jsonrpc":"2.0","method":"initialized","params":{}}']
    messages += ['{"jsonrpc":"2.0","id":2,"method":"shutdown"}', '{"jsonrpc":"2.0","method":"exit"}']
    text = "".join(f"Content-Length: {len(message)}\r\n\r\n{message}" for message in messages)
    done = run([*NBC, "lsp"], tmp_path, input=text.encode())
    assert done.returncode == 0 and b'"capabilities"' in done.stdout, done.stderr


def test_a_reader_may_close_the_output(tmp_path):
    list_all = subprocess.Popen([*NBC, "library", "list"], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    assert list_all.stdout is not None and list_all.stderr is not None
    list_all.stdout.close()
    assert (list_all.wait(LONGEST), list_all.stderr.read()) == (0, b"")


@pytest.mark.skipif(os.name != "posix", reason="it closes standard output with a shell")
def test_a_closed_output_is_no_file_of_the_program(tmp_path):
    done = run(["sh", "-c", '"$@" new adder >&-', "sh", *NBC], tmp_path)
    assert (done.returncode, done.stderr) == (0, b"")
    assert "wrote" not in (tmp_path / "adder.nb").read_text()


@pytest.mark.parametrize("words", [["test", "fails.nb", "--logic"], ["check", "fails.nb"], ["library", "list"]])
def test_its_output_is_described_by_its_schema(words, tmp_path):
    validator = pytest.importorskip("jsonschema").Draft202012Validator
    schemas = {}
    for path in (Path(__file__).parents[2] / "docs/schema").glob("*.json"):
        schema = json.loads(path.read_text(encoding="utf-8"))
        validator.check_schema(schema)
        schemas[schema["$id"]] = schema
    (tmp_path / "fails.nb").write_text(FAILS, encoding="utf-8")
    found = json.loads(run([*NBC, *words, "--format", "json"], tmp_path).stdout)
    validator(schemas[found["schema"]]).validate(found)
