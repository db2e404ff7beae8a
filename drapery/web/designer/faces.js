// Flat faces of designs, of the textures that the live cloth has: for previews of all patterns.

import { fileBytes } from "../component/shared.js";
import { TABLES } from "../component/tables.js";
import { retextured } from "../component/textures.js";
import { unpack } from "../viewer/messages.js";

/** @typedef {{ pattern: string, dye: string }} Layer */

export const SIDE_UNITS = 64; // of the sheet of a design
/** @type {Record<string, { file: string, width: number, height: number }>} */
const FRONTS = { banner: { file: "standing.bin", width: 20, height: 40 }, shield: { file: "shield.bin", width: 12, height: 22 } }; // whose left top is at 1, 1 of 64 [texels]

export class Faces {
  /** The faces of banners or shields, of other textures where a pack has them.
   * @param {string} kind @param {Record<string, ImageData>} [textures] */
  static async open(kind, textures = {}) {
    const { header, arrays } = retextured(unpack((await fileBytes(FRONTS[kind].file)).buffer), textures);
    return new Faces(header, arrays, FRONTS[kind]);
  }

  /** The faces that `drapery.web.face_file` wrote.
   * @param {ArrayBuffer} message */
  static read(message) {
    const { header, arrays } = unpack(message);
    const faces = new Faces(header, arrays, header.front);
    const size = 4 * header.front.width * header.front.height;
    header.sheets.forEach((/** @type {string} */ name, /** @type {number} */ at) => faces.masks.set(name, arrays.masks.subarray(size * at, size * (at + 1))));
    return faces;
  }

  /** @param {any} header @param {any} arrays @param {{ width: number, height: number }} front */
  constructor(header, arrays, front) {
    this.front = front;
    this.header = header;
    this.arrays = arrays;
    /** @type {Map<string, Uint8Array>} */
    this.masks = new Map();
    /** @type {Faces | undefined} */
    this.reduced = undefined;
  }

  // The same of one texel a unit, of which all patterns are drawn at once.
  get small() {
    const { scale = 1 } = this.header;
    if (scale === 1) return this;
    const front = { width: this.front.width / scale, height: this.front.height / scale };
    this.reduced ??= new Faces({ ...this.header, scale: 1 }, this.arrays, front);
    for (const [name, mask] of this.reduced.masks.size ? [] : this.masks) {
      const texels = new Uint32Array(mask.slice().buffer);
      const middle = (/** @type {number} */ at) => at * scale + (scale >> 1);
      const placed = Uint32Array.from({ length: front.width * front.height }, (_, at) => texels[middle(Math.floor(at / front.width)) * this.front.width + middle(at % front.width)]);
      this.reduced.masks.set(name, new Uint8Array(placed.buffer));
    }
    return this.reduced;
  }

  get patterns() {
    return this.header.sheets.filter((/** @type {string} */ name) => name);
  }

  /** The texels of a pattern's front; of the cloth itself for "". Throws Error for another name.
   * @param {string} pattern */
  mask(pattern) {
    const known = this.masks.get(pattern);
    if (known) return known;
    const sheet = this.header.sheets.indexOf(pattern);
    if (sheet < 0) throw new Error(`there is no texture of the pattern '${pattern}' here`);
    const { atlas, layers } = this.arrays;
    const first = this.arrays.materials[4 * this.arrays.vertexMaterials[this.header.flag]];
    const [left, top, width, height] = layers.subarray(7 * (first + sheet));
    const wide = this.header.atlas[0];
    const mask = new Uint8Array(4 * this.front.width * this.front.height);
    for (let at = 0; at < mask.length / 4; at++) {
      const [x, y] = [at % this.front.width, Math.floor(at / this.front.width)].map((texel) => texel + 1.5);
      const from = 4 * ((top + Math.floor((y * height) / SIDE_UNITS)) * wide + left + Math.floor((x * width) / SIDE_UNITS));
      mask.set(atlas.subarray(from, from + 4), 4 * at);
    }
    this.masks.set(pattern, mask);
    return mask;
  }

  /** The face of a design, as `drapery.banner.composite` makes it, without patterns that are not here: RGBA.
   * @param {{ base: string, layers: Layer[] }} design */
  face(design) {
    return new ImageData(this.texels(design), this.front.width);
  }

  /** @param {{ base: string, layers: Layer[] }} design */
  texels({ base, layers }) {
    const pixels = new Uint8ClampedArray(this.mask(""));
    for (let at = 3; at < pixels.length; at += 4) pixels[at] = 255;
    for (const layer of [{ pattern: "base", dye: base }, ...layers]) if (this.patterns.includes(layer.pattern)) this.lay(pixels, layer);
    return pixels;
  }

  /** Lay a pattern over pixels.
   * @param {Uint8ClampedArray} pixels @param {Layer} layer */
  lay(pixels, { pattern, dye }) {
    const mask = this.mask(pattern);
    const rgb = TABLES.rgb[dye];
    for (let at = 0; at < pixels.length; at += 4) {
      const alpha = mask[at + 3];
      if (!alpha) continue;
      for (let channel = 0; channel < 3; channel++) {
        const dyed = Math.round((mask[at + channel] * rgb[channel]) / 255);
        pixels[at + channel] = Math.round((alpha * dyed + (255 - alpha) * pixels[at + channel]) / 255);
      }
    }
  }

  /** The faces of a design with each pattern at a place, beside each other in one picture. Where a
   * pattern would not be seen in the dye, it has another one.
   * @param {{ base: string, layers: Layer[] }} design @param {number} at @param {string} dye @param {string[]} patterns */
  previews({ base, layers }, at, dye, patterns) {
    const below = this.texels({ base, layers: layers.slice(0, at) });
    const above = layers.slice(at);
    const { width, height } = this.front;
    const sheet = new ImageData(width * patterns.length, height);
    patterns.forEach((pattern, number) => {
      let face = below.slice();
      this.lay(face, { pattern, dye });
      if (difference(below, face) < 0.005) this.lay((face = below.slice()), { pattern, dye: unlike(dye) });
      for (const layer of above) this.lay(face, layer);
      for (let row = 0; row < height; row++)
        sheet.data.set(face.subarray(4 * width * row, 4 * width * (row + 1)), 4 * (row * sheet.width + number * width));
    });
    return sheet;
  }

  /** A design of so many layers, each of which is seen.
   * @param {() => number} chance from 0 to 1 */
  random(chance = Math.random) {
    const one = (/** @type {string[]} */ list) => list[Math.floor(chance() * list.length)];
    const left = [...TABLES.dyes]; // no two alike: layers in the dye of their field are not seen
    const dyes = [0, 1, 2].map(() => left.splice(Math.floor(chance() * left.length), 1)[0]);
    const design = { base: dyes[0], kind: "banner", layers: /** @type {Layer[]} */ ([]) };
    const most = 3 + Math.floor(chance() * 3);
    for (let tries = 0; design.layers.length < most && tries < 60; tries++) {
      const layer = { pattern: one(this.patterns.filter((/** @type {string} */ name) => name !== "base")), dye: one(dyes) };
      const layers = [...design.layers, layer];
      if (layers.every((_, number) => this.isSeen(design.base, layers, number))) design.layers = layers;
    }
    return design;
  }

  /** Whether a layer changes what is seen of a design.
   * @param {string} base @param {Layer[]} layers @param {number} number */
  isSeen(base, layers, number) {
    const without = this.texels({ base, layers: layers.toSpliced(number, 1) });
    return difference(without, this.texels({ base, layers })) > 0.02;
  }

  /** The layers that change no texel, as `drapery.banner.simplify` leaves them out: of two alike the lower one.
   * A pattern that is not here may be seen.
   * @param {{ base: string, layers: Layer[] }} design */
  unseen({ base, layers }) {
    const whole = this.texels({ base, layers });
    let left = layers;
    for (const layer of layers.filter(({ pattern }) => this.patterns.includes(pattern))) {
      const without = left.filter((each) => each !== layer);
      if (!difference(whole, this.texels({ base, layers: without }))) left = without;
    }
    return layers.filter((each) => !left.includes(each));
  }
}

/** Black or white, whichever is less like a dye.
 * @param {string} dye */
export const unlike = (dye) => (TABLES.rgb[dye].reduce((/** @type {number} */ sum, /** @type {number} */ part) => sum + part) > 382 ? "black" : "white");

/** The mean difference of two pictures, of 1.
 * @param {Uint8ClampedArray} one @param {Uint8ClampedArray} other */
function difference(one, other) {
  let sum = 0;
  for (let at = 0; at < one.length; at++) sum += Math.abs(one[at] - other[at]);
  return sum / (255 * 3 * (one.length / 4));
}
