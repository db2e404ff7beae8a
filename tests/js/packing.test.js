import assert from "node:assert/strict";
import { test } from "node:test";

import { packed } from "../../drapery/web/viewer/packing.js";

test("rectangles lie in rows beside each other, the highest first", () => {
  const { places, size } = packed([[30, 10], [40, 20], [50, 20]], 100);
  assert.deepEqual(places, [[0, 20], [0, 0], [40, 0]]);
  assert.deepEqual(size, [90, 30]);
});

test("a rectangle wider than all has a row of its own", () => {
  const { places, size } = packed([[10, 9], [300, 8], [10, 7]], 100);
  assert.deepEqual(places, [[0, 0], [0, 9], [0, 17]]);
  assert.deepEqual(size, [300, 24]);
  assert.deepEqual(packed([], 100), { places: [], size: [0, 0] });
});
