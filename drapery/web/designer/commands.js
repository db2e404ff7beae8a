// Commands of every version that give a design with its name, lore and count, as
// `drapery.banner.write_give` writes them.

import { TABLES } from "../component/tables.js";
import { Token } from "../component/design.js";
import { CODES } from "./tables.js";

/** @typedef {import("./model.js").Item} Item */
/** @typedef {import("./model.js").Shown} Shown */

export const VERSIONS = ["1.21.5", "1.20.5", "1.13", "1.8", "bedrock"];

// A form of that version cannot hold the design.
export class FormError extends Error {}

/** The text for a version: a command, or for Bedrock, whose commands give no layers, the data of a
 * block. Throws FormError.
 * @param {string} version @param {Shown} design @param {Item} item @returns {string} */
export function writeCommand(version, design, item) {
  const count = item.count > 1 ? ` ${item.count}` : "";
  if (version === "1.21.5") return `/give ${item.target} ${withComponents(design, item, (line) => line)}${count}`;
  if (version === "1.20.5") return `/give ${item.target} ${withComponents(design, item, asJson)}${count}`;
  if (version === "1.13") return `/give ${item.target} ${withTag(design, item)}${count}`;
  if (version === "1.8") return numbered(design, item);
  return writeSnbt(ofBedrock(design));
}

/** What a version's text does not keep of an item.
 * @param {string} version @param {Item} item @returns {("name" | "lore" | "count" | "looks")[]} */
export function notKept(version, { name, lore, count }) {
  /** @type {("name" | "lore" | "count" | "looks")[]} */
  const lost = [];
  const isPlain = (/** @type {any} */ line) => typeof line === "string" || Object.keys(line).join() === "text";
  if (version === "1.8" && ![name, ...lore].every(isPlain)) lost.push("looks");
  if (version !== "bedrock") return lost;
  if (name) lost.push("name");
  if (lore.length) lost.push("lore");
  return count === 1 ? lost : [...lost, "count"];
}

/** @param {Shown} design @param {Item} item @param {(line: any) => any} asText */
function withComponents({ base, kind, layers }, { name, lore }, asText) {
  const parts = kind === "shield" ? [`base_color="${base}"`] : [];
  if (layers.length) parts.push(`banner_patterns=${writeSnbt(layers.map(({ pattern, dye }) => ({ pattern, color: dye })))}`);
  if (hasText(name)) parts.push(`custom_name=${writeSnbt(asText(name))}`);
  if (lore.length) parts.push(`lore=${writeSnbt(lore.map(asText))}`);
  const id = kind === "shield" ? "minecraft:shield" : `minecraft:${base}_banner`;
  return parts.length ? `${id}[${parts.join(",")}]` : id;
}

/** @param {Shown} design @param {Item} item */
function withTag({ base, kind, layers }, item) {
  const rows = codedLayers("1.13", layers, dyeNumber);
  const patterns = rows.length ? { Patterns: rows } : {};
  const isShield = kind === "shield";
  const entity = isShield ? { Base: dyeNumber(base), ...patterns } : patterns;
  const tag = { ...(isShield || rows.length ? { BlockEntityTag: entity } : {}), ...display(item, asJson) };
  const id = isShield ? "minecraft:shield" : `minecraft:${base}_banner`;
  return Object.keys(tag).length ? id + writeSnbt(tag) : id;
}

/** @param {Shown} design @param {Item} item */
function numbered({ base, kind, layers }, item) {
  if (kind === "shield") throw new FormError("Java 1.8 to 1.12: this form cannot hold shields");
  const rows = codedLayers("1.8", layers, fromBlack);
  const number = fromBlack(base);
  const tag = { BlockEntityTag: { Base: number, ...(rows.length ? { Patterns: rows } : {}) }, ...display(item, plainText) };
  return `/give ${item.target} minecraft:banner ${item.count} ${number} ${writeSnbt(tag)}`;
}

/** @param {Shown} design */
function ofBedrock({ base, kind, layers }) {
  if (kind === "shield") throw new FormError("Bedrock's shields have no design");
  const isOminous = JSON.stringify({ base, layers, kind }) === JSON.stringify(TABLES.ominous);
  if (isOminous) return { id: "Banner", Base: fromBlack(base), Type: 1 };
  return { id: "Banner", Base: fromBlack(base), Patterns: codedLayers("bedrock", layers, fromBlack), Type: 0 };
}

const dyeNumber = (/** @type {string} */ dye) => TABLES.dyes.indexOf(dye);
const fromBlack = (/** @type {string} */ dye) => 15 - dyeNumber(dye);

/** @param {"1.13" | "1.8" | "bedrock"} version @param {Shown["layers"]} layers @param {(dye: string) => number} number */
function codedLayers(version, layers, number) {
  return layers.map(({ pattern, dye }, at) => {
    const code = Object.hasOwn(CODES[version], pattern) ? CODES[version][pattern] : undefined;
    if (!code) throw new FormError(`layer ${at + 1}: this version has no pattern '${pattern}'`);
    return { Pattern: code, Color: number(dye) };
  });
}

/** @param {Item} item @param {(line: any) => string} asText */
function display({ name, lore }, asText) {
  const entries = { ...(hasText(name) ? { Name: asText(name) } : {}), ...(lore.length ? { Lore: lore.map(asText) } : {}) };
  return Object.keys(entries).length ? { display: entries } : {};
}

// Text components

export const hasText = (/** @type {any} */ tree) => Boolean(typeof tree === "string" ? tree : Object.keys(tree ?? {}).length);

/** A text component as JSON in a text.
 * @param {any} line */
const asJson = (line) => JSON.stringify(typeof line === "string" ? { text: line } : line);

/** The words of a text component without their looks.
 * @param {any} tree @returns {string} */
export function plainText(tree) {
  if (typeof tree === "string") return tree;
  if (Array.isArray(tree)) return tree.map(plainText).join("");
  if (!tree || typeof tree !== "object" || tree instanceof Token) return "";
  return plainText(tree.text ?? tree.fallback ?? "") + plainText(tree.extra);
}

// SNBT

/** The shortest SNBT of a tree; tokens that were read stay as they were.
 * @param {any} tree @returns {string} */
function writeSnbt(tree) {
  if (Array.isArray(tree)) return `[${tree.map(writeSnbt).join(",")}]`;
  if (typeof tree === "string") return inQuotes(tree);
  if (tree instanceof Token) return tree.text;
  if (tree === null || typeof tree !== "object") return String(tree);
  const entries = Object.entries(tree).map(([key, value]) => `${/^[A-Za-z_]\w*$/.test(key) ? key : inQuotes(key)}:${writeSnbt(value)}`);
  return `{${entries.join(",")}}`;
}

function inQuotes(/** @type {string} */ text) {
  const escaped = text.replace(/[\\"]/g, "\\$&");
  return `"${escaped.replace(/[^ -~\x80-\uffff]/g, (each) => `\\x${each.charCodeAt(0).toString(16).padStart(2, "0")}`)}"`;
}
