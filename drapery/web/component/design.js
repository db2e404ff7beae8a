// Reads a banner's design as drapery.banner does: shorthand, commands and items of every version,
// JSON, and links of editors.

import { TABLES } from "./tables.js";

export class DesignError extends Error {}

const COMMAND = /^\/?(minecraft:)?(give|item|replaceitem|setblock)\s/i;
const FORMS = [
  [/^(https?:\/\/|[\w-]+(\.[\w-]+)+\/)\S+$/i, fromLink],
  [/^[{[]/, fromTree],
  [/^\/|[{}[\]"@=]/i, fromCommand],
  [COMMAND, fromCommand],
  [/^/, fromShorthand],
];
const MODES = /^(\d+|destroy|hollow|keep|outline|replace|strict)$/;
const OLD_BANNERS = ["banner", "standing_banner", "wall_banner"];

// The design of a text: { base, layers: [{ pattern, dye }], kind }, lowest layer first. Throws
// DesignError.
export function readDesign(text) {
  const trimmed = text.trim();
  const design = { kind: "banner", ...FORMS.find(([form]) => form.test(trimmed))[1](trimmed) };
  // A misspelt key would leave its layers out.
  const hasColours = /(?<!base_|banner_)colou?r["']?\s*[:=]/i.test(trimmed);
  if (hasColours && !design.layers.length) fail("the text has layers, but not where a design has them; check its keys");
  if (design.layers.length > TABLES.maxLayers) fail(`${design.layers.length} layers; use at most ${TABLES.maxLayers}`);
  return design;
}

function fail(message) {
  throw new DesignError(message);
}

const quoted = (value) => `'${String(value && typeof value === "object" ? JSON.stringify(value) : value).slice(0, 40)}'`;

// Names

const plain = (name) => name.toLowerCase().replace(/^minecraft:/, "").split(/[-_\s]+/).filter(Boolean).join("_");
const lookUp = (table, key) => (Object.hasOwn(table, key) ? table[key] : undefined);
const bare = (id) => id.split("[")[0].trim().toLowerCase().replace(/^minecraft:/, "");
const isShield = (id) => bare(id) === "shield";
const isItem = (id) => typeof id === "string" && (isShield(id) || OLD_BANNERS.includes(bare(id)) || baseOf(id) !== undefined);

function baseOf(id) {
  const [, dye] = /^(.*?)(?:_wall)?_banner$/.exec(bare(id)) ?? [];
  return dye === "silver" ? "light_gray" : TABLES.dyes.find((each) => each === dye);
}

function patternOf(value) {
  const name = value && typeof value === "object" ? pick(value, "asset_id") : value;
  if (typeof name !== "string") fail(`${quoted(value)} is not a pattern; give its id, such as 'creeper'`);
  const custom = /^(?!minecraft:)[a-z0-9_.-]+:[a-z0-9_./-]+$/.test(name) && name.length <= 256;
  if (custom && name.split(/[:/]/).every((part) => !["", ".", ".."].includes(part))) return name;
  const known = lookUp(TABLES.bukkit, name.trim()) ?? lookUp(TABLES.patterns, plain(name));
  return known ?? fail(`unknown pattern ${quoted(name)}; give an id, such as 'creeper' or 'stripe_top'`);
}

const isDye = (word) => lookUp(TABLES.dyeNames, plain(word)) !== undefined;

// inverted: whether numbers count from black, as they did up to Java 1.12.
function dyeOf(value, inverted = false) {
  const name = typeof value === "string" ? lookUp(TABLES.dyeNames, plain(value)) : TABLES.dyes[inverted ? 15 - value : value];
  return name ?? fail(`unknown dye ${quoted(value)}; use ${TABLES.dyes.join(", ")}`);
}

// Shorthand: `white creeper:lime border:black`, or the lines of the game's tooltip

function fromShorthand(text) {
  if (/^ominous(_banner)?$/.test(plain(text))) return TABLES.ominous;
  const lines = text.split(/[,;\r\n]/).map(wordsOf).filter((words) => words.length);
  const kind = lines[0]?.[0].toLowerCase() === "shield" && lines[0].shift() ? "shield" : "banner";
  if (!lines[0]?.length) fail("the base dye is missing; write 'white creeper:lime'");
  const first = lines[0].shift();
  const base = baseOf(first) ?? dyeOf(first);
  if (["banner", "Banner"].includes(lines[0][0])) lines[0].shift();
  // A layer ends with its `:dye`; the last of a line may begin with its dye instead.
  const phrases = lines.flatMap((words) => words.join(" ").match(/[^:]*:\S*|[^:]+$/g) ?? []);
  return { base, kind, layers: phrases.map((phrase) => layerOf(phrase.trim())) };
}

// The words of a line; `a : b` and `light blue` become one word each.
function wordsOf(line) {
  const joined = line.replace(/\s*:\s*/g, ":").replace(/(light)\s+(?=(blue|gray|grey)(\s|:|$))/gi, "$1_");
  return joined.split(/\s+/).filter(Boolean);
}

function layerOf(phrase) {
  const [dye, ...rest] = phrase.split(" ");
  const colon = phrase.lastIndexOf(":");
  if (colon < 0 && !(rest.length && isDye(dye))) fail(`layer ${quoted(phrase)}: write pattern:dye, such as 'creeper:lime'`);
  const [pattern, colour] = colon < 0 ? [rest.join(" "), dye] : [phrase.slice(0, colon), phrase.slice(colon + 1)];
  return { pattern: patternOf(pattern), dye: dyeOf(/^\d{1,3}$/.test(colour) ? Number(colour) : colour) };
}

// SNBT and JSON: objects, arrays, strings and numbers

const TOKEN = /\s*(?:("(?:[^"\\]|\\.)*"|'(?:[^'\\]|\\.)*')|([{}[\],:;=])|([^\s{}[\]"',:;=]+))/gsy;
const NUMBER = /^[+-]?(\d[\d_]*\.?\d*|\.\d+)(e[+-]?\d+)?([us]?[bsil]|[fd])?$/i;
const ESCAPES = { b: "\b", s: " ", t: "\t", n: "\n", f: "\f", r: "\r" };

// Functions that take the next value, or the next entries up to a bracket, off a text.
function readerOf(text) {
  const tokens = [...text.matchAll(TOKEN)].map(([, string, mark, word]) => ({ string, mark, word }));
  if (text.replace(TOKEN, "").trim()) fail("a quote is not closed; close it");
  let at = 0;
  const is = (mark, ahead = 0) => tokens[at + ahead]?.mark === mark;
  const take = (mark) => is(mark) && ++at > 0;
  const separate = (close) => is(close) || take(",") || fail(`expected ',' or '${close}' at word ${at + 1}`);

  function name() {
    const { string, word } = tokens[at++] ?? {};
    return string ? unescaped(string.slice(1, -1)) : (word ?? fail(`expected a name or a value at word ${at}`));
  }

  // `a:1,b=2}`, or the components `a=1,!b]`.
  function entries(close) {
    const found = new Map();
    for (; !take(close); separate(close)) {
      let key = name();
      let value = null;
      if (close === "]" && take(":")) key += `:${name()}`;
      if (take(":")) value = item();
      else if (take("=") && !is(",") && !is(close)) value = item();
      if (typeof value === "string" && take("=")) [key, value] = [`${key}:${value}`, item()];
      found.set(key, value);
    }
    return Object.fromEntries(found);
  }

  // `1,2]`, `I;1,2]` or `0:{},1:{}]`.
  function list() {
    if (is(";", 1)) at += 2;
    const found = [];
    for (; !take("]"); separate("]")) {
      if (/^\d+$/.test(tokens[at]?.word) && is(":", 1)) at += 2;
      found.push(item());
    }
    return found;
  }

  function item() {
    if (take("{")) return entries("}");
    if (take("[")) return list();
    const { string } = tokens[at] ?? {};
    const text = name();
    if (string) return text;
    if (is(":") && tokens[at + 1]?.word && take(":")) return `${text}:${name()}`;
    if (text === "true" || text === "false") return Number(text === "true");
    return NUMBER.test(text) ? parseFloat(text.replaceAll("_", "")) : text;
  }

  return { take, name, entries, item, get ended() { return at >= tokens.length; } };
}

function unescaped(text) {
  return text.replace(/\\(?:x([\da-f]{2})|u([\da-f]{4})|(.))/gis, (_, two, four, other) =>
    other === undefined ? String.fromCharCode(parseInt(two ?? four, 16)) : (ESCAPES[other] ?? other));
}

// Items, block entities and our own JSON

function pick(tree, ...keys) {
  const key = keys.flatMap((each) => [each, `minecraft:${each}`]).find((each) => Object.hasOwn(tree, each));
  return key === undefined ? undefined : tree[key];
}

function compound(tree) {
  const isCompound = tree !== null && typeof tree === "object" && !Array.isArray(tree);
  return isCompound ? tree : fail(`${quoted(tree)} is not a compound; write {…}`);
}

function layersOf(list, inverted = false) {
  if (!Array.isArray(list ?? [])) fail(`${quoted(list)} is not a list of layers`);
  return (list ?? []).map((entry) => ({
    pattern: patternOf(pick(compound(entry), "pattern", "Pattern")),
    dye: dyeOf(pick(entry, "color", "Color", "colour"), inverted),
  }));
}

function fromTree(text) {
  const reader = readerOf(text);
  const tree = compound(reader.item());
  if (!reader.ended) fail("the text goes on after its end; give one banner");
  const id = pick(tree, "id", "Name");
  if (id === undefined && pick(tree, "base", "banner_color", "layers") !== undefined) {
    const { kind = "banner" } = tree;
    if (!["banner", "shield"].includes(kind)) fail(`kind ${quoted(kind)}; use 'banner' or 'shield'`);
    return { base: dyeOf(pick(tree, "banner_color", "base")), layers: layersOf(tree.layers), kind };
  }
  if (!isItem(id)) fail(`${quoted(id)} is neither a banner nor a shield; give an id such as 'minecraft:red_banner'`);
  const components = pick(tree, "components");
  return components ? fromComponents(id, compound(components)) : fromTag(id, compound(tree.tag ?? {}), tree.Damage);
}

function fromComponents(id, components) {
  const layers = layersOf(pick(components, "banner_patterns"));
  if (isShield(id)) return shield(pick(components, "base_color"), layers);
  return { base: baseOf(id) ?? fail(`${quoted(id)} does not name the base dye`), layers };
}

// data: the damage value of versions up to 1.12, where the numbers of dyes are inverted.
function fromTag(id, tag, data) {
  const entity = compound(pick(tag, "BlockEntityTag") ?? tag);
  if (isShield(id)) return shield(entity.Base, layersOf(entity.Patterns, data !== undefined), data !== undefined);
  const base = baseOf(id);
  if (!base && entity.Type === 1) return TABLES.ominous;
  return { base: base ?? dyeOf(entity.Base ?? data ?? 0, true), layers: layersOf(pick(entity, "patterns", "Patterns"), !base) };
}

function shield(base, layers, inverted = false) {
  if (base === undefined && !layers.length) fail("a plain shield has no design; give base_color or banner_patterns");
  return { base: base === undefined ? "white" : dyeOf(base, inverted), layers, kind: "shield" };
}

// Commands, and the arguments of items and blocks

function fromCommand(text) {
  const start = [...text.matchAll(/(?<=^|\s)[^\s[{]+/g)].find(([word]) => isItem(word))
    ?? fail("no banner in the command; it needs an item such as minecraft:white_banner[banner_patterns=[…]]");
  if (start.index && !COMMAND.test(text)) fail(`${quoted(text)}: not a command that makes a banner; use /give`);
  const rest = text.slice(start.index + start[0].length);
  const reader = readerOf(rest);
  let components, tag;
  const words = [];
  while (!reader.ended && words.at(-1) !== "replace") {
    if (reader.take("[")) components = reader.entries("]");
    else if (reader.take("{")) tag = reader.entries("}");
    else words.push(reader.name());
  }
  const strange = words.find((word) => !MODES.test(word));
  if (strange) fail(`unexpected ${quoted(strange)} after the item; write layers in its brackets`);
  const old = /^\s+\d/.test(rest);
  const hasData = OLD_BANNERS.includes(bare(start[0])) || (isShield(start[0]) && old && tag);
  if (hasData) return fromTag(start[0], tag ?? {}, old ? Number(words[1] ?? 0) : undefined);
  return tag ? fromTag(start[0], tag) : fromComponents(start[0], components ?? {});
}

// Links of editors

function fromLink(link) {
  const host = /^(?:https?:\/\/)?([^/?#]+)/i.exec(link)[1].toLowerCase();
  const site = TABLES.sites.find(({ hosts }) => hosts.some((each) => `.${host}`.endsWith(`.${each}`)));
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
  const shapes = [...Array(100).keys()].filter((n) => n && Number(numbers.get(`shape_id_${n}`) ?? 0) !== 0);
  const layers = shapes.map((n) => `${numbers.get(`shape_id_${n}`)}:${numbers.get(`color_id_${n}`)};`);
  return numbers.size && [`${numbers.get("color_id_0")};`, ...layers].join("");
}
