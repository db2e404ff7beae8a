// Reads a banner's design as drapery.banner does: shorthand, commands and items of every version,
// JSON, and links of editors.

import { TABLES as tables } from "./tables.js";

export class DesignError extends Error {}

const FORMS = [
  [/^(https?:\/\/|[\w-]+(\.[\w-]+)+\/)\S+$/i, fromLink],
  [/^[{[]/, (text) => fromTree(parseTree(text))],
  [/^\/|^(minecraft:)?(give|item|replaceitem|setblock)\s|[{}[\]"@=]/i, fromCommand],
  [/^/, fromShorthand],
];
const MODES = ["destroy", "hollow", "keep", "outline", "replace", "strict"];
const OLD_BANNERS = ["banner", "standing_banner", "wall_banner"];
const CUSTOM = /^(?!minecraft:)[a-z0-9_.-]+:[a-z0-9_./-]+$/;

// The design of a text: { base, layers: [{ pattern, dye }], kind }, lowest layer first. Throws
// DesignError.
export function readDesign(text) {
  const trimmed = text.trim();
  if (!trimmed) fail("the text is empty; write a banner, such as 'white creeper:lime'");
  const read = FORMS.find(([looksSo]) => looksSo.test(trimmed))[1];
  const design = read(trimmed);
  if (design.layers.length > tables.maxLayers) fail(`${design.layers.length} layers; use at most ${tables.maxLayers}`);
  return { kind: "banner", ...design };
}

function fail(message) {
  throw new DesignError(message);
}

const quoted = (value) => `'${String(typeof value === "object" ? JSON.stringify(value) : value).slice(0, 40)}'`;

// Names

const plain = (name) => name.toLowerCase().replace(/^minecraft:/, "").split(/[-_\s]+/).filter(Boolean).join("_");
const lookUp = (table, key) => (Object.hasOwn(table, key) ? table[key] : undefined);
const bare = (id) => id.split("[")[0].trim().toLowerCase().replace(/^minecraft:/, "");

function baseOf(id) {
  const [, dye] = /^(.*?)(?:_wall)?_banner$/.exec(bare(id)) ?? [];
  if (dye === "silver") return "light_gray";
  return tables.dyes.includes(dye) ? dye : undefined;
}

const isItem = (id) => typeof id === "string" && (bare(id) === "shield" || OLD_BANNERS.includes(bare(id)) || baseOf(id) !== undefined);

function isCustom(name) {
  const parts = name.split(":").flatMap((side) => side.split("/"));
  return name.length <= 256 && CUSTOM.test(name) && !parts.some((part) => ["", ".", ".."].includes(part));
}

function patternOf(value) {
  const name = value && typeof value === "object" ? pick(value, "asset_id") : value;
  if (typeof name !== "string") fail(`${quoted(value)} is not a pattern; give its id, such as 'creeper'`);
  if (isCustom(name)) return name;
  const known = lookUp(tables.bukkit, name.trim()) ?? lookUp(tables.patterns, plain(name));
  return known ?? fail(`unknown pattern ${quoted(name)}; give an id, such as 'creeper' or 'stripe_top'`);
}

function dyeOf(value, inverted = false) {
  if (Number.isInteger(value) && value >= 0 && value < 16) return tables.dyes[inverted ? 15 - value : value];
  const name = typeof value === "string" ? lookUp(tables.dyeNames, plain(value)) : undefined;
  return name ?? fail(`unknown dye ${quoted(value)}; use ${tables.dyes.join(", ")}`);
}

const isDye = (word) => lookUp(tables.dyeNames, plain(word)) !== undefined;

// Shorthand: `white creeper:lime border:black`, or the lines of the game's tooltip.

function wordsOf(line) {
  const words = [];
  for (const word of line.split(":").map((part) => part.trim()).join(":").split(/\s+/).filter(Boolean)) {
    const light = words.at(-1)?.toLowerCase().endsWith("light");
    if (light && /^(blue|gray|grey)(:|$)/i.test(word)) words[words.length - 1] += `_${word}`;
    else words.push(word);
  }
  return words;
}

function fromShorthand(text) {
  if (/^ominous(_banner)?$/.test(plain(text))) return tables.ominous;
  const lines = text.replace(/[,;\r]/g, "\n").split("\n").map(wordsOf).filter((words) => words.length);
  const kind = lines[0]?.[0].toLowerCase() === "shield" && lines[0].shift() ? "shield" : "banner";
  if (!lines[0]?.length) fail("the base dye is missing; write 'white creeper:lime'");
  const first = lines[0].shift();
  if (first.replace(/^minecraft:/, "").includes(":")) fail(`${quoted(first)}: a base dye comes first, as in 'white creeper:lime'`);
  const base = baseOf(first) ?? dyeOf(first);
  if (["banner", "Banner"].includes(lines[0][0])) lines[0].shift();
  return { base, kind, layers: lines.flatMap(phrasesOf).map(layerOf) };
}

// The layers of a line: each ends with its `:dye`; the last may begin with its dye instead.
function phrasesOf(words) {
  const phrases = [[]];
  for (const word of words) {
    phrases.at(-1).push(word);
    if (word.includes(":")) phrases.push([]);
  }
  return phrases.filter((phrase) => phrase.length).map((phrase) => phrase.join(" "));
}

function layerOf(phrase) {
  const colon = phrase.lastIndexOf(":");
  const [dye, ...rest] = phrase.split(" ");
  if (colon < 0 && !(rest.length && isDye(dye))) fail(`layer ${quoted(phrase)}: write pattern:dye, such as 'creeper:lime'`);
  const colour = colon < 0 ? dye : phrase.slice(colon + 1);
  const pattern = patternOf(colon < 0 ? rest.join(" ") : phrase.slice(0, colon));
  return { pattern, dye: dyeOf(/^\d{1,3}$/.test(colour) ? Number(colour) : colour) };
}

// SNBT and JSON: objects, arrays, strings and numbers.

const TOKEN = /\s*(?:("(?:[^"\\]|\\.)*"|'(?:[^'\\]|\\.)*')|([{}[\],:;=])|([^\s{}[\]"',:;=]+))/sy;
const INTEGER = /^[+-]?\d[\d_]*[us]?[bsil]?$/i;
const FLOAT = /^[+-]?(\d[\d_]*\.?\d*|\.\d+)(e[+-]?\d+)?[fd]?$/i;
const ESCAPES = { b: "\b", s: " ", t: "\t", n: "\n", f: "\f", r: "\r" };

function tokensOf(text) {
  const tokens = [];
  TOKEN.lastIndex = 0;
  while (TOKEN.lastIndex < text.trimEnd().length) {
    const place = TOKEN.lastIndex;
    const match = TOKEN.exec(text) ?? fail(`column ${place + 1}: a quote that is not closed; close it`);
    const [, string, mark, word] = match;
    tokens.push({ mark, word, string: string && unescaped(string.slice(1, -1)), column: place + 1 });
  }
  return tokens;
}

function unescaped(text) {
  return text.replace(/\\(?:x([\da-f]{2})|u([\da-f]{4})|U([\da-f]{8})|(.))/gis, (_, two, four, eight, other) =>
    other === undefined ? String.fromCodePoint(parseInt(two ?? four ?? eight, 16)) : (ESCAPES[other] ?? other));
}

function scalar(word) {
  if (word === "true" || word === "false") return Number(word === "true");
  if (INTEGER.test(word) || FLOAT.test(word)) return parseFloat(word.replaceAll("_", ""));
  return word;
}

class TreeReader {
  constructor(text) {
    this.tokens = tokensOf(text);
    this.at = 0;
  }

  get next() {
    return this.tokens[this.at] ?? {};
  }

  take(mark) {
    return this.next.mark === mark && this.tokens[this.at++] !== undefined;
  }

  expect(mark) {
    if (!this.take(mark)) fail(`column ${this.next.column ?? "end"}: expected '${mark}'`);
  }

  text() {
    const { word, string, column } = this.next;
    this.at++;
    return string ?? word ?? fail(`column ${column ?? "end"}: expected a name or a value`);
  }

  // `{a:1,b=2}` with close "}", or the components `[a=1,b]` with close "]".
  entries(close) {
    const found = {};
    while (!this.take(close)) {
      let key = this.text();
      let value = null;
      if (close === "]" && this.take(":")) key += `:${this.text()}`;
      if (this.take(":")) {
        value = this.value();
        if (typeof value === "string" && this.take("=")) [key, value] = [`${key}:${value}`, this.value()];
      } else if (this.take("=") && !(close === "]" && [",", "]"].includes(this.next.mark))) value = this.value();
      Object.defineProperty(found, key, { value, enumerable: true, configurable: true, writable: true });
      if (this.next.mark !== close) this.expect(",");
    }
    return found;
  }

  // `[1,2]`, `[I;1,2]`, `[0:{},1:{}]`.
  list() {
    if (this.tokens[this.at + 1]?.mark === ";") this.at += 2;
    const found = [];
    while (!this.take("]")) {
      if (/^\d+$/.test(this.next.word) && this.tokens[this.at + 1]?.mark === ":") this.at += 2;
      found.push(this.value());
      if (this.next.mark !== "]") this.expect(",");
    }
    return found;
  }

  value() {
    if (this.take("{")) return this.entries("}");
    if (this.take("[")) return this.list();
    const { string } = this.next;
    const text = this.text();
    if (string !== undefined) return text;
    const scoped = this.next.mark === ":" && this.tokens[this.at + 1]?.word;
    return scoped && this.take(":") ? `${text}:${this.text()}` : scalar(text);
  }
}

function parseTree(text) {
  const reader = new TreeReader(text);
  const tree = reader.value();
  if (reader.at < reader.tokens.length) fail(`column ${reader.next.column}: the text goes on after its end`);
  return tree;
}

// Items, block entities and our own JSON

function pick(tree, ...keys) {
  const spelt = keys.flatMap((key) => [key, `minecraft:${key}`]);
  const key = spelt.find((each) => Object.hasOwn(tree, each));
  return key === undefined ? undefined : tree[key];
}

function compound(tree) {
  const isCompound = tree !== null && typeof tree === "object" && !Array.isArray(tree);
  return isCompound ? tree : fail(`${quoted(tree)} is not a compound; write {…}`);
}

function layersOf(list, inverted = false) {
  if (list === undefined || list === null) return [];
  if (!Array.isArray(list)) fail(`${quoted(list)} is not a list of layers`);
  return list.map((entry) => ({
    pattern: patternOf(pick(compound(entry), "pattern", "Pattern")),
    dye: dyeOf(pick(entry, "color", "Color", "colour"), inverted),
  }));
}

function fromTree(given) {
  const tree = compound(given);
  const id = pick(tree, "id", "Name");
  if (Object.hasOwn(tree, "banner_color")) return { base: dyeOf(tree.banner_color), layers: layersOf(tree.layers) };
  if (id === undefined && (Object.hasOwn(tree, "base") || Object.hasOwn(tree, "layers"))) {
    const kind = tree.kind ?? "banner";
    if (!["banner", "shield"].includes(kind)) fail(`kind ${quoted(kind)}; use 'banner' or 'shield'`);
    return { base: dyeOf(tree.base), layers: layersOf(tree.layers), kind };
  }
  if (!isItem(id)) fail(`${quoted(id)} is neither a banner nor a shield; give an id such as 'minecraft:red_banner'`);
  const components = pick(tree, "components");
  return components ? fromComponents(id, compound(components)) : fromTag(id, compound(tree.tag ?? {}), tree.Damage);
}

function fromComponents(id, components) {
  const layers = layersOf(pick(components, "banner_patterns"));
  if (bare(id) !== "shield") return { base: baseOf(id) ?? fail(`${quoted(id)} does not name the base dye`), layers };
  const base = pick(components, "base_color");
  return shield(base === undefined ? undefined : dyeOf(base), layers);
}

// data: the damage value of versions up to 1.12, where the numbers of dyes are inverted.
function fromTag(id, tag, data) {
  const entity = compound(pick(tag, "BlockEntityTag") ?? tag);
  const old = data !== undefined;
  if (bare(id) === "shield") {
    return shield(entity.Base === undefined ? undefined : dyeOf(entity.Base, old), layersOf(entity.Patterns, old));
  }
  const base = baseOf(id);
  if (base === undefined && entity.Type === 1) return tables.ominous;
  const layers = layersOf(pick(entity, "patterns", "Patterns"), base === undefined);
  return { base: base ?? dyeOf(entity.Base ?? data ?? 0, true), layers };
}

function shield(base, layers) {
  if (base === undefined && !layers.length) fail("a plain shield has no design; give base_color or banner_patterns");
  return { base: base ?? "white", layers, kind: "shield" };
}

// Commands, and the arguments of items and blocks

function fromCommand(text) {
  const start = [...text.matchAll(/(^|\s)([^\s[{]+)/g)].find(([, , word]) => isItem(word))
    ?? fail("no banner in the command; it needs an item such as minecraft:white_banner[banner_patterns=[…]]");
  const id = start[2];
  const rest = text.slice(start.index + start[0].length);
  const reader = new TreeReader(rest);
  let brackets, tag;
  const words = [];
  while (reader.at < reader.tokens.length) {
    if (reader.take("[")) brackets ??= reader.entries("]");
    else if (reader.take("{")) tag ??= reader.entries("}");
    else if (["=", ":", ","].includes(reader.next.mark)) reader.at++;
    else words.push(reader.text());
    if (MODES.includes(words.at(-1))) break;
  }
  const strange = words.find((word) => !/^\d+$/.test(word) && !MODES.includes(word));
  if (strange) fail(`unexpected ${quoted(strange)} after the item; write layers in its brackets`);
  const hasCount = /^\s+\d/.test(rest);
  if (OLD_BANNERS.includes(bare(id)) || (bare(id) === "shield" && hasCount && tag)) {
    return fromTag(id, tag ?? {}, hasCount ? Number(words[1] ?? 0) : undefined);
  }
  return tag ? fromTag(id, tag) : fromComponents(id, brackets ?? {});
}

// Links of editors

function fromLink(link) {
  const host = /^(?:https?:\/\/)?([^/?#]+)/i.exec(link)[1].toLowerCase();
  const site = tables.sites.find(({ hosts }) => hosts.some((each) => `.${host}`.endsWith(`.${each}`)));
  if (!site) fail(`${quoted(link)}: not a link of a known banner editor; copy the banner's /give command`);
  const code = site.code ? new RegExp(site.code).exec(link)?.[1] : inOrder(link);
  if (!code) fail(`${quoted(link)}: the link holds no design; copy the link from the editor`);
  const first = new RegExp(`^${site.base}`).exec(code) ?? fail(`${quoted(code)} is not a code of the editor`);
  const parts = [...code.slice(first[0].length).matchAll(new RegExp(site.layer, "gy"))];
  if ([first, ...parts].map(([text]) => text).join("") !== code) fail(`${quoted(code)} is not a code of the editor`);
  const named = (table, token) => lookUp(table, token) ?? fail(`${quoted(token)} is not in the codes of the editor`);
  const layers = parts.map(({ groups }) => ({ pattern: named(site.patterns, groups.pattern), dye: named(site.dyes, groups.dye) }));
  return { base: named(site.dyes, first.groups.dye), layers, kind: /\/shield\.php/.test(link) ? "shield" : "banner" };
}

// The parameters `shape_id_2=1&color_id_2=3&color_id_0=4` as `4;1:3;`.
function inOrder(link) {
  const numbers = new Map([...link.matchAll(/(\w+_id_\d+)=([^&#]*)/g)].map(([, name, value]) => [name, value]));
  if (!numbers.size) return null;
  const shapes = [...Array(100).keys()].filter((n) => n && Number(numbers.get(`shape_id_${n}`) ?? 0) !== 0);
  const layers = shapes.map((n) => `${numbers.get(`shape_id_${n}`)}:${numbers.get(`color_id_${n}`)};`);
  return [`${numbers.get("color_id_0")};`, ...layers].join("");
}
