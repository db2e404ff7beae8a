// What a design takes to make by hand, as `drapery.banner.crafting_items` has it, and the steps at the loom.

import { HIDDEN, drawPixels, make } from "./dom.js";
import { ITEMS } from "./tables.js";

/** @type {Record<string, string>} */
const FOUND = { globe: "fromCartographer", piglin: "fromBastion", flow: "fromTrial", guster: "fromTrial" }; // pattern items

/** @typedef {{ item: string, count: number, dye?: string, pattern?: string }} Material */

/** From wool to pattern items, which the loom keeps and which name their pattern.
 * @param {import("./model.js").Shown} design @returns {Material[]} */
export function materials({ base, kind, layers }) {
  const dyes = layers.map(({ dye }) => dye);
  const needed = [...new Set(layers.map(({ pattern }) => pattern))].filter((pattern) => Object.hasOwn(ITEMS, pattern));
  const crafted = needed.map((pattern) => ITEMS[pattern]).filter(Boolean);
  return [
    { item: "wool", dye: base, count: 6 },
    { item: "stick", count: 1 },
    ...(kind === "shield" ? [{ item: "shield", count: 1 }] : []),
    ...[...new Set(dyes)].map((dye) => ({ item: "dye", dye, count: dyes.filter((each) => each === dye).length })),
    ...(crafted.length ? [{ item: "paper", count: crafted.length }] : []),
    ...crafted.map((item) => ({ item, count: 1 })),
    ...needed.map((pattern) => ({ item: "bannerPattern", pattern, count: 1 })),
  ];
}

/** The lists of the items and of the steps, with small faces.
 * @param {import("./model.js").Shown} design @param {import("./faces.js").Faces} faces @param {import("./editor.js").Editor} words */
export function recipe(design, faces, { say, caption, dyeTitle }) {
  const row = (/** @type {any} */ shown, /** @type {string} */ text, /** @type {string[]} */ ...notes) => {
    const canvas = make("canvas", HIDDEN);
    if (shown) drawPixels(canvas, faces.small.face(shown));
    return make("li", {}, canvas, text, make("span", { class: "hint" }, notes.join(", ")));
  };
  const item = (/** @type {string} */ pattern) => say("bannerPattern", { pattern: caption(pattern) });
  const items = materials(design).map((each) => {
    const { count, dye, pattern } = each;
    if (pattern) return row({ base: "white", layers: [{ pattern, dye: "black" }] }, `${count} × ${item(pattern)}`, say("kept"), ...(FOUND[pattern] ? [say(FOUND[pattern])] : []));
    return dye ? row({ base: dye, layers: [] }, `${count} × ${say(each.item)} (${dyeTitle(dye)})`) : row(null, `${count} × ${say(each.item)}`);
  });
  const steps = design.layers.map(({ pattern, dye }, at) =>
    row({ ...design, layers: design.layers.slice(0, at + 1) }, `${dyeTitle(dye)}: ${caption(pattern)}`, ...(Object.hasOwn(ITEMS, pattern) ? [item(pattern)] : [])));
  return [make("ul", { class: "loom" }, ...items), make("ol", { class: "loom" }, ...steps)];
}
