import assert from "node:assert/strict";
import { test } from "node:test";

import { LaneGrid, followWithSlack, middleOf } from "../src/live/camera";
import { crowdGrid, detailOf } from "../src/live/crowd";
import { spread } from "../src/live/spread";

test("the camera moves only when the robot leaves the middle", () => {
  assert.equal(followWithSlack(undefined, 5, 2), 5);
  assert.equal(followWithSlack(5, 6, 2), 5);
  assert.equal(followWithSlack(5, 8, 2), 6);
  assert.equal(followWithSlack(5, 1, 2), 3);
});

test("the middle is that of the points along the ground", () => {
  assert.equal(middleOf(Float32Array.of(0, 9, 4, 7)), 2);
  assert.equal(middleOf(Float32Array.of()), 0);
});

test("only lanes in view are counted", () => {
  const grid = new LaneGrid(200, 2, 800, 70);
  assert.equal(grid.height, 7000);
  assert.deepEqual(grid.between(0, 140), [0, 1, 2, 3]);
  assert.deepEqual(grid.between(71, 139), [2, 3]);
  assert.deepEqual(grid.between(-100, 60), [0, 1]);
  assert.deepEqual(grid.between(6990, 9000), [198, 199]);
});

test("a place is in the lane that is drawn there", () => {
  const grid = new LaneGrid(7, 3, 900, 50);
  for (let lane = 0; lane < 7; lane++) {
    assert.equal(grid.at(grid.left(lane) + 5, grid.top(lane) + 5), lane);
  }
  assert.equal(grid.at(500, 105), null);
  assert.equal(grid.at(5, -3), null);
});

test("names are moved apart and stay inside", () => {
  const ends = [{ y: 50 }, { y: 51 }, { y: 98 }, { y: 99 }];
  spread(ends, 10, 0, 100);
  const places = ends.map(end => end.y);
  places.slice(1).forEach((y, i) => assert.ok(y - (places[i] as number) >= 10));
  assert.ok((places.at(-1) as number) <= 100);
});

test("all robots are in view at once, as large as they can be", () => {
  for (const [count, detail] of [
    [30, "voxels"],
    [300, "silhouettes"],
    [2000, "dots"],
  ] as const) {
    const grid = crowdGrid(count, 1000, 500);
    assert.equal(detailOf(grid), detail);
    assert.ok(grid.height <= 500 + 1e-9);
    assert.equal(grid.between(0, 500).length >= count, true);
    assert.equal(grid.at(999, 1), grid.columns - 1);
  }
});

test("cells stay large enough to be seen, even if some are below", () => {
  assert.equal(crowdGrid(2000, 60, 100).laneHeight >= 6, true);
});
