import assert from "node:assert/strict";
import { test } from "node:test";

import { axes, clipMatrix, cross, dot, sightRay, unit } from "../../drapery/web/viewer/matrices.js";
import { near, orthographic, perspective, project } from "./vectors.js";

test("the axes of a camera are orthonormal and right-handed", () => {
  const { right, up, back } = axes(perspective([3, 2, 5], [1, 0, -1]));
  for (const axis of [right, up, back]) near([dot(axis, axis)], [1]);
  near(cross(right, up), back);
});

test("the target is in the middle of the picture", () => {
  for (const camera of [perspective([3, 2, 5], [1, 1, 1]), orthographic([3, 2, 5], 2, [1, 1, 1])]) {
    near(project(clipMatrix(camera, 1.5), [1, 1, 1]).slice(0, 2), [0, 0], 1e-6);
  }
});

test("near and far planes are -1 and 1 in depth", () => {
  for (const camera of [perspective([0, 0, 5]), orthographic([0, 0, 5], 2)]) {
    const matrix = clipMatrix(camera, 1);
    near([project(matrix, [0, 0, 5 - camera.near])[2]], [-1], 1e-4);
    near([project(matrix, [0, 0, 5 - camera.far])[2]], [1], 1e-4);
  }
});

test("an orthographic picture shows its height whatever the distance", () => {
  const matrix = clipMatrix(orthographic([0, 0, 5], 2), 2);
  near(project(matrix, [0, 1, -3]).slice(0, 2), [0, 1], 1e-6);
  near(project(matrix, [2, 0, 3]).slice(0, 2), [1, 0], 1e-6);
});

test("a ray through a point of the picture meets what is seen there", () => {
  for (const camera of [perspective([3, 2, 5]), orthographic([3, 2, 5], 2)]) {
    const matrix = clipMatrix(camera, 1.6);
    for (const [x, y] of [[0, 0], [0.5, -0.25], [-1, 1]]) {
      const { origin, along, facing } = sightRay(camera, 1.6, x, y);
      const point = origin.map((value, axis) => value + 3 * along[axis]);
      near(project(matrix, point).slice(0, 2), [x, y], 1e-5);
      near(facing, unit([-3, -2, -5]));
      assert.ok(dot(along, facing) > 0);
    }
  }
});
