// Textures of players from other addresses, in place of those of a scene.

import { short } from "./attributes.js";
import { TABLES } from "./tables.js";

const { side: SIDE, base: FIRST_LAYER, hat: HAT, emptyOfSlim: EMPTY_OF_SLIM, moved: MOVED } = TABLES.skin;

// The pixels at an address: { data, width, height }; null without one.
export async function readTexture(name, address) {
  if (!address) return null;
  const image = new Image();
  Object.assign(image, { crossOrigin: "anonymous", src: address });
  const shown = `${name}="${short(address)}"`;
  await image.decode().catch(() => {
    throw new Error(`${shown} cannot be loaded; use a PNG file that this page may read`);
  });
  const { naturalWidth: width, naturalHeight: height } = image;
  if (!width || width % SIDE || width > 1024 || (height !== width && 2 * height !== width)) {
    throw new Error(`${shown} is ${width} x ${height} px; use 64 x 64 or 64 x 32, or a multiple`);
  }
  const context = new OffscreenCanvas(width, height).getContext("2d");
  context.drawImage(image, 0, 0);
  return context.getImageData(0, 0, width, height);
}

// The places of the texels in a part of a texture so wide: left, top, right, bottom of 64. A part whose
// left is on the right has its columns from there.
function places(width, part) {
  const [left, top, right, bottom] = part.map((each) => (each * width) / SIDE);
  const wide = Math.abs(right - left);
  const column = (x) => (left < right ? left + x : left - 1 - x);
  return Array.from({ length: wide * (bottom - top) }, (_, n) => (top + Math.floor(n / wide)) * width + column(n % wide));
}

export function isSlim({ data, width, height }) {
  return height === width && places(width, EMPTY_OF_SLIM).every((place) => !data[4 * place + 3]);
}

// A skin of any layout as one of 64 x 64 texels, as `drapery.style.skins.read_skin` does it.
export function wholeSkin({ data: given, width, height }) {
  const data = new Uint8ClampedArray(4 * width * width);
  const texels = new Uint32Array(data.buffer);
  const setAlpha = (part, alpha) => places(width, part).forEach((place) => (data[4 * place + 3] = alpha));
  data.set(given);
  if (height < width) {
    for (const [from, to] of MOVED.map((pair) => pair.map((part) => places(width, part))))
      to.forEach((place, number) => (texels[place] = texels[from[number]]));
    // An old skin without alpha has no hat.
    if (places(width, HAT).every((place) => data[4 * place + 3] > 127)) setAlpha(HAT, 0);
  }
  FIRST_LAYER.forEach((part) => setAlpha(part, 255));
  return { data, width, height: width };
}

// A scene with other textures, which lie below its own.
export function retextured(scene, textures) {
  const { header, arrays } = scene;
  if (!Object.keys(textures).length) return scene;
  const [width, height] = header.atlas;
  const parts = [["", { data: arrays.atlas, width, height }], ...Object.entries(textures)];
  const wide = Math.max(...parts.map(([, part]) => part.width));
  const high = parts.reduce((sum, [, part]) => sum + part.height, 0);
  const atlas = new Uint8Array(4 * wide * high);
  const layers = arrays.layers.slice();
  let row = 0;
  for (const [name, part] of parts) {
    const { shown = [], area = [] } = header.textures?.[name] ?? {};
    const [x, y, ...size] = area.map((length) => (length * part.width) / SIDE);
    for (const layer of shown) layers.set([x, y + row, ...size, 255, 255, 255], 7 * layer);
    for (let y = 0; y < part.height; y++, row++)
      atlas.set(part.data.subarray(4 * y * part.width, 4 * (y + 1) * part.width), 4 * row * wide);
  }
  return { header: { ...header, atlas: [wide, high] }, arrays: { ...arrays, atlas, layers } };
}
