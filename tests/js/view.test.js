import assert from "node:assert/strict";
import { test } from "node:test";

import { View } from "../../drapery/web/viewer/view.js";
import { near, orthographic } from "./vectors.js";

// A square in the middle of a canvas of 200 x 100.
function viewOf(grip) {
  const view = new View({ clientWidth: 200, clientHeight: 100 });
  const square = [-0.5, -0.5, 0, 0.5, -0.5, 0, 0.5, 0.5, 0, -0.5, 0.5, 0];
  view.drawing = {
    scene: { header: { grip }, positions: Float32Array.from(square), triangles: Uint32Array.from([0, 1, 2, 0, 2, 3]) },
  };
  view.base = orthographic([0, 0, 5], 2);
  return view;
}

test("a point of the canvas, or beside it, has a line of sight", () => {
  const view = viewOf([[0, 4]]);
  near(view.rayAt(125, 25).origin, [0.5, 0.5, 5]);
  near(view.rayAt(250, 50).origin, [3, 0, 5], 1e-9);
});

test("only cloth that can be grabbed is hit", () => {
  assert.equal(viewOf([[0, 4]]).hitsCloth(100, 50), true);
  assert.equal(viewOf([[0, 4]]).hitsCloth(5, 5), false, "beside the square");
  assert.equal(viewOf([]).hitsCloth(100, 50), false, "what does not move");
});

test("the user's moves turn the camera", () => {
  const view = viewOf([]);
  view.orbit.turn(Math.PI / 2, 0);
  near(view.camera(1).position, [5, 0, 0], 1e-9);
  near([view.azimuth()], [90], 1e-9);
});
