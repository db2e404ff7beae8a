// A player in a skin that a user opens, whose cape has the design.

import { DraperyBanner } from "../component/element.js";
import { define } from "../component/places.js";
import { isSlim, pixelsOfSkin, wholeSkin } from "../component/textures.js";

const CAPE_SIDE = 64; // of the sheet of a design, whose face begins at 1, 1

/** The pixels of a skin. Throws an Error for another file.
 * @param {File} file */
export async function readSkin(file) {
  const image = await createImageBitmap(file).catch(() => {
    throw new Error(`${file.name} is no picture, or it is damaged`);
  });
  return pixelsOfSkin(image, image.width, image.height, file.name);
}

/** The sheet of a cape with a face on it.
 * @param {ImageData} face */
export function capeOf(face) {
  const sheet = new ImageData(CAPE_SIDE, CAPE_SIDE);
  for (let at = 0; at < CAPE_SIDE * CAPE_SIDE; at++) {
    const [x, y] = [at % CAPE_SIDE, Math.floor(at / CAPE_SIDE)].map((texel) => Math.max(0, texel - 1));
    const from = 4 * (Math.min(y, face.height - 1) * face.width + Math.min(x, face.width - 1));
    sheet.data.set(face.data.subarray(from, from + 4), 4 * at);
  }
  return sheet;
}

// Its `pack` has the pixels of the skin and those of the cape.
export class DraperyWearer extends DraperyBanner {
  async source() {
    const { skin, cape } = /** @type {any} */ (this.pack);
    return [isSlim(skin) ? "wearer-slim" : "wearer", { textures: { skin: wholeSkin(skin), cape } }];
  }
}

define("drapery-wearer", DraperyWearer);
