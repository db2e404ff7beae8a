// What edits a design: its history, and the tools, dyes, patterns and layers that change it. A page
// places these and draws what else it shows.

import { TABLES } from "../component/tables.js";
import { PatternGrid, dyeButtons, segments } from "./controls.js";
import { HIDDEN, drawPixels, iconButton, make } from "./dom.js";
import { unlike } from "./faces.js";
import { LayerList } from "./layers.js";
import { recipe } from "./loom.js";
import { changedLayer, duplicatedLayer, movedLayer, shownOf, withLayer, withoutLayer, workOf } from "./model.js";
import { LIMITS, TEXTS, TITLES } from "./tables.js";

/** @typedef {import("./model.js").Work} Work */
/** @typedef {import("./faces.js").Faces} Faces */
/** @typedef {{ code: string, texts: Record<string, string>, dyes: Record<string, string>, patterns: Record<string, string> }} Language */
/** What has an editor. openFaces: of banners or shields. show: draws the rest of the page. announce: tells of
 * an edit. begin: what another design begins with, such as a mark of its own.
 * @typedef {{ openFaces(kind: string): Promise<Faces>, show(): void, announce(): void, begin?(work: Work): Work }} Host */

const TOLD = 6000; // how long a line of news stands [ms]

/** @type {Language} */
export const ENGLISH = { code: "en", texts: TEXTS, dyes: {}, patterns: {} };

/** @param {string} text */
const capital = (text) => text[0].toUpperCase() + text.slice(1).replaceAll("_", " ");

export class Editor {
  /** @type {number | "field" | null} */
  chosen = null;
  dye = "black";
  /** @type {Record<string, Faces | null>} */
  every = {}; // the faces of banners and shields
  /** @type {Record<string, any>} */
  parts = {};
  /** @type {any} */
  controls = null; // once they are built
  /** @type {Record<string, string>} */
  words = {}; // by which patterns are found
  language = ENGLISH;
  /** @type {Record<string, object>} */
  #asked = {}; // for which faces it waits, by their kind
  #frame = 0;
  #base = ""; // the dye of the field that was shown last
  /** @type {ReturnType<typeof setTimeout> | undefined} */
  #telling = undefined;

  /** @param {import("./model.js").History} history @param {Host} host */
  constructor(history, host) {
    this.history = history;
    this.host = host;
  }

  get work() {
    return this.history.work;
  }

  // The faces of what is edited; those of banners until others are there.
  get faces() {
    return this.every[this.work.kind] ?? this.every.banner;
  }

  async open(/** @type {string} */ kind) {
    const asked = (this.#asked[kind] = {});
    this.every[kind] ??= null;
    const faces = await this.host.openFaces(kind).catch(() => null);
    if (this.#asked[kind] === asked) this.every[kind] = faces;
  }

  // Edits

  /** @param {Work} work @param {string} [key] */
  change(work, key) {
    if (!this.history.change(work, key) || !this.controls) return;
    this.show();
    this.host.announce();
  }

  /** Begin with another design; it can be undone.
   * @param {Work} work @param {number | "field" | null} [chosen] */
  begin(work, chosen = null) {
    this.chosen = chosen;
    this.change(this.host.begin?.(work) ?? work);
  }

  go(/** @type {"undo" | "redo"} */ way) {
    if (!this.history[way]()) return;
    this.chosen = null;
    this.tell(this.say(way));
    this.show();
    this.host.announce();
  }

  lay(/** @type {string} */ pattern) {
    const { work, chosen, dye } = this;
    if (typeof chosen === "number") this.change(changedLayer(work, chosen, { pattern }));
    else if (this.hasRoom()) {
      this.chosen = null; // the next dye is that of the next layer
      this.tell(this.say("layerIn", { pattern: this.patternTitle(pattern), dye: this.dyeTitle(dye) }));
      this.change(withLayer(work, { pattern, dye }));
    }
  }

  // Whether a layer can be added; a line says if not.
  hasRoom() {
    const is = this.work.layers.length < TABLES.maxLayers;
    if (!is) this.tell(this.say("tooMany", { most: TABLES.maxLayers }));
    return is;
  }

  dyeIt(/** @type {string} */ dye) {
    const { work, chosen } = this;
    if (chosen === "field") this.change({ ...work, base: dye });
    else if (chosen !== null) this.change(changedLayer(work, chosen, { dye }));
    else {
      this.dye = dye;
      this.show();
    }
  }

  /** @type {import("./layers.js").Acts} */
  acts = {
    select: (at) => {
      this.chosen = at;
      this.show();
    },
    move: (from, to) => {
      if (this.chosen === from) this.chosen = to;
      this.change(movedLayer(this.work, from, to));
    },
    hide: (at) => this.change(changedLayer(this.work, at, { hidden: !this.work.layers[at].hidden })),
    remove: (at) => {
      this.chosen = null;
      this.tell(`${this.say("delete")}: ${this.patternTitle(this.work.layers[at].pattern)}`);
      this.change(withoutLayer(this.work, at));
    },
    double: (at) => {
      if (this.hasRoom()) this.change(duplicatedLayer(this.work, at));
    },
  };

  random() {
    const { item, motion, kind } = this.work;
    if (this.faces) this.begin(workOf({ ...this.faces.small.random(), kind }, item, motion));
  }

  setKind(/** @type {string} */ kind) {
    this.change({ ...this.work, kind });
  }

  // The layers that change nothing that is seen; not those that are hidden.
  get unseen() {
    const { base, layers } = this.work;
    return this.faces?.unseen({ base, layers: layers.filter(({ hidden }) => !hidden) }) ?? [];
  }

  leaveOut() {
    const { unseen, work } = this;
    this.chosen = null;
    this.change({ ...work, layers: work.layers.filter((each) => !unseen.includes(each)) });
  }

  // Words; arrow functions, because others call them too.

  /** @param {string} key @param {Record<string, any>} [values] @returns {string} */
  say = (key, values = {}) => {
    const text = this.language.texts[key] ?? /** @type {Record<string, string>} */ (TEXTS)[key];
    return text.replace(/\{(\w+)\}/g, (_, name) => String(values[name] ?? ""));
  };

  dyeTitle = (/** @type {string} */ dye) => this.language.dyes[dye] ?? capital(dye);

  // The name in a word or two; of a pattern of a data pack, the end of its path.
  caption = (/** @type {string} */ pattern) => this.language.patterns[pattern] ?? capital(pattern.split(/[:/]/).at(-1) || pattern);

  // In English both the plain and the heraldic name.
  patternTitle = (/** @type {string} */ pattern) => {
    const [plain, heraldic] = [this.caption(pattern), TITLES[pattern]];
    return this.language.code === "en" && heraldic && heraldic !== plain ? `${plain} / ${heraldic}` : plain;
  };

  tell(/** @type {string} */ text) {
    const { status } = this.parts;
    if (!status) return;
    status.textContent = text;
    clearTimeout(this.#telling);
    this.#telling = setTimeout(() => (status.textContent = ""), TOLD);
  }

  // The parts, of which a page shows those that it wants: status, tools, kind, dyes, patterns (null without
  // faces), layers, the recipe for the loom and the flat face.
  build() {
    const { say, acts } = this;
    const patterns = (this.faces?.patterns ?? []).map((name) => ({ name, title: this.patternTitle(name), caption: this.caption(name), words: this.words[name] ?? name }));
    const dyes = dyeButtons((dye) => this.dyeIt(dye), { label: say("dyes"), titleOf: this.dyeTitle });
    const grid = patterns.length ? new PatternGrid(patterns, (name) => this.lay(name), { label: say("patterns"), find: say("find"), nothing: say("noPatterns") }) : null;
    const list = new LayerList(acts, say, { dye: this.dyeTitle, pattern: this.patternTitle });
    const undo = iconButton("undo", say("undo"), () => this.go("undo"), { "aria-keyshortcuts": "Control+Z" });
    const redo = iconButton("redo", say("redo"), () => this.go("redo"), { "aria-keyshortcuts": "Control+Y" });
    const kind = segments(`${say("banner")} / ${say("shield")}`, { banner: say("banner"), shield: say("shield") }, (name) => this.setKind(name));
    const [heading, hint, count] = [make("h2", { class: "mode" }), make("span", { class: "hint" }), make("span", { class: "hint" })];
    const done = make("button", { type: "button", class: "quiet", onclick: () => acts.select(null) }, say("add"));
    const empty = make("p", { class: "hint" }, say("noLayers"));
    const [over, idle, steps] = [make("p", { class: "warning" }, say("loomNot", { most: LIMITS.loomLayers })), make("button", { type: "button", hidden: true, onclick: () => this.leaveOut() }), make("div", { class: "stack" })];
    this.controls = { dyes, grid, list, undo, redo, kind, heading, hint, count, done, empty, over, idle, steps };
    this.parts = {
      status: make("p", { class: "status", role: "status" }),
      undo, redo,
      random: iconButton("dice", say("random"), () => this.random()),
      clear: iconButton("clear", say("clear"), () => this.change({ ...this.work, layers: [] })),
      kind: kind.whole,
      dyes: [make("div", { class: "mode-line" }, heading, hint, done), dyes.group],
      patterns: grid && [make("div", { class: "search" }, make("h2", {}, say("patterns")), grid.field, grid.count), grid.nothing, grid.grid],
      layers: [make("div", { class: "head" }, make("h2", {}, say("layers")), count), empty, list.list],
      loom: make("div", { class: "stack" }, over, idle, steps),
      flat: make("canvas", { class: "flat", ...HIDDEN }),
      find: grid?.field,
    };
  }

  // Showing

  show() {
    const { work, faces, controls: ui } = this;
    if (!ui) return;
    if (typeof this.chosen === "number" && !work.layers[this.chosen]) this.chosen = null;
    if (work.base !== this.#base && work.base === this.dye) this.dye = unlike(work.base);
    this.#base = work.base;
    if (!(work.kind in this.every)) this.open(work.kind).then(() => this.show());
    ui.kind.show(work.kind);
    ui.undo.disabled = !this.history.past.length;
    ui.redo.disabled = !this.history.future.length;
    ui.over.hidden = shownOf(work).layers.length <= LIMITS.loomLayers;
    ui.count.textContent = this.say("layersCount", { count: work.layers.length, most: TABLES.maxLayers }) + (ui.over.hidden ? "" : ` · ${ui.over.textContent}`);
    ui.empty.hidden = work.layers.length > 0;
    this.#showMode();
    this.host.show();
    if (!faces) return;
    ui.list.show(work, this.chosen, faces);
    if (!this.#frame) this.#frame = requestAnimationFrame(() => this.#showFaces());
  }

  #showMode() {
    const { work, chosen: at, controls: ui } = this;
    const layer = typeof at === "number" ? work.layers[at] : null;
    ui.heading.textContent = layer ? this.say("change", { number: Number(at) + 1, pattern: this.caption(layer.pattern) }) : this.say(at === "field" ? "field" : "add");
    ui.hint.textContent = this.say(layer ? "changeHint" : at === "field" ? "fieldHint" : "addHint");
    ui.done.hidden = at === null;
    ui.dyes.show(layer?.dye ?? (at === "field" ? work.base : this.dye));
  }

  // Previews of all patterns, and what else takes long to draw, once a frame.
  #showFaces() {
    this.#frame = 0;
    const { work, faces, chosen, unseen } = this;
    const { grid, idle, steps } = this.controls;
    if (!faces || !grid) return;
    idle.hidden = !unseen.length;
    idle.textContent = this.say("leaveOut", { count: unseen.length });
    steps.replaceChildren(...recipe(shownOf(work), faces, this));
    const known = work.layers.map((layer, at) => ({ ...layer, at })).filter(({ hidden, pattern }) => !hidden && faces.patterns.includes(pattern));
    const others = known.filter(({ at }) => at !== chosen);
    const place = typeof chosen === "number" ? others.filter(({ at }) => at < chosen).length : others.length;
    const dye = typeof chosen === "number" ? work.layers[chosen].dye : this.dye;
    const names = grid.patterns.map(({ name }) => name);
    grid.show(faces.small.previews({ base: work.base, layers: others }, place, dye, names), typeof chosen === "number" ? work.layers[chosen].pattern : undefined);
    drawPixels(this.parts.flat, faces.face(shownOf(work)));
  }
}
