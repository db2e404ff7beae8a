// What several tests use: cameras as the server sends them, and comparison within rounding.
import assert from "node:assert/strict";

import { readCamera } from "../../drapery/web/viewer/matrices.js";

const UP = [0, 1, 0];

export const perspective = (position, target = [0, 0, 0]) =>
  readCamera([position, target, UP, 40, null, 0.1, 100]);
export const orthographic = (position, height, target = [0, 0, 0]) =>
  readCamera([position, target, UP, 40, height, 0.1, 100]);

export function near(found, wanted, tolerance = 1e-9) {
  assert.equal(found.length, wanted.length);
  found.forEach((value, place) => {
    assert.ok(Math.abs(value - wanted[place]) <= tolerance, `${found} is not ${wanted}`);
  });
}

// A point in normalised device coordinates, by a matrix that is stored by columns.
export function project(matrix, [x, y, z]) {
  const [px, py, pz, w] = [0, 1, 2, 3].map(
    (row) => matrix[row] * x + matrix[4 + row] * y + matrix[8 + row] * z + matrix[12 + row],
  );
  return [px / w, py / w, pz / w];
}
