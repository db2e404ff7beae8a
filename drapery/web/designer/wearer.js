// A player in a skin that a user opens, who has the design as cape, tabard or shield.

import { DraperyBanner } from "../component/element.js";
import { define } from "../component/places.js";
import { isSlim, pixelsOfSkin, wholeSkin } from "../component/textures.js";
import { SIDE_UNITS } from "./faces.js";

/** The pixels of a skin. Throws an Error for another file.
 * @param {File} file */
export async function readSkin(file) {
  const image = await createImageBitmap(file).catch(() => {
    throw new Error(`${file.name} is no picture, or it is damaged`);
  });
  return pixelsOfSkin(image, image.width, image.height, file.name);
}

/** The sheet of a design with a face on it, at 1, 1; cloth has it on its edges and its back, too.
 * @param {ImageData} face @param {boolean} isCloth */
export function sheetWith(face, isCloth) {
  const sheet = new ImageData(SIDE_UNITS, SIDE_UNITS);
  for (let at = 0; at < SIDE_UNITS * SIDE_UNITS; at++) {
    const [x, y] = [at % SIDE_UNITS, Math.floor(at / SIDE_UNITS)].map((texel) => texel - 1);
    const [left, top] = [Math.max(0, Math.min(x, face.width - 1)), Math.max(0, Math.min(y, face.height - 1))];
    const from = 4 * (top * face.width + left);
    if (isCloth || (x === left && y === top)) sheet.data.set(face.data.subarray(from, from + 4), 4 * at);
  }
  return sheet;
}

// Its `pack` has the pixels of the skin, what has the design (a cape, a tabard or a shield), the sheet of that, and the
// one that a shield has below all patterns, on its back and handle too, where a texture pack has it.
export class DraperyWearer extends DraperyBanner {
  async source() {
    const { skin, garment, sheet, shieldBase } = /** @type {any} */ (this.pack);
    const ofShield = { shield: sheet, ...(shieldBase && { shieldBase }) };
    const textures = { skin: wholeSkin(skin), ...(garment === "shield" ? ofShield : { cape: sheet }) };
    return [`wearer-${garment}${isSlim(skin) ? "-slim" : ""}`, { textures }];
  }
}

define("drapery-wearer", DraperyWearer);
