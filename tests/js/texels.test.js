import assert from "node:assert/strict";
import { test } from "node:test";

import { composited } from "../../drapery/web/viewer/texels.js";

const ATLAS = [
  168, 229, 184, 0, 238, 171, 20, 206, 245, 153, 204, 5, 37, 53, 213, 206, 192, 173, 6, 120, 63, 96, 236, 131,
  118, 4, 87, 161, 124, 71, 42, 255, 237, 16, 194, 250, 10, 103, 206, 13, 143, 2, 38, 71, 133, 118, 36, 98,
  196, 35, 57, 146, 50, 179, 145, 104, 206, 53, 141, 33, 181, 39, 151, 11, 180, 138, 66, 0, 165, 98, 123, 12,
  144, 184, 24, 38, 129, 1, 202, 255, 85, 54, 228, 48, 127, 169, 1, 167, 109, 247, 16, 192, 78, 220, 8, 60,
]; // 6 x 4 texels
// Left, top, width and height in the atlas, and a tint.
const LAYERS = [[0, 0, 2, 2, 255, 255, 255], [2, 0, 4, 4, 200, 100, 50], [0, 2, 2, 2, 249, 128, 29]];

// What drapery.render.flatten makes of the three layers in each alpha mode.
const LOWER = [
  127, 19, 68, 255, 122, 17, 73, 255, 126, 1, 23, 255, 126, 1, 23, 255,
  113, 20, 68, 255, 111, 52, 26, 255, 126, 1, 23, 255, 126, 1, 23, 255,
];
const WANTED = {
  opaque: [
    181, 107, 81, 255, 133, 36, 33, 255, 137, 110, 13, 255, 103, 98, 26, 255,
    189, 15, 21, 255, 178, 104, 79, 255, 140, 110, 16, 255, 131, 110, 15, 255, ...LOWER,
  ],
  cutout: [
    0, 0, 0, 0, 0, 0, 0, 0, 137, 110, 13, 255, 103, 98, 26, 255,
    0, 0, 0, 0, 0, 0, 0, 0, 140, 110, 16, 255, 131, 110, 15, 255, ...LOWER,
  ],
  blend: [
    191, 19, 6, 148, 130, 19, 20, 234, 130, 105, 13, 240, 96, 93, 27, 241,
    189, 13, 20, 253, 184, 19, 7, 152, 131, 104, 16, 234, 123, 105, 15, 237,
    129, 24, 61, 185, 124, 24, 66, 178, 126, 1, 23, 255, 126, 1, 23, 255,
    111, 26, 61, 190, 110, 58, 19, 228, 126, 1, 23, 255, 126, 1, 23, 255,
  ],
};

test("the layers of a material become the texels that Python makes of them", () => {
  const materials = Int32Array.from([0, 1, 2].flatMap((mode) => [0, 3, mode, 1]));
  const { texels, size, rects } = composited(Uint8Array.from(ATLAS), 6, materials, Int32Array.from(LAYERS.flat()));
  Object.keys(WANTED).forEach((mode, number) => {
    const [left, top, width, height] = rects[number];
    const rows = Array.from({ length: height }, (_, y) => 4 * ((top + y) * size[0] + left));
    const found = rows.flatMap((from) => [...texels.subarray(from, from + 4 * width)]);
    assert.deepEqual(found, WANTED[mode], mode);
  });
});
