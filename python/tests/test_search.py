"""Searches, archives and checkpoints."""

from __future__ import annotations

import copy
import dataclasses
import io
import json
import pickle

import numpy as np
import pytest

import nbc

RUN = dict(shape=(3, 3), batch=6, newcomers=1, generations=6, fixed="2 cycles")
TEXT = "evolution small { from: gates, box: 3 x 3, batch: 6, newcomers: 1, generations: 6, fixed: 2 cycles }"


@pytest.fixture(scope="module")
def run():
    return nbc.Evolution(**RUN)


@pytest.fixture(scope="module")
def done(run):
    return nbc.evolve(run, seed=3)


def test_asking_and_telling_is_what_evolve_does(run, done):
    search = nbc.Search(run, seed=3)
    while not search.is_done:
        candidates = search.ask()
        assert candidates.bodies.shape == (len(candidates), 3, 3) and candidates.generation == search.generation
        np.testing.assert_array_equal(candidates.bodies, search.ask().bodies)
        search.tell(candidates, search.evaluate(candidates))
    assert search.summary == done.summary
    assert (search.archive.elites == done.archive.elites).all()


def test_an_archive_is_an_array_and_a_frame(done):
    archive = done.archive
    assert len(archive) == done.summary["archive"]["filled"] > 0
    assert archive.elites["body"].shape[1:] == (3, 3)
    again = nbc.evaluate(archive.elites["body"], done.evolution)
    np.testing.assert_array_equal(again.displacement, archive.elites["displacement"])
    np.testing.assert_array_equal(again.fitness, archive.elites["fitness"])
    np.testing.assert_array_equal(again.niche, archive.elites["niche"])
    frame = archive.frame()
    assert len(frame) == len(archive) and frame["fitness_1"].max() == archive.elites["fitness"][:, 0].max()
    assert frame["body"][0].split("|") == nbc.rows(archive.elites["body"][0])
    heat = archive.heatmap("voxels", "behavior")
    assert heat.shape == (16, 4) and np.nanmax(heat) == archive.elites["fitness"][:, 0].max()
    with pytest.raises(ValueError, match="no axis of the archive called `size`"):
        archive.heatmap("size", "voxels")


def test_a_run_resumes_to_the_same_archive(run, done, tmp_path):
    file = tmp_path / "run.nbc"
    nbc.evolve(run, seed=3, generations=2, checkpoint=file)
    assert nbc.read_archive(file).axes == run.axes
    resumed = nbc.evolve(run, seed=3, checkpoint=file)
    assert resumed.summary == done.summary
    assert (nbc.read_archive(file).elites == done.archive.elites).all()
    with pytest.raises(ValueError, match="belongs to seed 3, expected seed 4"):
        nbc.evolve(run, seed=4, checkpoint=file)
    with pytest.raises(nbc.NbcError, match="different declaration"):
        nbc.Search.resume(file, nbc.Evolution(shape=(4, 4)))


def test_more_generations_than_declared_are_made(run, tmp_path):
    short = nbc.Evolution(**{**RUN, "generations": 2})
    search = nbc.evolve(short, seed=3, generations=4, checkpoint=tmp_path / "run.nbc")
    assert search.generation == 4 and search.is_done
    assert nbc.evolve(run, seed=3, generations=4).archive == search.archive
    again = nbc.evolve(short, seed=3, generations=6, checkpoint=tmp_path / "run.nbc")
    assert again.archive == nbc.evolve(run, seed=3).archive


def test_axes_of_one_word_are_told_apart():
    axes = ["active in 3 bins", "behavior", "active in 9 bins"]
    search = nbc.evolve(nbc.Evolution(**{**RUN, "descriptors": axes}), seed=1)
    archive = search.archive
    assert archive.axes == search.evolution.axes == (("active_1", 3), ("behavior", 16), ("active_3", 9))
    frame = archive.frame()
    assert frame["niche_active_1"].tolist() == archive.elites["niche"][:, 0].tolist()
    assert frame["niche_active_3"].tolist() == archive.elites["niche"][:, 2].tolist()
    heat = archive.heatmap("active_3", "active_1")
    assert heat.shape == (3, 9)
    for bin_1, _, bin_3 in archive.elites["niche"]:
        assert np.isfinite(heat[bin_1, bin_3])
    with pytest.raises(ValueError, match="no axis of the archive called `active`"):
        archive.heatmap("active", "behavior")


@pytest.mark.parametrize("axes", [["voxels in 4 bins", "behavior"], ["active in 2 bins", "active in 4 bins"]])
def test_a_frame_is_the_table_of_the_program(axes, program, tmp_path):
    pandas = pytest.importorskip("pandas")
    search = nbc.evolve(nbc.Evolution(**{**RUN, "descriptors": axes, "name": "small"}), seed=1)
    (tmp_path / "seed-1").mkdir()
    search.save(tmp_path / "seed-1/checkpoint.nbc")
    text = io.StringIO(program("export", tmp_path / "seed-1", "--to", "csv"))
    table = pandas.read_csv(text, dtype={"body": str}, keep_default_na=False)
    for archive in (search.archive, nbc.read_archive(tmp_path / "seed-1/checkpoint.nbc")):
        found = archive.frame()
        assert list(found.columns) == list(table.columns)[2:]
        pandas.testing.assert_frame_equal(found, table[found.columns], check_dtype=False, check_exact=True)


@pytest.mark.parametrize("copied", [copy.deepcopy, copy.copy, lambda value: pickle.loads(pickle.dumps(value))])
def test_whole_data_can_be_copied(run, done, copied):
    robot = nbc.library()[0]
    assert copied(robot) == robot and hash(copied(robot)) == hash(robot) and robot != nbc.library()[1]
    again = copied(run)
    assert again == run and again.axes == run.axes and hash(again) == hash(run) and again != nbc.Evolution()
    assert copied(done.archive) == done.archive and len(copied(done.archive)) == len(done.archive)
    halfway = nbc.evolve(run, seed=3, generations=2)
    other = copied(halfway)
    while not other.is_done:
        other.step()
    assert other.archive == done.archive and halfway.generation == 2
    program = nbc.loads("circuit f(a) -> (q) { q = not a }")
    compiled = copied(program.compile(effort="fast"))
    assert compiled.robots == program.compile().robots and copied(program.circuits["f"]).name == "f"
    assert copied(nbc.Interrupted([1])).result == [1]


def test_checkpoints_are_those_of_the_program(program, tmp_path):
    source = tmp_path / "small.nb"
    source.write_text(TEXT)
    program("evolve", source, "--out", tmp_path / "out")
    theirs = nbc.read_archive(tmp_path / "out/small/seed-1/checkpoint.nbc")
    ours = nbc.evolve(nbc.Evolution.parse(TEXT), seed=1)
    assert (theirs.elites == ours.archive.elites).all()
    ours.save(tmp_path / "out/small/seed-1/checkpoint.nbc")
    exported = program("export", tmp_path / "out/small/seed-1", "--format", "json")
    assert json.loads(exported)["elites"]


THREE = """
stimulus s3
material s3_shrink { kind: sensor, stimulus: s3, absent: 1.6, present: 0.6 }
schedule sweep3(s1, s2, s3) {
    0 0 0 for 1 cycle
    0 0 1 for 1 cycle
    0 1 0 for 1 cycle
    0 1 1 for 1 cycle
    1 0 0 for 1 cycle
    1 0 1 for 1 cycle
    1 1 0 for 1 cycle
    1 1 1 for 1 cycle
}
evolution three {
    box: 3 x 3
    materials: [bone, flesh, muscle, antimuscle, s1_shrink, s2_shrink, s3_shrink]
    variable: sweep3
    objective: gate
    descriptors: [voxels in 2 bins, class]
    batch: 8
}
"""


def test_a_search_with_three_stimuli_has_eight_letters(program, tmp_path):
    pandas = pytest.importorskip("pandas")
    search = nbc.Search(nbc.Evolution.parse(THREE), seed=1)
    candidates = search.ask()
    found = search.evaluate(candidates)
    short = dataclasses.replace(found, displacement=found.displacement[:, :4])
    with pytest.raises(ValueError, match=r"displacement has the shape .*, expected \(\d+, 8\)"):
        search.tell(candidates, short)
    letters = np.where(found.measured, "RRRL", "")
    with pytest.raises(ValueError, match="a letter and a displacement for each of 8 patterns"):
        search.tell(candidates, dataclasses.replace(found, behavior=letters))
    search.tell(candidates, found)
    archive = search.archive
    assert len(archive) > 0 and archive.elites["displacement"].shape == (len(archive), 8)
    assert all(len(behavior) == 8 for behavior in archive.elites["behavior"].tolist())
    heat = archive.heatmap("voxels", "class")
    assert heat.shape == (256, 2) and np.isfinite(heat).any()
    (tmp_path / "seed-1").mkdir()
    search.save(tmp_path / "seed-1/checkpoint.nbc")
    table = pandas.read_csv(io.StringIO(program("export", tmp_path / "seed-1", "--to", "csv")), dtype={"body": str})
    assert list(archive.frame().columns) == list(table.columns)[2:]
    assert nbc.read_archive(tmp_path / "seed-1/checkpoint.nbc") == archive


def test_own_evaluations_are_checked(run):
    search = nbc.Search(run, seed=1)
    candidates = search.ask()
    good = search.evaluate(candidates)
    size = len(candidates)
    everything = dataclasses.replace(
        good,
        outcome=np.full(size, "measured"),
        fitness=np.ones((size, 2)),
        displacement=np.ones((size, 4)),
        behavior=np.full(size, "RRRL"),
    )
    wrong = [
        (dict(fitness=np.ones((size, 3))), r"fitness has the shape"),
        (dict(fitness=np.full((size, 2), np.nan)), "must be finite numbers"),
        (dict(behavior=np.full(size, "RRXL")), "`RRXL` is not a behavior"),
        (dict(outcome=np.full(size, "great")), "invalid outcome `great`"),
        (dict(outcome=np.full(size - 1, "measured")), "outcome has the shape"),
    ]
    for change, message in wrong:
        with pytest.raises(ValueError, match=message):
            search.tell(candidates, dataclasses.replace(everything, **change))
    with pytest.raises(ValueError, match="of another search"):
        nbc.Search(run, seed=1).tell(candidates, everything)
    search.tell(candidates, everything)
    with pytest.raises(ValueError, match="of generation 0, expected 1: ask again"):
        search.tell(candidates, everything)
    assert len(search.archive) > 0
    search.close()
    with pytest.raises(ValueError, match="the search is closed"):
        search.ask()


def test_damaged_and_missing_checkpoints(run, tmp_path):
    with pytest.raises(FileNotFoundError):
        nbc.read_archive(tmp_path / "none.nbc")
    with pytest.raises(FileNotFoundError):
        nbc.Search.resume(tmp_path / "none.nbc", run)
    (tmp_path / "bad.nbc").write_bytes(b"\x00\xff nothing")
    with pytest.raises(nbc.NbcError) as caught:
        nbc.read_archive(tmp_path / "bad.nbc")
    assert caught.value.diagnostics[0].code == "checkpoint"
    with pytest.raises(nbc.NbcError) as caught:
        nbc.Search(run).save(tmp_path / "no/such/folder/run.nbc")
    assert caught.value.diagnostics[0].code == "unwritable"
    with pytest.raises(ValueError, match="seed is -1"):
        nbc.Search(run, seed=-1)


def test_archives_go_to_pyribs_and_back(done):
    pytest.importorskip("ribs")
    archive = done.archive
    assert len(archive) > 5
    there = archive.to_ribs()
    assert len(there) == len(archive) and there.dims.tolist() == [bins for _, bins in archive.axes]
    best = there.best_elite
    row = archive.elites[archive.elites["fitness"][:, 0].argmax()]
    np.testing.assert_array_equal(best["solution"], row["body"].ravel())
    np.testing.assert_array_equal(best["measures"], row["niche"])
    names = [name for name, _ in archive.axes]
    assert nbc.Archive.from_ribs(there, names) == nbc.Archive.from_ribs(there, names, archive.materials) == archive
    with pytest.raises(ValueError, match="the archive: code . is not the same material in `materials`"):
        nbc.Archive.from_ribs(there, names, archive.materials[::-1])
    with pytest.raises(ValueError, match="2 axes are named, expected 4"):
        nbc.Archive.from_ribs(there, ["voxels", "behavior"])
    pytest.importorskip("pandas")
    frame = there.data(return_type="pandas")
    assert len(frame) == len(archive) and set(frame["width"]) == {row["body"].shape[1]}
    assert {"solution_0", "measures_0", "displacement_3", "function"} <= set(frame)


def test_archives_that_do_not_fit_pyribs_are_refused():
    archives = pytest.importorskip("ribs.archives")
    plain = archives.GridArchive(solution_dim=(3, 3), dims=[2], ranges=[(0, 1)])
    with pytest.raises(ValueError, match="the archive has no field `fitness`"):
        nbc.Archive.from_ribs(plain, ["voxels"])
    classes = nbc.Evolution(**{**RUN, "descriptors": ["voxels in 2 bins", "class"]})
    with pytest.raises(ValueError, match="pyribs has no archive with the axis `class`"):
        nbc.Search(classes).archive.to_ribs()


@pytest.mark.parametrize(
    ("field", "change", "message"),
    [
        ("solution", lambda codes: codes + 0.7, r"solution at \(0, 0\) is \d.7, expected a whole number from 0 to 8"),
        ("solution", lambda codes: codes + 300, r"the solution at \(0, 0\) is 30"),
        ("solution", lambda codes: codes - 10, r"the solution at \(0, 0\) is -"),
        ("solution", lambda codes: codes * np.nan, r"the solution at \(0, 0\) is nan"),
        ("width", lambda widths: widths * 0, "the width at 0 is 0, expected a whole number from 1"),
        ("width", lambda widths: widths + 1, r"bodies of 9 codes have the widths \[4\]"),
        ("generation", lambda numbers: numbers.astype(int) - 10, "the generation at 0 is -"),
        ("fitness", lambda scores: scores.astype(str), "the fitness has the dtype"),
        ("behavior", lambda words: words + "R", "has 5 letters, expected 4"),
    ],
)
def test_elites_of_pyribs_are_never_rounded(done, field, change, message):
    archives = pytest.importorskip("ribs.archives")
    there = done.archive.to_ribs()
    data = dict(there.data())
    data[field] = change(data[field].astype(float) if field == "solution" else data[field])
    solutions, objectives, measures = (data.pop(name) for name in ("solution", "objective", "measures"))
    for name in ("index", "threshold"):
        data.pop(name)
    types = {name: (each.shape[1:], object if each.dtype.kind == "U" else each.dtype) for name, each in data.items()}
    other = archives.GridArchive(
        solution_dim=9, dims=there.dims, ranges=[(-0.5, bins - 0.5) for bins in there.dims], extra_fields=types
    )
    other.add(solutions, objectives, measures, **data)
    with pytest.raises((ValueError, TypeError), match=message):
        nbc.Archive.from_ribs(other, [name for name, _ in done.archive.axes])


def test_robots_are_those_that_the_program_adds(program, tmp_path):
    search = nbc.evolve(nbc.Evolution(shape=(3, 3), generations=1, batch=16), seed=2)
    behavior = str(search.archive.elites["behavior"][0])
    folder = tmp_path / "runs" / "seed-2"
    folder.mkdir(parents=True)
    search.save(folder / "checkpoint.nbc")
    found = search.robots([behavior], max_error=1.0, tries=1, finalists=1)
    options = ["--max-error", "1", "--tries", "1", "--finalists", "1", "--behavior", behavior]
    program("library", "add", folder, "--into", tmp_path / "robots", *options)
    assert [robot.behavior for robot in found] == [behavior]
    assert nbc.library(tmp_path / "robots") == tuple(found)
    path = found[0].save(tmp_path / "mine")
    assert nbc.library(tmp_path / "mine") == (found[0],) and path.endswith(f"{found[0].name}.yaml")
    with pytest.raises(ValueError, match="did you mean `nand`"):
        search.robots(["nandd"])
    with pytest.raises(ValueError, match="max_error is nan, expected 0 to 1"):
        search.robots(max_error=float("nan"))
    with pytest.raises(TypeError, match="behaviors is 'nand', expected a list of texts"):
        search.robots("nand")
    missing = next(word for word in ["RRRL", "LRRL", "RLLR"] if word not in search.archive.elites["behavior"])
    with pytest.warns(nbc.MissingRobotWarning, match=f"{missing} .* none: no elite of this behavior"):
        assert search.robots([missing]) == []


def test_robots_are_measured_again_as_the_program_does(program, tmp_path):
    robot = min(nbc.library(), key=lambda robot: robot.body.size)
    path = robot.save(tmp_path)
    assert nbc.verify(tmp_path) == {robot.name: ()}
    said = json.loads(program("library", "verify", tmp_path, "--format", "json"))["robots"]
    assert said == [{"name": robot.name, "verified": True, "differs": []}]
    with open(path, encoding="utf-8") as file:
        text = file.read()
    margin = f"margin: {robot.character['margin']}"
    assert margin in text
    with open(path, "w", encoding="utf-8") as file:
        file.write(text.replace(margin, "margin: 0.25"))
    told = []
    assert nbc.verify(tmp_path, progress=lambda done, of: told.append((done, of))) == {robot.name: ("character",)}
    assert told[-1][1] == 1
    with pytest.raises(nbc.NbcError):
        nbc.verify(tmp_path / "nowhere")
