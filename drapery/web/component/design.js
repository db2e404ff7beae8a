// Reads a banner's design as drapery.banner does: shorthand, commands and items of every version,
// JSON, and links of editors.

import { short } from "./attributes.js";
import { TABLES } from "./tables.js";

export class DesignError extends Error {}

// A word of SNBT that is no string, as it was written.
export class Token {
  constructor(text) {
    this.text = text;
  }

  toJSON() {
    return /^(true|false|[01]b)$/i.test(this.text) ? /^(true|1b)$/i.test(this.text) : meaning(this.text);
  }
}

const COMMAND = /^\/?(minecraft:)?(give|item|replaceitem|setblock)\s/i;
const SUMMON = /^\/?(minecraft:)?summon\s/i;
const FORMS = [
  [/^(https?:\/\/|[\w-]+(\.[\w-]+)+\/)\S+$/i, fromLink],
  [/^[{[]/, fromTree],
  [SUMMON, fromEntity],
  [/^\/|[{}[\]"@=]/, fromCommand],
  [COMMAND, fromCommand],
  [/^/, fromShorthand],
];
const LAYER = /(?<!base_|banner_)(colou?r|pattern)["']?\s*[:=]/i;
const NAMING = /^(minecraft:)?(custom_name|item_name|lore|display)$/;
const MODES = /^(\d+|destroy|hollow|keep|outline|replace|strict)$/;
const CUSTOM = /^(?!minecraft:)(?!.{257})(?!(.*[:/])?\.{0,2}([:/]|$))[a-z0-9_.-]+:[a-z0-9_./-]+$/;

// The design of a text: { base, layers: [{ pattern, dye }], kind }, lowest layer first. Throws
// DesignError.
export function readDesign(text) {
  if (text.length > TABLES.maxText) fail(`the design has ${text.length} characters; use at most ${TABLES.maxText}`);
  const trimmed = text.trim();
  const [, read] = FORMS.find(([form]) => form.test(trimmed));
  const design = { kind: "banner", ...read(trimmed) };
  // A misspelt key would leave its layers out.
  const isLost = !design.layers.length && LAYER.test(trimmed) && LAYER.test(withoutNames(trimmed));
  if (isLost) fail("the text has layers, but not where a design has them; check its keys");
  if (design.layers.length > TABLES.maxLayers) fail(`${design.layers.length} layers; use at most ${TABLES.maxLayers}`);
  return design;
}

// A text of an item without its name and lore, whose words may have colours.
function withoutNames(text) {
  if (!/[{[]/.test(text) || SUMMON.test(text)) return text;
  const tree = /^[{[]/.test(text) ? wholeTree(text) : commandParts(text).parts;
  return JSON.stringify(tree, (key, value) => (NAMING.test(key) ? undefined : value));
}

function fail(message) {
  throw new DesignError(message);
}

const quoted = (value) => `'${short(String(value && typeof value === "object" ? JSON.stringify(value) : value), 40)}'`;

// Names

const plain = (name) => name.toLowerCase().replace(/^minecraft:/, "").split(/[-_\s]+/).filter(Boolean).join("_");
const bare = (id) => id.split("[")[0].trim().toLowerCase().replace(/^minecraft:/, "");
const lookUp = (table, key) => (Object.hasOwn(table, key) ? table[key] : undefined);

// What an id stands for: "banner" or "shield", and the base dye or null.
const itemOf = (id) => (typeof id === "string" ? lookUp(TABLES.items, bare(id)) : undefined);

function patternOf(value) {
  const name = value && typeof value === "object" ? pick(value, "asset_id") : value;
  if (typeof name !== "string") fail(`${quoted(value)} is not a pattern; give its id, such as 'creeper'`);
  if (CUSTOM.test(name)) return name;
  const known = lookUp(TABLES.bukkit, name.trim()) ?? lookUp(TABLES.patterns, plain(name));
  return known ?? fail(`unknown pattern ${quoted(name)}; give an id, such as 'creeper' or 'stripe_top'`);
}

// inverted: whether numbers count from black, as they did up to Java 1.12.
function dyeOf(value, inverted = false) {
  const number = Number.isInteger(value) ? value : undefined; // nothing else is a place in the list
  const name = typeof value === "string" ? lookUp(TABLES.dyeNames, plain(value)) : TABLES.dyes[inverted ? 15 - number : number];
  return name ?? fail(`unknown dye ${quoted(value)}; use ${TABLES.dyes.join(", ")}`);
}

// Shorthand: `white creeper:lime border:black`, or the lines of the game's tooltip

function fromShorthand(text) {
  if (/^ominous(_banner)?$/.test(plain(text))) return TABLES.ominous;
  const [words, ...more] = text.split(/[,;\r\n]/).map(wordsOf).filter((each) => each.length);
  const kind = words?.[0].toLowerCase() === "shield" ? words.shift() && "shield" : "banner";
  const base = words?.shift() ?? fail("the base dye is missing; write 'white creeper:lime'");
  if (/^[Bb]anner$/.test(words[0])) words.shift();
  // A layer ends with its `:dye`; the last of a line may begin with its dye instead.
  const phrases = [words, ...more].flatMap((each) => each.join(" ").match(/[^:]*:\S*|[^:]+$/g) ?? []);
  return { base: itemOf(base)?.[1] ?? dyeOf(base), kind, layers: phrases.map((each) => layerOf(each.trim())) };
}

// The words of a line; `a : b` and `light blue` become one word each.
function wordsOf(line) {
  const parts = line.split(":").map((each) => each.trim());
  const joined = parts.join(":").replace(/(light)\s+(?=(blue|gray|grey)(\s|:|$))/gi, "$1_");
  return joined.split(/\s+/).filter(Boolean);
}

function layerOf(phrase) {
  const [, pattern, dye] = /^([^]*):(.*)$/.exec(phrase) ?? [];
  if (pattern !== undefined) return { pattern: patternOf(pattern), dye: dyeOf(/^\d{1,3}$/.test(dye) ? Number(dye) : dye) };
  const [first, rest] = phrase.split(/ (.*)/);
  if (rest && lookUp(TABLES.dyeNames, plain(first))) return { pattern: patternOf(rest), dye: dyeOf(first) };
  return fail(`layer ${quoted(phrase)}: write pattern:dye, such as 'creeper:lime'`);
}

// SNBT and JSON: objects, arrays, strings and numbers

// Strings that nothing closes are tokens too, so that each character is read once.
const TOKEN = /"(?:[^"\\]|\\.)*(?:"|\\?$)|'(?:[^'\\]|\\.)*(?:'|\\?$)|[{}[\],:;=]|[^\s{}[\]"',:;=]+/gs;
const CLOSED = /^(["'])(?:[^\\]|\\.)*\1$/s;
const NUMBER = /^[+-]?(\d[\d_]*(\.\d*)?|\.\d+)(e[+-]?\d+)?([us]?[bsil]|[fd])?$/i;
const ESCAPE = /\\(?:x([\da-f]{2})|u([\da-f]{4})|(.))/gis;
const ESCAPED = { b: "\b", s: " ", t: "\t", n: "\n", f: "\f", r: "\r" };

// The parts of a text, each after its first token: compounds, components in brackets, and words.
// mean: what a token stands for.
function partsOf(text, mean = meaning) {
  const tokens = text.match(TOKEN) ?? [];
  if (tokens.some((token) => /^["']/.test(token) && !CLOSED.test(token))) fail("a quote is not closed; close it");
  let at = 0;
  let depth = 0;
  const take = (mark) => tokens[at] === mark && ++at > 0;

  function part() {
    if (take("{")) return Object.fromEntries(entries("}"));
    if (take("[")) return entries("]").map(([, value]) => value);
    if (!tokens[at] || /^[{}[\],:;=]/.test(tokens[at])) fail(`expected a name or a value at word ${at + 1}`);
    return mean(tokens[at++]);
  }

  // Names and values up to a bracket: `a:1,b:c:d}`, `a:b=1,!c]`, and of lists `1,2]`, `I;1]`, `0:{}]`.
  function entries(close) {
    const found = [];
    if (++depth > TABLES.maxDepth) fail(`over ${TABLES.maxDepth} brackets inside each other; no banner needs that`);
    if (close === "]" && /^[BIL]$/.test(tokens[at]) && tokens[at + 1] === ";") at += 2;
    while (!take(close)) {
      const parts = [part()];
      let end = 0; // of the parts of the name
      while (take(":") || take("=")) {
        if (!end || tokens[at - 1] === "=") end = parts.length;
        else if (/["'{[]/.test(tokens[at - 2] + tokens[at])) fail(`expected ',' or '${close}' at word ${at}`);
        parts.push(part());
      }
      if (close === "}" && !end) fail(`expected ':' and a value at word ${at + 1}`);
      found.push([parts.slice(0, end).join(":"), parts.length > end + 1 ? parts.slice(end).join(":") : parts[end]]);
      if (tokens[at] !== close && !take(",")) fail(`expected ',' or '${close}' at word ${at + 1}`);
    }
    depth--;
    return found;
  }

  const parts = [];
  while (at < tokens.length) {
    const first = tokens[at];
    parts.push([first, take("[") ? Object.fromEntries(entries("]")) : part()]);
  }
  return parts;
}

// The text of a string; a number, of true and false 1 and 0; or another word.
function meaning(token) {
  if (/^(true|false)$/.test(token)) return Number(token === "true");
  if (NUMBER.test(token)) return parseFloat(token.replaceAll("_", ""));
  return /^["']/.test(token) ? token.slice(1, -1).replace(ESCAPE, unescaped) : token;
}

function unescaped(_, two, four, other) {
  return other === undefined ? String.fromCharCode(parseInt(two ?? four, 16)) : (ESCAPED[other] ?? other);
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

function layersOf(list = [], inverted = false) {
  if (!Array.isArray(list)) fail(`${quoted(list)} is not a list of layers`);
  return list.map(compound).map((layer) => ({
    pattern: patternOf(pick(layer, "pattern", "Pattern")),
    dye: dyeOf(pick(layer, "color", "Color", "colour"), inverted),
  }));
}

// The compound that is all of a text.
function wholeTree(text, mean) {
  const [[first, tree], more] = partsOf(text, mean);
  if (first !== "{" || more) fail("the text is not one compound; give one banner as {…}");
  return tree;
}

function fromTree(text) {
  const tree = wholeTree(text);
  const id = pick(tree, "id", "Name");
  if (id !== undefined || pick(tree, "base", "banner_color", "layers") === undefined)
    return isItem(tree) ? fromItem(id, pick(tree, "components"), tree.tag, tree.Damage) : fromItem(id, undefined, blockOf(id, tree));
  const { kind = "banner" } = tree;
  if (!["banner", "shield"].includes(kind)) fail(`kind ${quoted(kind)}; use 'banner' or 'shield'`);
  const base = pick(tree, "banner_color", "base") ?? fail('the text has no "base"; give its dye, as in {"base": "red", "layers": []}');
  return { base: dyeOf(base), layers: layersOf(tree.layers), kind };
}

const isItem = (tree) => ["count", "Count", "Damage", "components", "tag"].some((key) => Object.hasOwn(tree, key));

// A banner as a block up to 1.12 and in Bedrock, whose id names no dye, is its own tag.
function blockOf(id, tree) {
  const [kind, dye] = itemOf(id) ?? [];
  return kind === "banner" && !dye && pick(tree, "Base") !== undefined ? tree : undefined;
}

// An item with its components or its tag. data: its damage value, up to Java 1.12.
function fromItem(id, components, tag = {}, data = undefined) {
  const [kind, dye] = itemOf(id) ?? fail(`${quoted(id)} is neither a banner nor a shield; give an id such as 'minecraft:red_banner'`);
  const numbered = kind === "banner" && !dye;
  if (components && numbered) fail(`${quoted(id)} does not name the base dye; give an id such as 'minecraft:red_banner'`);
  const outer = compound(components ?? tag);
  const entity = compound(pick(outer, "BlockEntityTag") ?? outer);
  if (numbered && entity.Type === 1) return TABLES.ominous;
  const inverted = numbered || (!dye && data !== undefined);
  const layers = layersOf(pick(entity, ...(components ? ["banner_patterns"] : ["patterns", "Patterns"])), inverted);
  const base = pick(entity, "base_color", "Base") ?? (numbered ? (data ?? 0) : undefined);
  if (!dye && base === undefined && !layers.length) fail("a plain shield has no design; give base_color or banner_patterns");
  return { base: dye ?? (base === undefined ? "white" : dyeOf(base, inverted)), layers, kind };
}

// Commands, and the arguments of items and blocks

function fromCommand(text) {
  const { id, rest, parts } = commandParts(text);
  const words = parts.filter(([first]) => !/^[[{]/.test(first)).map(([, word]) => word);
  const strange = words.find((word) => !MODES.test(word));
  if (strange !== undefined) fail(`unexpected ${quoted(strange)} after the item; write layers in its brackets`);
  const { "[": components, "{": tag } = Object.fromEntries(parts);
  const [kind, dye] = itemOf(id);
  const isOld = kind === "banner" && !dye; // its brackets have the state of a block
  return fromItem(id, tag || isOld ? undefined : components, tag, /^\s+\d/.test(rest) ? Number(words[1] ?? 0) : undefined);
}

// The id of the item or block that a command makes, what stands after it, and the parts of that.
function commandParts(text, mean) {
  const [start] = [...text.matchAll(/(?<=^|\s)[^\s[{]+/g)].filter(([word]) => itemOf(word));
  if (!start) fail("no banner in the command; it needs an item such as minecraft:white_banner[banner_patterns=[…]]");
  if (start.index && !COMMAND.test(text)) fail(`${quoted(text)}: not a command that makes a banner; use /give`);
  const rest = text.slice(start.index + start[0].length);
  return { id: start[0], rest, parts: partsOf(rest, mean) };
}

// The banner that an entity holds: `/summon item_frame ~ ~ ~ {Item:{id:"minecraft:red_banner"}}`
function fromEntity(text) {
  const [, name, tree] = /^\S+\s+([^\s{]+)[^{]*(\{.*)$/s.exec(text) ?? fail("the entity holds no banner; write its data in {…}");
  const items = heldItems(wholeTree(tree));
  const isOld = /[A-Z]/.test(name) || items.some(({ Damage }) => Damage !== undefined) || /[{,]\s*"?Equipment"?\s*:/.test(tree);
  const found = items.map((item) => {
    const damage = isOld && itemOf(pick(item, "id", "Name"))[0] === "shield" ? 0 : item.Damage;
    return fromItem(pick(item, "id", "Name"), pick(item, "components"), item.tag, damage);
  });
  if (!found.length) fail("the entity holds no banner");
  if (new Set(found.map((each) => JSON.stringify(each))).size > 1) fail(`${found.length} banners that differ; give the command of one`);
  return found[0];
}

// The items of a tree that are banners, or shields with a design.
function heldItems(tree) {
  if (Array.isArray(tree)) return tree.flatMap(heldItems);
  if (tree === null || typeof tree !== "object") return [];
  const id = pick(tree, "id") ?? (isItem(tree) ? pick(tree, "Name") : undefined);
  const [kind, dye] = itemOf(id) ?? [];
  const outer = pick(tree, "components") ?? tree.tag?.BlockEntityTag ?? {};
  const isDesign = kind === "shield" ? pick(outer, "banner_patterns", "base_color", "Base", "Patterns") !== undefined : kind && (dye || isItem(tree));
  return [...(isDesign ? [tree] : []), ...Object.values(tree).flatMap(heldItems)];
}

// What a text says of its item beside the design, its numbers as Tokens: the tree of its components or
// of its tag, who gets it, and how many. Throws DesignError; null for texts without an item.
export function readItem(text) {
  const trimmed = text.trim();
  if (SUMMON.test(trimmed) || /^https?:/i.test(trimmed)) return null;
  const keep = (token) => (/^["']/.test(token) || (!NUMBER.test(token) && !/^(true|false)$/.test(token)) ? meaning(token) : new Token(token));
  if (/^\{/.test(trimmed)) {
    const tree = wholeTree(trimmed, keep);
    return { components: pick(tree, "components") ?? {}, tag: tree.tag ?? {}, count: Number(pick(tree, "count", "Count")?.toJSON() ?? 1) };
  }
  if (!/^\/|[{}[\]"@=]/.test(trimmed) && !COMMAND.test(trimmed)) return null;
  const { parts } = commandParts(trimmed, keep);
  const { "[": components = {}, "{": tag = {} } = Object.fromEntries(parts);
  const [target] = /(?<=^\/?(?:minecraft:)?give\s+)(@\w\[[^\]]*\]|\S+)/i.exec(trimmed) ?? ["@p"];
  const counts = parts.filter(([first]) => /^\d{1,9}$/.test(first)).map(([first]) => Number(first));
  return { components, tag, count: counts[0] ?? 1, target };
}

// Links of editors

function fromLink(link) {
  if (link.length > TABLES.maxLink) fail(`the link has ${link.length} characters; use at most ${TABLES.maxLink}`);
  const [, host = "", path] = /^(?:https?:\/\/)?([\w.-]+)(?::\d+)?(?![^/?#])([^?#]*)/i.exec(link.toLowerCase()) ?? [];
  const site = TABLES.sites.find(({ hosts }) => hosts.some((each) => `.${host}`.endsWith(`.${each}`)));
  if (!site) fail(`${quoted(link)}: not a link of a known banner editor; copy the banner's /give command`);
  const code = site.code ? new RegExp(site.code).exec(link)?.[1] : inOrder(link);
  if (!code) fail(`${quoted(link)}: the link holds no design; copy the link from the editor`);
  const first = new RegExp(`^${site.base}`).exec(code);
  const parts = first ? [first, ...code.slice(first[0].length).matchAll(new RegExp(site.layer, "gy"))] : [];
  if (parts.map(([text]) => text).join("") !== code) fail(`${quoted(code)} is not a code of the editor`);
  const named = (table, token) => lookUp(table, token) ?? fail(`${quoted(token)} is not in the codes of the editor`);
  const dyes = parts.map(({ groups }) => named(site.dyes, groups.dye));
  const layers = parts.slice(1).map(({ groups }, number) => ({ pattern: named(site.patterns, groups.pattern), dye: dyes[number + 1] }));
  return { base: dyes[0], layers, kind: !site.code && path.includes("shield") ? "shield" : "banner" };
}

// The parameters `shape_id_2=1&color_id_2=3&color_id_0=4` as `4;1:3;`.
function inOrder(link) {
  const [, query = ""] = /^[^?#]*\?([^#]*)/.exec(link) ?? [];
  const pairs = query.split("&").map((each) => each.split(/=(.*)/s));
  const numbers = new Map(pairs.filter(([name]) => /^(color|shape)_id_\d+$/.test(name)).map(([name, value = ""]) => [name, value]));
  const shapes = [...Array(100).keys()].filter((n) => !/^0+$/.test(numbers.get(`shape_id_${n}`) ?? "0"));
  const layers = shapes.map((n) => `${numbers.get(`shape_id_${n}`)}:${numbers.get(`color_id_${n}`)};`);
  return numbers.size && [`${numbers.get("color_id_0")};`, ...layers].join("");
}
