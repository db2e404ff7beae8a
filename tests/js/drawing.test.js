import assert from "node:assert/strict";
import { test } from "node:test";

import { Drawing } from "../../drapery/web/viewer/drawing.js";

// A context that remembers where its scissor lies at each drawing; node has no WebGL.
function recording() {
  const found = { scissor: null, drawn: [] };
  const calls = {
    scissor: (...rect) => (found.scissor = rect),
    drawElements: () => found.drawn.push(found.scissor),
  };
  return { found, gl: new Proxy(calls, { get: (own, name) => own[name] ?? (() => null) }) };
}

test("a scene with an opaque background does not hide the next one", () => {
  const { found, gl } = recording();
  const [left, right] = [[0, 0, 8, 8], [8, 0, 8, 8]];
  for (const [rect, alpha] of [[left, 255], [right, 0]]) {
    const scene = { header: { background: [0, 0, 0, alpha] } };
    const drawing = Object.assign(Object.create(Drawing.prototype), { gl, scene, solid: [0, 1, 2], blend: [] });
    drawing.draw(rect, [], []);
  }
  assert.deepEqual(found.drawn, [left, right]);
});
