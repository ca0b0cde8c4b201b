"""Circuits that are learned from examples."""

from __future__ import annotations

import json

import numpy as np
import pytest

import nbc

VOTES = "votes, q\n" + "".join(f"{votes}, {int(bin(votes).count('1') > 1)}\n" for votes in range(8))


def test_what_is_learned_is_that_of_the_program(program, tmp_path):
    rows, theirs, ours = tmp_path / "votes.csv", tmp_path / "theirs.nb", tmp_path / "ours.nb"
    rows.write_text(VOTES)
    expected = json.loads(program("learn", rows, "-o", theirs, "--hold-out", "25", "--seed", "2", "--format", "json"))
    learned = nbc.learn(rows, ours, hold_out=25, seed=2)
    assert ours.read_text() == theirs.read_text().replace("circuit theirs", "circuit ours")
    report = dict(learned.report, circuit="theirs")
    for one in (expected, report):
        one.pop("seconds")
        one.pop("schema", None)
    assert report == expected and learned.name == "ours"
    assert (learned.held_out, learned.confusion.sum()) == (expected["held_out"]["accuracy"], 2)


def test_arrays_are_rows():
    random = np.random.default_rng(1)
    pixels = random.integers(0, 2, size=(300, 3, 3)).reshape(300, 9)
    count = pixels.sum(axis=1)
    learned = nbc.learn({"pixels": pixels, "many": count > 4}, name="majority")
    assert learned.held_out == 1.0 and learned.report["inputs"] == [{"name": "pixels", "width": 9}]
    assert learned.values == (0, 1) and np.trace(learned.confusion) == learned.confusion.sum() == 60
    assert "<svg" in learned._repr_html_() and "nbc learn rows.csv" in (learned.source or "")
    with learned.circuit.compile().swarm() as swarm:
        bits = "110100110"
        assert swarm.run([{"pixels": int(bits, 2)}])[0]["many"] == 1


def test_a_frame_is_rows_and_nan_is_any_value():
    pandas = pytest.importorskip("pandas")
    half = pandas.DataFrame({"a": [0, 0, 1, 1], "b": [0, 1, 0, 1], "q": [0.0, 1.0, 1.0, float("nan")]})
    learned = nbc.learn(pandas.concat([half] * 20), hold_out=0)
    assert (learned.training, learned.held_out, learned.report["training"]["rows"]) == (1.0, None, 80)


def test_two_outputs_have_no_table_of_confusions():
    x = np.arange(16)
    learned = nbc.learn({"x": x, "low": x & 1, "high": x >> 3}, target=["low", "high"], hold_out=0)
    assert learned.values == () and learned.confusion.shape == (0, 0) and learned.training == 1.0
    assert "<svg" not in learned._repr_html_()


def test_wrong_rows_are_refused(tmp_path):
    (tmp_path / "votes.txt").write_text(VOTES)
    with pytest.raises(nbc.NbcError, match="expected .csv or .pla"):
        nbc.learn(tmp_path / "votes.txt")
    with pytest.raises(nbc.NbcError, match="leave none to learn from"):
        nbc.learn({"a": [0, 1], "q": [1, 0]}, hold_out=99)
    with pytest.raises(ValueError, match="`a` at 1 is 0.5, expected a whole number"):
        nbc.learn({"a": [0, 0.5], "q": [1, 0]})
    with pytest.raises(ValueError, match="same length"):
        nbc.learn({"a": [0, 1], "q": [1]})
    with pytest.raises(ValueError, match="same length"):
        nbc.learn({})
    with pytest.raises(ValueError, match="3 dimensions"):
        nbc.learn({"a": np.zeros((2, 2, 2), dtype=int), "q": [0, 1]})
    with pytest.raises(TypeError, match="dtype"):
        nbc.learn({"a": ["x", "y"], "q": [0, 1]})
    with pytest.raises(TypeError, match="target is 'q', expected a list of texts"):
        nbc.learn({"a": [0, 1], "q": [0, 1]}, target="q")
    with pytest.raises(TypeError, match="rows is of type list, expected a file, a frame or a mapping"):
        nbc.learn([[0, 1]])
    with pytest.raises(ValueError, match="unrecognized circuit format"):
        nbc.learn({"a": [0, 1], "q": [0, 1]}, tmp_path / "q.txt", hold_out=0)


@pytest.mark.parametrize(
    ("arguments", "error", "message"),
    [
        ({"hold_out": 100}, ValueError, "hold_out is 100"),
        ({"hold_out": float("nan")}, ValueError, "hold_out is nan, expected 0 to 100"),
        ({"hold_out": "5"}, TypeError, "hold_out is '5', expected a number"),
        ({"group": 0}, ValueError, "group is 0, expected 1 to 1000000"),
        ({"group": 10**6 + 1}, ValueError, "group is 1000001, expected 1 to 1000000"),
        ({"gates": -1}, ValueError, "gates is -1, expected 0 to"),
        ({"seed": 2**64}, ValueError, "seed is 18446744073709551616, expected 0 to"),
        ({"name": 3}, TypeError, "name is 3, expected a text"),
        ({"target": [1]}, TypeError, r"target is \[1\], expected a list of texts"),
    ],
)
def test_wrong_arguments_are_refused(arguments, error, message):
    with pytest.raises(error, match=message):
        nbc.learn({"a": [0, 1], "q": [0, 1]}, **arguments)


def test_any_name_is_that_of_a_circuit(tmp_path):
    """The circuit of a program has an identifier for it."""
    path = tmp_path / "my-data.csv"
    path.write_text(VOTES)
    learned = nbc.learn(path)
    assert (learned.name, learned.circuit.name) == ("my-data", "my_data")
    assert [nbc.learn(path, name=name).circuit.name for name in ("2nd", "test", "é")] == ["n_2nd", "n_test", "n__"]


def test_a_progress_function_can_end_learning(tmp_path):
    class Stop(Exception):
        pass

    def stop(done: int, all: int) -> None:
        raise Stop

    x = np.random.default_rng(2).integers(0, 2, size=(3000, 40))
    with pytest.raises(Stop):
        nbc.learn({"x": x, "q": x[:, :20].sum(axis=1) % 3 > 0}, tmp_path / "q.nb", progress=stop)
    assert not (tmp_path / "q.nb").exists()
