// What is edited: a design with hidden layers, its item and its motion; and the history of edits.

import { TABLES } from "../component/tables.js";

/**
 * @typedef {{ pattern: string, dye: string, hidden?: boolean }} EditedLayer
 * @typedef {{ target: string, count: number, name: any, lore: any[] }} Item
 * @typedef {{ wind: number, direction: number, placement: string, fabric: string, view: string, daylight: number }} Motion
 * @typedef {{ base: string, kind: string, layers: EditedLayer[], item: Item, motion: Motion }} Work
 * @typedef {{ base: string, kind: string, layers: { pattern: string, dye: string }[] }} Shown
 */

const MOST_STEPS = 200; // of a history

/** @type {Item} */
export const ITEM = { target: "@p", count: 1, name: "", lore: [] };
/** @type {Motion} */
export const MOTION = { wind: 4, direction: 0, placement: "standing", fabric: "wool", view: "front", daylight: 1 };

/** What a design is when its editing begins; what else a page knows of it stays.
 * @param {Omit<Work, "item" | "motion">} design @param {Partial<Item>} [item] @param {Motion} [motion] @returns {Work} */
export function workOf({ base, kind, layers, ...more }, item = {}, motion = MOTION) {
  const edited = layers.map(({ pattern, dye, hidden }) => ({ pattern, dye, ...(hidden && { hidden }) }));
  return { ...more, base, kind, layers: edited, item: { ...ITEM, ...item }, motion };
}

/** The design without its hidden layers.
 * @param {Work} work @returns {Shown} */
export function shownOf({ base, kind, layers }) {
  return { base, kind, layers: layers.filter(({ hidden }) => !hidden).map(({ pattern, dye }) => ({ pattern, dye })) };
}

/** Throws RangeError where there is no such layer.
 * @param {Work} work @param {number} at */
function checkPlace({ layers }, at) {
  if (!layers[at]) throw new RangeError(`there is no layer ${at + 1}; the design has ${layers.length}`);
}

/** A layer at a place, by default on top. Throws RangeError for more layers than commands give.
 * @param {Work} work @param {EditedLayer} layer @param {number} [at] @returns {Work} */
export function withLayer(work, layer, at = work.layers.length) {
  if (work.layers.length >= TABLES.maxLayers) throw new RangeError(`the design has ${TABLES.maxLayers} layers; delete one first`);
  return { ...work, layers: work.layers.toSpliced(at, 0, layer) };
}

/** @param {Work} work @param {number} at @returns {Work} */
export function withoutLayer(work, at) {
  checkPlace(work, at);
  return { ...work, layers: work.layers.toSpliced(at, 1) };
}

/** @param {Work} work @param {number} at @param {Partial<EditedLayer>} change @returns {Work} */
export function changedLayer(work, at, change) {
  checkPlace(work, at);
  return { ...work, layers: work.layers.with(at, { ...work.layers[at], ...change }) };
}

/** @param {Work} work @param {number} from @param {number} to @returns {Work} */
export function movedLayer(work, from, to) {
  checkPlace(work, from);
  checkPlace(work, to);
  return { ...work, layers: work.layers.toSpliced(from, 1).toSpliced(to, 0, work.layers[from]) };
}

/** @param {Work} work @param {number} at @returns {Work} */
export function duplicatedLayer(work, at) {
  checkPlace(work, at);
  return withLayer(work, { ...work.layers[at] }, at + 1);
}

/** A text as short as can be that the reader reads, for links: `white,creeper:lime`.
 * @param {Shown} design */
export function writeShorthand({ base, kind, layers }, between = " ") {
  const words = [base, ...layers.map(({ pattern, dye }) => `${pattern}:${dye}`)].join(between);
  return kind === "shield" ? `shield ${words}` : words;
}

/** What comes after `#` in the address of a design.
 * @param {Shown} design */
export const writeHash = (design) => encodeURI(writeShorthand(design, ","));

/** Whether a tree from outside, such as from the browser's storage, is one of ours.
 * @param {any} work */
function isWork(work) {
  const isLayer = (/** @type {any} */ layer) => typeof layer?.pattern === "string" && TABLES.dyes.includes(layer.dye);
  return (
    TABLES.dyes.includes(work?.base) &&
    ["banner", "shield"].includes(work.kind) &&
    Array.isArray(work.layers) &&
    work.layers.length <= TABLES.maxLayers &&
    work.layers.every(isLayer) &&
    Number.isInteger(work.item?.count) &&
    typeof work.item.target === "string" &&
    Array.isArray(work.item.lore)
  );
}

/** Whether a motion from outside is one of the designer's.
 * @param {any} motion */
function isMotion(motion) {
  return (
    ["wind", "direction", "daylight"].every((name) => Number.isFinite(motion?.[name])) &&
    ["placement", "fabric", "view"].every((name) => TABLES[`${name}s`].includes(motion[name]))
  );
}

// The present work, and those before and after it. Edits with one key, such as those of a slider that
// is dragged, are one step.
export class History {
  /** @param {Work} work */
  constructor(work) {
    this.work = work;
    /** @type {Work[]} */
    this.past = [];
    /** @type {Work[]} */
    this.future = [];
    this.key = "";
  }

  /** Whether anything has changed.
   * @param {Work} work @param {string} [key] */
  change(work, key = "") {
    if (JSON.stringify(work) === JSON.stringify(this.work)) return false;
    if (!key || key !== this.key) this.past = [...this.past, this.work].slice(-MOST_STEPS);
    Object.assign(this, { work, key, future: [] });
    return true;
  }

  undo() {
    return this.go(this.past, this.future);
  }

  redo() {
    return this.go(this.future, this.past);
  }

  /** @param {Work[]} from @param {Work[]} to */
  go(from, to) {
    const work = from.pop();
    if (!work) return false;
    to.push(this.work);
    Object.assign(this, { work, key: "" });
    return true;
  }

  write() {
    const { work, past, future } = this;
    return JSON.stringify({ work, past, future });
  }

  /** The history that `write` wrote; undefined for any other text. knows: whether a motion can be shown.
   * @param {string | null} text @param {(motion: any) => boolean} [knows] */
  static read(text, knows = isMotion) {
    try {
      const { work, past, future } = JSON.parse(text ?? "");
      if (past.length > MOST_STEPS || future.length > MOST_STEPS || ![work, ...past, ...future].every((each) => isWork(each) && knows(each.motion))) return undefined;
      return Object.assign(new History(work), { past, future });
    } catch {
      return undefined;
    }
  }
}
