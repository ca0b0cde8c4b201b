"""Bodies that see images."""

from __future__ import annotations

import json

import numpy as np
import pytest

import nbc

SPOTS = "a,b,c,d,label\n4,4,0,0,top\n3,4,1,0,top\n0,0,4,4,bottom\n0,1,4,3,bottom\n"
PROGRAM = """\
stimulus spot[2][2]

material dark  { kind: sensor, stimulus: spot, absent: 1.6, present: 0.6 }
material light { kind: sensor, stimulus: spot, absent: 0.6, present: 1.6 }

images tops    { stimulus: spot, from: "spots.csv", white: 4, label: top }
images bottoms { stimulus: spot, from: "spots.csv", white: 4, label: bottom }

schedule spots(spot) {
    tops    for 20 steps
    bottoms for 30 steps
}

evolution tell {
    box:         3 x 3
    materials:   [muscle, antimuscle, dark, light]
    genome:      voxels
    objective:   images
    variable:    spots
    descriptors: [voxels in 3 bins, sensory in 3 bins]
    batch:       6
    generations: 3
    seed:        5
}
"""


@pytest.fixture
def spots(tmp_path):
    (tmp_path / "spots.csv").write_text(SPOTS)
    file = tmp_path / "tell.nb"
    file.write_text(PROGRAM)
    return nbc.load(file)


def test_sets_of_images_are_arrays(spots):
    assert list(spots.images) == ["tops", "bottoms"]
    assert spots.images["tops"].tolist() == [[[1, 1], [0, 0]], [[0.75, 1], [0.25, 0]]]


def test_bodies_are_evolved_and_simulated_before_images_as_by_the_program(spots, program, tmp_path):
    evolution = spots.evolutions["tell"]
    search = nbc.Search(evolution, seed=5)
    while not search.is_done:
        search.step()
    elites, materials = search.archive.elites, search.archive.materials
    best = elites[np.argmax(elites["fitness"][:, 0])]
    body, behavior = best["body"], best["behavior"]
    apart = [
        [nbc.simulate([body], [(image, steps)], materials=materials).displacement[0, 0] for image in spots.images[name]]
        for name, steps in (("tops", 20), ("bottoms", 30))
    ]
    signs = [1 if behavior[place] == "R" else -1 for place in (0, 3)]
    least = min(sign * moved for sign, each in zip(signs, apart) for moved in each)
    assert least == best["fitness"][0]

    file = tmp_path / "body.json"
    file.write_text(json.dumps({"body": nbc.rows(body), "materials": list(materials)}))
    shown = ["--images", tmp_path / "tell.nb", "--schedule", "tops*20steps bottoms*30steps"]
    found = json.loads(program("simulate", file, *shown, "--format", "json"))
    schedule = [(image, 20) for image in spots.images["tops"]] + [(image, 30) for image in spots.images["bottoms"]]
    walk = nbc.simulate([body], schedule, materials=materials)
    assert walk.displacement[0].tolist() == found["displacement"]
    poses = nbc.simulate([body], schedule, materials=materials, record="poses")
    np.testing.assert_array_equal(poses.com, walk.com)


def test_images_that_do_not_fit_are_refused(spots):
    evolution = spots.evolutions["tell"]
    materials = evolution.fields["palette"]
    body = [["343"]]

    def refused(schedule, message, error=ValueError, **others):
        with pytest.raises(error, match=message):
            nbc.simulate(body, schedule, **{"materials": materials, **others})

    image = np.zeros((2, 2))
    refused("01*1", "the materials sense images; expected arrays of 2 x 2 pixels")
    refused([("01", 1)], "the schedule has the pattern `01`, but the materials sense images")
    refused([(image, 1)], "the schedule has an image, but the materials sense none", materials=None)
    refused([(np.zeros((2, 3)), 1)], "2 x 3 pixels, but the materials sense 2 x 2")
    refused([(image + 1.5, 1)], "row 1, column 1: the pixel is 1.5, expected 0 to 1")
    refused([(np.zeros(4), 1)], r"has the shape \(4,\), expected \(rows, columns\)")
    refused([([["a", "b"]], 1)], "an image of the schedule has the dtype <U1, expected numbers", TypeError)
