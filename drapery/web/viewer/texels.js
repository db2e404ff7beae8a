// What the materials of a scene show without light, in one texture: the layers of each material are
// composited once, with the whole numbers of `drapery.render.flatten`.

import { packed } from "./packing.js";

const CUTOUT = 1;
export const BLEND = 2;
const FINEST = 4096; // longest side of a material [texels]

// atlas: texels, and their width. materials: rows of first layer, number of layers, alpha mode, and
// whether it is lit. layers: rows of left, top, width and height in the atlas, and a tint.
// Returns the texels in straight alpha, their width and height, and each material's rectangle.
export function composited(atlas, width, materials, layers) {
  const every = Array.from({ length: materials.length / 4 }, (_, row) => {
    const [first, count, mode] = materials.subarray(4 * row);
    const own = Array.from({ length: count }, (_, upper) => layers.subarray(7 * (first + upper), 7 * (first + upper + 1)));
    return { mode, layers: own, size: [2, 3].map((side) => own.map((layer) => layer[side]).reduce(common)) };
  });
  const sizes = every.map((material) => material.size);
  const area = sizes.reduce((sum, [wide, high]) => sum + wide * high, 0);
  const { places, size } = packed(sizes, Math.max(Math.ceil(Math.sqrt(area)), ...sizes.map(([wide]) => wide)));
  const texels = new Uint8Array(4 * size[0] * size[1]);
  const rects = places.map((place, row) => [...place, ...sizes[row]]);
  for (const [row, { mode, layers: own }] of every.entries())
    for (const [number, layer] of own.entries()) {
      const opacity = (alpha, below) => opacityOf(mode, number, alpha, below);
      layOver(layer, { data: atlas, width }, { data: texels, width: size[0] }, rects[row], opacity);
    }
  return { texels, size, rects };
}

// In so many texels those of two layers are whole: the least common multiple.
function common(a, b) {
  const divisor = (x, y) => (y ? divisor(y, x % y) : x);
  const multiple = (a / divisor(a, b)) * b;
  return multiple <= FINEST ? multiple : Math.max(a, b);
}

// The lowest layer of an opaque material covers; that of a cut-out one covers or leaves a hole.
function opacityOf(mode, number, alpha, below) {
  if (mode === BLEND) return alpha;
  if (!number) return mode === CUTOUT && alpha < 128 ? 0 : 255;
  return below && alpha;
}

// Lay a layer over the texels in a rectangle.
function layOver([fromX, fromY, wide, high, ...tint], atlas, into, [left, top, width, height], opacity) {
  for (let y = 0; y < height; y++)
    for (let x = 0; x < width; x++) {
      const row = fromY + Math.floor((y * high) / height);
      const from = 4 * (row * atlas.width + fromX + Math.floor((x * wide) / width));
      const to = 4 * ((top + y) * into.width + left + x);
      const below = into.data[to + 3];
      const alpha = opacity(atlas.data[from + 3], below);
      if (!alpha) continue;
      const share = 255 * alpha;
      const rest = below * (255 - alpha);
      const total = share + rest;
      for (let side = 0; side < 3; side++) {
        const own = Math.floor((atlas.data[from + side] * tint[side] + 127) / 255);
        into.data[to + side] = Math.floor((share * own + rest * into.data[to + side] + (total >> 1)) / total);
      }
      into.data[to + 3] = Math.floor((total + 127) / 255);
    }
}
