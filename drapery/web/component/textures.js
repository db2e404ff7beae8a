// Textures of players from other addresses, in place of those of a scene.

const SIDE = 64; // width of a skin, and of a cape's texture [texels]
const EMPTY_OF_SLIM = [54, 20, 56, 32];
const FIRST_LAYER = [[0, 0, 32, 16], [0, 16, 64, 32], [16, 48, 48, 64]];
const HAT = [32, 0, 64, 32];
const MIRRORED = [
  [4, 16, 16, 4], [8, 16, 16, 4], [0, 20, 24, 12], [4, 20, 16, 12], [8, 20, 8, 12], [12, 20, 16, 12],
  [44, 16, -8, 4], [48, 16, -8, 4], [40, 20, 0, 12], [44, 20, -8, 12], [48, 20, -16, 12], [52, 20, -8, 12],
]; // of old skins: corner of a face on the right, step to that on the left, and height

// The pixels at an address: { data, width, height }; null without one.
export async function readTexture(name, address) {
  if (!address) return null;
  const image = new Image();
  Object.assign(image, { crossOrigin: "anonymous", src: address });
  const shown = address.length > 60 ? `${address.slice(0, 60)}…` : address;
  await image.decode().catch(() => {
    throw new Error(`${name}="${shown}" cannot be loaded; use a PNG file that this page may read`);
  });
  const { naturalWidth: width, naturalHeight: height } = image;
  if (!width || width % SIDE || width > 1024 || (height !== width && 2 * height !== width)) {
    throw new Error(`${name}="${shown}" is ${width} x ${height} px; use 64 x 64 or 64 x 32, or a multiple`);
  }
  const context = new OffscreenCanvas(width, height).getContext("2d");
  context.drawImage(image, 0, 0);
  return context.getImageData(0, 0, width, height);
}

// The alpha of the pixels in a part of a texture [texels], to be read or written by their places.
function* alphas({ width }, [left, top, right, bottom]) {
  const unit = width / SIDE;
  for (let y = top * unit; y < bottom * unit; y++)
    for (let x = left * unit; x < right * unit; x++) yield 4 * (y * width + x) + 3;
}

export function isSlim(skin) {
  return skin.height === skin.width && [...alphas(skin, EMPTY_OF_SLIM)].every((place) => !skin.data[place]);
}

// A skin of any layout as one of 64 x 64 texels, as `drapery.style.skins.read_skin` does it.
export function wholeSkin(skin) {
  const { width, height } = skin;
  const data = new Uint8ClampedArray(4 * width * width);
  const whole = { data, width, height: width };
  data.set(skin.data);
  if (height < width) {
    const unit = width / SIDE;
    for (const [left, top, step, rows] of MIRRORED)
      for (let y = top * unit; y < (top + rows) * unit; y++)
        for (let x = 0; x < 4 * unit; x++) {
          const from = 4 * (y * width + left * unit + x);
          const to = (y + 32 * unit) * width + (left + step + 4) * unit - 1 - x;
          data.set(skin.data.subarray(from, from + 4), 4 * to);
        }
    const hat = [...alphas(whole, HAT)]; // an old skin without alpha has no hat
    if (hat.every((place) => data[place] > 127)) hat.forEach((place) => (data[place] = 0));
  }
  for (const part of FIRST_LAYER) for (const place of alphas(whole, part)) data[place] = 255;
  return whole;
}

// The header and arrays of a scene with other textures, which lie below its own.
export function retextured(header, arrays, textures) {
  const every = Object.entries(textures);
  let [width, height] = header.atlas;
  const parts = [{ data: arrays.atlas, width, height }, ...every.map(([, texture]) => texture)];
  const layers = arrays.layers.slice();
  for (const [name, texture] of every) {
    const { vertices, area } = header.textures[name];
    const [x, y, ...size] = area.map((length) => (length * texture.width) / SIDE);
    for (const vertex of vertices)
      layers.set([x, y + height, ...size, 255, 255, 255], 7 * arrays.materials[4 * arrays.vertexMaterials[vertex]]);
    height += texture.height;
    width = Math.max(width, texture.width);
  }
  const atlas = new Uint8Array(4 * width * height);
  let row = 0;
  for (const part of parts)
    for (let y = 0; y < part.height; y++, row++)
      atlas.set(part.data.subarray(4 * y * part.width, 4 * (y + 1) * part.width), 4 * row * width);
  return [{ ...header, atlas: [width, height] }, { ...arrays, atlas, layers }];
}
