// What a design takes to make by hand, as `drapery.banner.crafting_items` has it.

import { ITEMS } from "./tables.js";

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
