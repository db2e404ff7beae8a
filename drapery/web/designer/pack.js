// Texture packs that a user opens: the sheets of banners and shields in a zip.

import { pixelsOf } from "../component/textures.js";
import { PACK, TITLES } from "./tables.js";

const ROOT = /^([^/]*\/)?assets\/minecraft\/textures\/(.*)\.png$/; // the folder of a pack may be in the zip
const END = 22; // the least bytes of the record at the end of a zip
const MOST = { directory: 32 << 20, file: 4 << 20, side: 512 }; // [bytes], [px]

/** @param {Blob} file @param {number} start @param {number} length */
async function viewOf(file, start, length) {
  if (start + length > file.size) throw new RangeError();
  return new DataView(await file.slice(start, start + length).arrayBuffer());
}

/** The textures in a zip by their path, and where each is.
 * @param {File} file */
async function texturesIn(file) {
  const start = Math.max(0, file.size - END - 0xffff);
  const tail = await viewOf(file, start, file.size - start);
  let at = tail.byteLength - END;
  while (at >= 0 && tail.getUint32(at, true) !== 0x06054b50) at--;
  if (at < 0) throw new RangeError();
  const [length, from] = [tail.getUint32(at + 12, true), tail.getUint32(at + 16, true)];
  if (length > MOST.directory) throw new RangeError();
  const list = await viewOf(file, from, length);
  /** @type {Map<string, { method: number, packed: number, size: number, local: number }>} */
  const found = new Map();
  for (let n = tail.getUint16(at + 10, true), place = 0; n > 0; n--) {
    const [name, extra, comment] = [28, 30, 32].map((field) => list.getUint16(place + field, true));
    const [packed, size, local] = [20, 24, 42].map((field) => list.getUint32(place + field, true));
    const path = ROOT.exec(new TextDecoder().decode(new Uint8Array(list.buffer, place + 46, name)))?.[2];
    if (path) found.set(path, { method: list.getUint16(place + 10, true), packed, size, local });
    place += 46 + name + extra + comment;
  }
  return found;
}

/** The content of a file in a zip; at most so much as the zip says.
 * @param {File} file @param {{ method: number, packed: number, size: number, local: number }} entry */
async function contentOf(file, { method, packed, size, local }) {
  if (size > MOST.file || packed > MOST.file) throw new RangeError();
  const head = await viewOf(file, local, 30);
  const start = local + 30 + head.getUint16(26, true) + head.getUint16(28, true);
  const part = file.slice(start, start + packed);
  if (method === 0) return new Uint8Array(await part.arrayBuffer());
  const reader = part.stream().pipeThrough(new DecompressionStream("deflate-raw")).getReader();
  const content = new Uint8Array(size);
  for (let at = 0, read = await reader.read(); !read.done; read = await reader.read()) {
    content.set(read.value, at); // throws for more than the zip says
    at += read.value.length;
  }
  return content;
}

/** The pixels of a square PNG. Throws an Error that says how large another one is.
 * @param {Uint8Array} content */
async function sheetOf(content) {
  const head = new DataView(content.buffer);
  const [width, height] = [16, 20].map((at) => head.getUint32(at));
  if (head.getUint32(0) !== 0x89504e47) throw new RangeError();
  if (width !== height || width > MOST.side) throw new Error(`${width} x ${height} px`);
  return pixelsOf(await createImageBitmap(new Blob([content], { type: "image/png" })), width, height);
}

/** The sheets of a pack by kind and pattern, "" for the one below all patterns; the patterns that banners lack in
 * it; and the files that cannot be used. Throws an Error for a file that is no pack for banners.
 * @param {File} file */
export async function readPack(file) {
  const found = await texturesIn(file).catch(() => {
    throw new Error(`${file.name} is no zip, or it is damaged`);
  });
  /** @type {{ banner: Record<string, ImageData>, shield: Record<string, ImageData>, lacks: string[], refused: string[] }} */
  const pack = { banner: {}, shield: {}, lacks: [], refused: [] };
  for (const kind of /** @type {const} */ (["banner", "shield"]))
    for (const name of ["", ...Object.keys(TITLES)]) {
      const paths = name ? [`entity/${kind}/${name}`] : PACK[kind];
      const path = paths.find((/** @type {string} */ each) => found.has(each));
      if (!path && name && kind === "banner") pack.lacks.push(name);
      if (!path) continue;
      try {
        pack[kind][name] = await sheetOf(await contentOf(file, /** @type {any} */ (found.get(path))));
      } catch (error) {
        const isSize = error instanceof Error && error.message.endsWith(" px");
        pack.refused.push(isSize ? `${path} (${/** @type {Error} */ (error).message})` : path);
      }
    }
  if (![pack.banner, pack.shield].some((sheets) => Object.keys(sheets).length)) throw new Error(`${file.name} has no textures of banners or shields that can be used`);
  return pack;
}
