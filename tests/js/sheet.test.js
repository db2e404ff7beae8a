import assert from "node:assert/strict";
import { test } from "node:test";

import { Sheet } from "../../drapery/web/component/sheet.js";

test("a player that cannot be drawn is told once and does not stop the others", () => {
  globalThis.devicePixelRatio = 1;
  const found = { drawn: [], copied: [], failed: [] };
  const gl = new Proxy({ canvas: {}, isContextLost: () => false }, { get: (own, name) => own[name] ?? (() => null) });
  const player = (name, act) => ({
    canvas: { width: 10, height: 20, getContext: () => ({ drawImage: () => found.copied.push(name) }) },
    fit: () => true,
    drawInto: act,
  });
  const fault = new Error("no scene");
  const broken = player("broken", () => {
    throw fault;
  });
  const whole = player("whole", () => found.drawn.push("whole"));
  new Sheet(gl, (...failure) => found.failed.push(failure)).draw([broken, whole]);
  assert.deepEqual(found, { drawn: ["whole"], copied: ["whole"], failed: [[broken, fault]] });
});
