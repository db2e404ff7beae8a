// What the attributes of the elements say. They may come from anyone, such as a page's visitors.

import { TABLES } from "./tables.js";

// A text from outside as messages show it: on one line, and not long.
export function short(text, most = 60) {
  const shown = text.slice(0, most).replace(/[\s\p{C}]+/gu, " ");
  return text.length > most ? `${shown}…` : shown;
}

// The number of an attribute's text; undefined without one. Throws an Error for what is no number
// or out of the bounds that `drapery render` has too.
export function numberOf(name, text) {
  const trimmed = text?.trim();
  if (!trimmed) return undefined;
  const [number, [least, most]] = [Number(trimmed), TABLES.bounds[name]];
  if (Number.isNaN(number)) throw new Error(`${name}="${short(trimmed)}" is not a number; write ${name}="4"`);
  if (number < least || number > most) throw new Error(`${name}="${short(trimmed)}" is out of range; use ${Number(least.toPrecision(3))} to ${most}`);
  if (name === "seed" && !Number.isInteger(number)) throw new Error(`seed="${short(trimmed)}" is not a whole number; write seed="4"`);
  return number;
}

// The text of an attribute, which is the name of a file or a part of it, so only one of these
// names. Throws an Error for others.
export function nameOf(name, text, names) {
  if (names.includes(text)) return text;
  throw new Error(`${name}="${short(text)}" is not known; use ${names.join(", ")}`);
}
