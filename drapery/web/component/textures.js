// Textures of players from other addresses, in place of those of a scene.

import { packed } from "../viewer/packing.js";
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
  return pixelsOfSkin(image, image.naturalWidth, image.naturalHeight, shown);
}

// The pixels of a picture that has the size of skins and capes; shown: what an error calls it.
export function pixelsOfSkin(image, width, height, shown) {
  if (!width || width % SIDE || width > 1024 || (height !== width && 2 * height !== width)) {
    throw new Error(`${shown} is ${width} x ${height} px; use 64 x 64 or 64 x 32, or a multiple`);
  }
  return pixelsOf(image, width, height);
}

// The pixels of a picture: { data, width, height }.
export function pixelsOf(image, width, height) {
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

// The layers that show a texture of a scene, and which part of one 64 texels wide. Pole and handle show the
// sheet below all patterns, too.
function showingLayers({ header, arrays: { layers, materials, vertexMaterials } }, name) {
  const sheet = header.sheets?.indexOf(name) ?? -1;
  if (sheet < 0) return { shown: [], area: [], ...header.textures?.[name] };
  const own = materials[4 * vertexMaterials[header.flag]] + sheet;
  const placeOf = (layer) => String(layers.subarray(7 * layer, 7 * layer + 4));
  const every = name ? [own] : [...Array(layers.length / 7).keys()].filter((layer) => placeOf(layer) === placeOf(own));
  return { shown: every, area: [0, 0, SIDE, SIDE] };
}

// A scene with other textures, which lie below its own. textures: pixels by name.
export function retextured(scene, textures) {
  const { header, arrays } = scene;
  const parts = Object.entries(textures);
  if (!parts.length) return scene;
  const [wide, high] = header.atlas;
  const widest = Math.max(wide, ...parts.map(([, part]) => 8 * part.width));
  const { places, size } = packed(parts.map(([, { width, height }]) => [width, height]), widest);
  const width = Math.max(wide, size[0]);
  const atlas = new Uint8Array(4 * width * (high + size[1]));
  const layers = arrays.layers.slice();
  const copy = (from, left, top) => {
    for (let row = 0; row < from.height; row++)
      atlas.set(from.data.subarray(4 * row * from.width, 4 * (row + 1) * from.width), 4 * ((top + row) * width + left));
  };
  copy({ data: arrays.atlas, width: wide, height: high }, 0, 0);
  parts.forEach(([name, part], number) => {
    const { shown, area } = showingLayers(scene, name);
    const [left, top] = [places[number][0], high + places[number][1]];
    const [x, y, ...extent] = area.map((length) => (length * part.width) / SIDE);
    copy(part, left, top);
    for (const layer of shown) layers.set([x + left, y + top, ...extent, 255, 255, 255], 7 * layer);
  });
  return { header: { ...header, atlas: [width, high + size[1]] }, arrays: { ...arrays, atlas, layers } };
}
