import assert from "node:assert/strict";
import { test } from "node:test";

import { meetsCloth } from "../../drapery/web/viewer/picking.js";

// Two squares, each of two triangles: the first at z = 0, the second before it at z = 1.
const square = (z, left) => [left, 0, z, left + 1, 0, z, left + 1, 1, z, left, 1, z];
const scene = (grip, left = 0) => ({
  header: { grip },
  positions: Float32Array.from([...square(0, 0), ...square(1, left)]),
  triangles: Uint32Array.from([0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7]),
});
const ray = (x, y, z = 5) => ({ origin: [x, y, z], along: [0, 0, -2] });
const BACK = [0, 4];
const FRONT = [4, 4];

test("a ray takes the nearest surface", () => {
  assert.equal(meetsCloth(scene([FRONT]), ray(0.5, 0.5)), true);
  assert.equal(meetsCloth(scene([BACK]), ray(0.5, 0.5)), false, "the front hides the cloth");
  assert.equal(meetsCloth(scene([BACK], 0.75), ray(0.5, 0.5)), true, "the front is beside it");
});

test("both triangles of a square are met, and nothing outside", () => {
  for (const [x, y] of [[0.9, 0.1], [0.1, 0.9], [0.5, 0.5]]) {
    assert.equal(meetsCloth(scene([FRONT]), ray(x, y)), true);
  }
  assert.equal(meetsCloth(scene([FRONT, BACK]), ray(1.1, 0.5)), false);
});

test("a surface behind the camera is not met", () => {
  assert.equal(meetsCloth(scene([FRONT, BACK]), ray(0.5, 0.5, -1)), false);
  assert.equal(meetsCloth(scene([BACK]), ray(0.5, 0.5, 0.5)), true, "only the front is behind");
});
