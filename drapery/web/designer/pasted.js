// What people paste: a design in any form that `readDesign` reads, or the address of a page with the
// design after its `#`; and the name, lore and count of its item.

import { DesignError, readDesign, readItem } from "../component/design.js";
import { TABLES } from "../component/tables.js";
import { hasText } from "./commands.js";
import { ITEM, workOf } from "./model.js";

/** @typedef {import("./model.js").Item} Item */

const DESIGN_KEYS = ["banner_patterns", "base_color", "BlockEntityTag", "custom_name", "lore"];
const MOST_ITEMS = 1600; // as `drapery.banner.ItemDetails` has it
const MOST_LINES = 256;
const TARGET = /^(@[aenprs](\[[^\n]{0,200}\])?|[\w-]{1,36})$/;

/** The work of a text, and the names of what it says that is not kept. Throws DesignError.
 * @param {string} text @param {import("./model.js").Motion} [motion] */
export function readPasted(text, motion) {
  const hash = /^https?:\/\/[^\s#]+#(\S+)$/i.exec(text.trim());
  try {
    const { item, left } = detailsOf(text);
    return { work: workOf(readDesign(text), item, motion), left };
  } catch (error) {
    if (!hash || !(error instanceof DesignError)) throw error;
    return { work: workOf(readHash(hash[1], error), {}, motion), left: [] };
  }
}

/** The design after the `#` of an address. Throws DesignError: that one, if it is given.
 * @param {string} hash @param {Error} [instead] */
export function readHash(hash, instead) {
  try {
    return readDesign(decodeURIComponent(hash));
  } catch (error) {
    if (error instanceof URIError) return readDesign(hash);
    throw instead ?? error;
  }
}

/** The item of a text, and the names of what else it has.
 * @param {string} text @returns {{ item: Partial<Item>, left: string[] }} */
function detailsOf(text) {
  if (text.length > TABLES.maxText) return { item: {}, left: [] }; // the reader says so
  const read = readItem(text);
  if (!read) return { item: {}, left: [] };
  const [components, tag] = [read.components, read.tag].map(plainKeys);
  if (tag.patterns ?? tag.Patterns) return { item: {}, left: [] }; // a block
  const shown = isTree(tag.display) ? tag.display : {};
  /** @type {any[]} */
  const lines = [components.lore ?? shown.Lore ?? []].flat();
  const left = [components, tag, shown].flatMap(Object.keys).filter((key) => ![...DESIGN_KEYS, "display", "Name", "Lore"].includes(key));
  const name = parsed(components.custom_name ?? shown.Name ?? "");
  const isCount = Number.isInteger(read.count) && read.count >= 1 && read.count <= MOST_ITEMS;
  const isTarget = TARGET.test(read.target ?? ITEM.target);
  if (!isCount) left.push("count");
  if (!isTarget) left.push(`@: ${read.target?.slice(0, 40)}`);
  if (lines.length > MOST_LINES) left.push("lore");
  return {
    item: {
      name,
      lore: lines.slice(0, MOST_LINES).map(parsed),
      count: isCount ? read.count : 1,
      target: isTarget ? (read.target ?? ITEM.target) : ITEM.target,
    },
    left,
  };
}

const isTree = (/** @type {any} */ tree) => tree !== null && typeof tree === "object" && !Array.isArray(tree);

/** The entries of a compound, their keys without the game's namespace.
 * @param {any} tree @returns {Record<string, any>} */
function plainKeys(tree) {
  const entries = isTree(tree) ? Object.entries(tree) : [];
  const isState = (/** @type {string} */ key) => /^(rotation|facing)$/.test(key); // of a block
  return Object.fromEntries(entries.filter(([key]) => !isState(key)).map(([key, value]) => [key.replace(/^minecraft:/, ""), value]));
}

/** A text component: the tree of one that is JSON in a text.
 * @param {any} text */
function parsed(text) {
  if (typeof text !== "string" || !/^\s*[{["]/.test(text)) return text;
  try {
    const tree = JSON.parse(text);
    return hasText(tree) ? tree : "";
  } catch {
    return text;
  }
}
