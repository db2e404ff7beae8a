import assert from "node:assert/strict";
import { test } from "node:test";

import { View } from "../../drapery/web/viewer/view.js";
import { near, orthographic } from "./vectors.js";

// Two panes side by side on a canvas of 200 x 100, each with a square in the middle of its world.
function viewOf(grip) {
  const view = new View({ clientWidth: 200, clientHeight: 100 });
  const square = [-0.5, -0.5, 0, 0.5, -0.5, 0, 0.5, 0.5, 0, -0.5, 0.5, 0];
  view.drawing = {
    scene: {
      header: { panes: [{ triangles: [0, 2] }, { triangles: [2, 2], flat: true }], columns: 2, grip },
      positions: Float32Array.from([...square, ...square]),
      triangles: Uint32Array.from([0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7]),
    },
  };
  return view;
}

test("panes share the canvas, and a point belongs to one of them", () => {
  const view = viewOf([[0, 4]]);
  assert.equal(view.complete, false, "the cameras are not there yet");
  assert.equal(view.rayAt(50, 50), null);
  view.cameras = [orthographic([0, 0, 5], 2), orthographic([0, 0, 5], 2)];
  assert.deepEqual(view.rects(200, 100), [[0, 0, 100, 100], [100, 0, 100, 100]]);
  assert.equal(view.rayAt(150, 50).pane, 1);
  near(view.rayAt(75, 25).ray.origin, [0.5, 0.5, 5]);
  assert.equal(view.rayAt(250, 50), null);
  near(view.rayAt(250, 50, 1).ray.origin, [2, 0, 5], 1e-9);
});

test("only cloth that can be grabbed is hit", () => {
  const view = viewOf([[0, 4]]);
  view.cameras = [orthographic([0, 0, 5], 2), orthographic([0, 0, 5], 2)];
  assert.equal(view.hitsCloth(50, 50), true);
  assert.equal(view.hitsCloth(5, 5), false, "beside the square");
  assert.equal(view.hitsCloth(150, 50), false, "the other pane has no cloth");
});

test("the user's moves turn all panes but flat ones", () => {
  const view = viewOf([]);
  view.cameras = [orthographic([0, 0, 5], 2), orthographic([0, 0, 5], 2)];
  view.orbit.turn(Math.PI / 2, 0);
  near(view.camera(0, 1).position, [5, 0, 0], 1e-9);
  near(view.camera(1, 1).position, [0, 0, 5]);
  near([view.azimuth()], [90], 1e-9);
});
