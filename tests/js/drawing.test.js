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

test("a pane with an opaque background does not hide the next one", () => {
  const { found, gl } = recording();
  const drawing = Object.assign(Object.create(Drawing.prototype), { gl });
  const pane = { solid: [0, 1, 2], blend: [], start: 0 };
  const [left, right] = [[0, 0, 8, 8], [8, 0, 8, 8]];
  drawing.drawPane({ ...pane, background: [0, 0, 0, 255] }, left, [], []);
  drawing.drawPane({ ...pane, background: [0, 0, 0, 0] }, right, [], []);
  assert.deepEqual(found.drawn, [left, right]);
});
