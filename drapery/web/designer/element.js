// <drapery-designer design="white creeper:lime">: an editor of banners that needs no server.

import { numberOf, short } from "../component/attributes.js";
import { DesignError } from "../component/design.js";
import { DraperyBanner, takeOver } from "../component/element.js";
import { Element, define } from "../component/places.js";
import { fileBytes } from "../component/shared.js";
import { TABLES } from "../component/tables.js";
import { FormError, VERSIONS, notKept, plainText, writeCommand } from "./commands.js";
import { menu, numberField, segments } from "./controls.js";
import { drawPixels, icon, make } from "./dom.js";
import { ENGLISH, Editor } from "./editor.js";
import { Faces } from "./faces.js";
import { MOTION, History, shownOf, workOf, writeHash, writeShorthand } from "./model.js";
import { readPack } from "./pack.js";
import { readHash, readPasted } from "./pasted.js";
import { kept } from "./storage.js";
import { LANGUAGES, STYLES } from "./tables.js";
import { DraperyWearer, readSkin, sheetWith } from "./wearer.js";

const START = "yellow gradient:red gradient_up:magenta flower:white circle:orange curly_border:red";
const VIEWS = ["front", "back", "iso", "hero"];
/** @type {("fabric" | "view" | "daylight")[]} */
const CHOSEN = ["fabric", "view", "daylight"]; // which a package has its own of
const OF_CLOTH = ["wind", "direction", "fabric", "placement"]; // what no shield has
const OF_WEARER = ["wind", "direction", "daylight"];
const BREEZE = { ...MOTION, wind: 6 }; // in which an editor starts
const NARROW = 704; // a page so narrow hides the motion until it is wanted [px]
const STORED = "drapery-designer"; // the key of the history in the browser's storage, before the page's path
const LANGUAGE = ":language";
const MOST_NAMED = 6; // of what a pack lacks
const CHAT = 256; // the longest line of the game's chat [characters]

/** @typedef {import("./model.js").Work} Work */
/** @typedef {import("./model.js").Shown} Shown */
/** @typedef {import("./model.js").Motion} Motion */

const readJson = async (/** @type {string} */ name) => JSON.parse(new TextDecoder().decode(await fileBytes(name)));

export class DraperyDesigner extends Element {
  static observedAttributes = ["design", "wind"];

  /** @type {Editor} */
  #editor = new Editor(new History(readPasted(START, BREEZE).work), {
    openFaces: (kind) => Faces.open(kind, this.#pack?.[/** @type {"banner" | "shield"} */ (kind)]),
    show: () => this.#show(),
    announce: () => this.#announce(),
  });
  #version = VERSIONS[0];
  /** @type {Awaited<ReturnType<typeof readPack>> | null} */
  #pack = null;
  /** @type {ImageData | null} */
  #skin = null; // of the player that wears the design
  #cloth = "cape"; // or tabard, as which it wears that of a banner
  /** @type {any[]} */
  #worn = []; // the design that it wears, its faces, and as what
  /** @type {Record<string, any>} */
  #ui = {};
  /** @type {Promise<void> | undefined} */
  #whole; // once its controls are there

  constructor() {
    super();
    const styles = new CSSStyleSheet();
    styles.replaceSync(`${STYLES.editor} ${STYLES.designer}`);
    this.attachShadow({ mode: "open" }).adoptedStyleSheets = [styles];
    this.addEventListener("dragover", (event) => event.preventDefault());
    this.addEventListener("drop", this.#drop);
  }

  // The design, as the text that links hold. Any form that is read can be set. Throws DesignError.
  get design() {
    return writeShorthand(shownOf(this.#editor.work));
  }

  set design(text) {
    this.setDesign(text);
  }

  /** Show a design in any form that is read, or as an object { base, layers, kind }; it can be undone.
   * Returns the names of what the text says that is not kept. Throws DesignError.
   * @param {string | Shown} design */
  setDesign(design) {
    const text = typeof design === "string" ? design : JSON.stringify({ ...design, layers: design.layers.map(({ pattern, dye }) => ({ pattern, color: dye })) });
    const { work, left } = readPasted(text, this.#editor.work.motion);
    this.#editor.begin(work);
    return left;
  }

  /** The design in all forms: as an object, as text, as a link's `#…`, and as commands by their version;
   * null for a version that cannot hold it. */
  getDesign() {
    const { item } = this.#editor.work;
    const shown = shownOf(this.#editor.work);
    const commands = Object.fromEntries(VERSIONS.map((version) => [version, this.#command(version).text]));
    const { name, lore } = item;
    return { ...shown, text: this.design, hash: writeHash(shown), commands, name: plainText(name), lore: lore.map(plainText), count: item.count };
  }

  connectedCallback() {
    this.#whole ??= this.#start();
    addEventListener("hashchange", this.#follow);
    document.addEventListener("paste", this.#paste);
  }

  disconnectedCallback() {
    removeEventListener("hashchange", this.#follow);
    document.removeEventListener("paste", this.#paste);
  }

  /** @param {string} name @param {string | null} before @param {string | null} now */
  attributeChangedCallback(name, before, now) {
    if (!this.#whole || now === null || now === before) return;
    this.#try(() => {
      if (name === "design") this.setDesign(now);
      else this.#editor.change(this.#moved({ wind: numberOf(name, now) ?? MOTION.wind }));
    });
  }

  /** @param {Partial<Motion>} motion */
  #moved(motion) {
    const { work } = this.#editor;
    return { ...work, motion: { ...work.motion, ...motion } };
  }

  // Do what may fail by what a page or a user says; one line tells it.
  async #try(/** @type {() => unknown} */ act) {
    try {
      await act();
    } catch (error) {
      const message = /** @type {Error} */ (error).message.replace(/^drapery: /, "");
      this.dispatchEvent(new CustomEvent("drapery-error", { detail: `drapery: ${message}`, bubbles: true }));
      this.#editor.tell(message);
    }
  }

  // Beginning

  async #start() {
    const editor = this.#editor;
    [editor.words] = await Promise.all([readJson("words.bin").catch(() => ({})), editor.open("banner"), this.#speak(this.#wanted())]);
    const own = this.getAttribute("design");
    const breeze = { ...BREEZE, ...editor.every.banner?.header.own };
    this.#try(() => (editor.history = new History(readPasted(own ?? START, breeze).work)));
    const before = History.read(kept(() => sessionStorage.getItem(STORED + location.pathname)));
    if (before && own === null) editor.history = before;
    this.#try(() => (editor.history.work = this.#moved({ wind: numberOf("wind", this.getAttribute("wind")) ?? editor.work.motion.wind })));
    this.#build();
    if (this.#hash) this.#follow();
    this.#try(() => takeOver(this, ["design"]));
    editor.show();
    this.dispatchEvent(new CustomEvent("drapery-designer-ready", { bubbles: true }));
  }

  // The code of the language: that of the attribute, chosen before, or one that the user reads.
  #wanted() {
    const chosen = this.getAttribute("language") ?? kept(() => localStorage.getItem(STORED + LANGUAGE));
    return chosen ?? navigator.languages.map((each) => each.slice(0, 2)).find((code) => code === "en" || Object.hasOwn(LANGUAGES, code)) ?? "en";
  }

  // Take the texts of a language; English stays where there is none.
  async #speak(/** @type {string} */ code) {
    try {
      this.#editor.language = Object.hasOwn(LANGUAGES, code) ? { code, ...(await readJson(`${code}.bin`)) } : ENGLISH;
    } catch {
      this.#editor.language = ENGLISH;
    }
  }

  async #changeLanguage(/** @type {string} */ code) {
    kept(() => localStorage.setItem(STORED + LANGUAGE, code));
    await this.#speak(code);
    this.#build();
    this.#editor.show();
    this.#ui.language.focus();
  }

  get #hash() {
    return this.hasAttribute("linked") ? location.hash.slice(1) : "";
  }

  // Show the design of the page's address.
  #follow = () => {
    if (!this.#hash || this.#hash === writeHash(shownOf(this.#editor.work))) return;
    this.#try(() => this.#editor.change(workOf(readHash(this.#hash), {}, this.#editor.work.motion)));
  };

  #announce() {
    kept(() => sessionStorage.setItem(STORED + location.pathname, this.#editor.history.write()));
    const forms = this.getDesign();
    if (this.hasAttribute("linked")) history.replaceState(history.state, "", `#${forms.hash}`);
    this.dispatchEvent(new CustomEvent("drapery-change", { detail: forms, bubbles: true }));
  }

  // The page

  #build() {
    const { say } = this.#editor;
    this.#editor.build();
    const { parts } = this.#editor;
    const language = make("select", { "aria-label": say("language"), onchange: () => this.#changeLanguage(language.value) },
      ...Object.entries({ en: "English", ...LANGUAGES }).map(([value, name]) => make("option", { value, selected: value === this.#editor.language.code }, name)));
    this.#ui = { language };
    const bar = make("header", { class: "bar" },
      make("h1", {}, say("title")), parts.status,
      make("div", { class: "tools", role: "toolbar", "aria-label": say("title") }, parts.undo, parts.redo, parts.random, parts.clear, parts.kind, make("span", { class: "language", "data-code": this.#editor.language.code }, language)));
    const dyes = make("section", { class: "dyes", "aria-label": say("dyes") }, ...parts.dyes);
    const made = parts.patterns && make("section", { class: "make", "aria-label": say("patterns") }, ...parts.patterns);
    const app = make("div", { class: "app", lang: this.#editor.language.code, onkeydown: (/** @type {KeyboardEvent} */ event) => this.#press(event) },
      bar, this.#stage(), dyes, made, this.#side());
    /** @type {ShadowRoot} */ (this.shadowRoot).replaceChildren(app);
  }

  #stage() {
    const { say } = this.#editor;
    const banner = this.#skin ? new DraperyWearer() : new DraperyBanner();
    banner.pack = this.#skin ? this.#dressed() : this.#pack;
    banner.append(this.#editor.parts.flat);
    const fault = make("p", { class: "fault", role: "alert", hidden: true });
    banner.addEventListener("drapery-error", (event) => {
      event.stopPropagation();
      Object.assign(fault, { hidden: false, textContent: String(/** @type {CustomEvent} */ (event).detail).replace(/^drapery: /, "") });
    });
    banner.addEventListener("drapery-ready", () => (fault.hidden = true));
    const pause = make("button", { type: "button", class: "icon pause", onclick: () => (banner.paused = !banner.paused) });
    banner.addEventListener("drapery-pause", () => this.#showPause());
    const number = (/** @type {"wind" | "direction" | "daylight"} */ name, /** @type {string} */ unit, step = 0.5) => {
      const [least, most] = TABLES.bounds[name];
      const change = (/** @type {number} */ value) => this.#editor.change(this.#moved({ [name]: value }), name);
      return numberField({ name: say(name), unit, bounds: [least, most], step, error: say("notNumber", { least, most }), change });
    };
    const among = (/** @type {"placement" | "fabric" | "view"} */ name, /** @type {string[]} */ values) =>
      menu(say(name), Object.fromEntries(values.map((each) => [each, say(each)])), (value) => this.#editor.change(this.#moved({ [name]: value })));
    const numbers = { wind: number("wind", say("unitSpeed")), direction: number("direction", say("unitDegrees")), daylight: number("daylight", "", 0.05) };
    const menus = { placement: among("placement", TABLES.placements), fabric: among("fabric", TABLES.fabrics), view: among("view", VIEWS) };
    const [fields, choices] = [numbers, menus].map((each) => Object.values(each).map(({ whole }) => whole));
    const garments = segments(say("wornAs"), { cape: say("cape"), tabard: say("tabard"), shield: say("shield") }, (name) => this.#hold(name));
    const sky = make("div", { class: "sky" }, banner, pause);
    Object.assign(this.#ui, { banner, fault, pause, sky, garments, motion: { ...numbers, ...menus } });
    return make("section", { class: "stage", "aria-label": say("stage") }, sky, garments.whole, fault,
      make("details", { class: "motion", open: this.clientWidth > NARROW }, make("summary", {}, say("motion")), ...fields, make("div", { class: "menus" }, ...choices)));
  }

  #side() {
    const { say } = this.#editor;
    const version = make("select", { class: "version", "aria-label": say("version"), onchange: () => {
      this.#version = version.value;
      this.#showCommand();
    } }, ...VERSIONS.map((id) => make("option", { value: id }, this.#versionTitle(id))));
    const command = make("textarea", { class: "command", readOnly: true, rows: 3, spellcheck: false, "aria-label": say("copyCommand"), onfocus: () => command.select() });
    const about = make("p", { class: "hint" });
    const copy = make("button", { type: "button", class: "main", onclick: () => this.#copy(command.value, "copyCommand") }, say("copyCommand"));
    const link = make("button", { type: "button", onclick: () => this.#copy(this.#link(), "copyLink") }, say("copyLink"));
    const png = make("button", { type: "button", onclick: () => this.#try(() => this.#save()) }, say("png"));
    const film = make("button", { type: "button", onclick: () => this.#film(film) }, say("animation"));
    const loom = make("details", { class: "panel" }, make("summary", {}, say("loom")), this.#editor.parts.loom);
    const embed = make("button", { type: "button", onclick: () => this.#copy(this.#embed(), "copyEmbed") }, say("copyEmbed"));
    const field = make("input", { type: "text", class: "paste", placeholder: say("pasteHint"), "aria-label": say("paste"), "aria-describedby": "paste-fault", spellcheck: false, autocomplete: "off",
      onkeydown: (/** @type {KeyboardEvent} */ event) => event.key === "Enter" && this.#read(field.value) });
    const wrong = make("p", { class: "fault", id: "paste-fault", role: "alert", hidden: true });
    const chosen = make("input", { type: "file", accept: ".zip,.png", hidden: true, "aria-label": say("openPack"), onchange: () => this.#take(chosen.files[0]) });
    const pack = make("p", { class: "hint pack", role: "status" });
    const without = make("button", { type: "button", class: "without", hidden: !this.#pack, onclick: () => this.#wear(null, "") }, say("withoutPack"));
    const bare = make("button", { type: "button", class: "bare", hidden: !this.#skin, onclick: () => this.#dress(null) }, say("withoutSkin"));
    const openPack = make("button", { type: "button", onclick: () => chosen.click() }, say("openPack"));
    const read = make("button", { type: "button", onclick: () => this.#read(field.value) }, say("read"));
    Object.assign(this.#ui, { version, command, about, copy, field, wrong, film, pack, without });
    return make("section", { class: "side", "aria-label": `${say("layers")}, ${say("share")}` },
      make("div", { class: "panel" }, ...this.#editor.parts.layers),
      make("div", { class: "panel" }, make("h2", {}, say("share")),
        make("div", { class: "row" }, version, copy), command, about,
        make("div", { class: "row" }, link, png, film, embed)),
      make("div", { class: "panel" }, make("h2", {}, say("paste")), make("div", { class: "row" }, field, read), wrong,
        make("div", { class: "row" }, openPack, without, bare, chosen), pack), loom);
  }

  #versionTitle(/** @type {string} */ id) {
    /** @type {Record<string, string>} */
    const ranges = { "1.21.5": "1.21.5+", "1.20.5": "1.20.5 – 1.21.4", 1.13: "1.13 – 1.20.4", 1.8: "1.8 – 1.12" };
    return ranges[id] ? this.#editor.say("java", { version: ranges[id] }) : this.#editor.say("bedrock");
  }

  #press(/** @type {KeyboardEvent} */ event) {
    const isTyping = event.target instanceof HTMLElement && event.target.matches("input:not([type=range]), textarea, select");
    const key = event.key.toLowerCase();
    if ((event.ctrlKey || event.metaKey) && !isTyping && (key === "z" || key === "y")) this.#editor.go(key === "y" || event.shiftKey ? "redo" : "undo");
    else if (key === "/" && !isTyping) this.#editor.parts.find?.focus();
    else if (key === "escape" && !isTyping && this.#editor.chosen !== null) this.#editor.acts.select(null);
    else return;
    event.preventDefault();
  }

  // Showing

  #show() {
    const { work } = this.#editor;
    const ui = this.#ui;
    const { motion } = work;
    ui.fault.hidden = true;
    const isWorn = ui.banner instanceof DraperyWearer;
    const worn = this.#wearing();
    if (isWorn && worn.some((each, at) => each !== this.#worn[at])) ui.banner.pack = this.#dressed();
    ui.garments.whole.hidden = !isWorn;
    ui.garments.show(worn[2]);
    for (const [name, value] of Object.entries(this.#attributes()).filter(([each]) => !isWorn || OF_WEARER.includes(each)))
      if (ui.banner.getAttribute(name) !== value) ui.banner[name] = value;
    for (const [name, control] of Object.entries(ui.motion)) control.show(motion[/** @type {keyof Motion} */ (name)]);
    for (const [name, { whole }] of Object.entries(ui.motion)) whole.hidden = (isWorn && !OF_WEARER.includes(name)) || (work.kind === "shield" && OF_CLOTH.includes(name));
    ui.pause.hidden = ui.film.disabled = work.kind === "shield";
    ui.sky.style.setProperty("--day", String(motion.daylight));
    this.#showPause();
    this.#showCommand();
  }

  /** What the live element has; null for what is the package's own.
   * @returns {Record<string, string | null>} */
  #attributes() {
    const { motion, kind } = this.#editor.work;
    const own = this.#editor.every.banner?.header.own ?? {};
    const changed = CHOSEN.map((name) => [name, motion[name] === own[name] ? null : String(motion[name])]);
    const moved = { kind: motion.placement, wind: String(motion.wind), direction: String(motion.direction) };
    return { design: this.design, ...(kind === "shield" ? { kind } : moved), ...Object.fromEntries(changed) };
  }

  #showPause() {
    const { banner, pause } = this.#ui;
    const label = this.#editor.say(banner.paused ? "play" : "pause");
    pause.replaceChildren(icon(banner.paused ? "play" : "pause"));
    pause.setAttribute("aria-label", label);
    pause.title = label;
  }

  /** @param {string} version @returns {{ text: string | null, reason: string }} */
  #command(version) {
    const { work } = this.#editor;
    try {
      return { text: writeCommand(version, shownOf(work), work.item), reason: "" };
    } catch (error) {
      if (error instanceof FormError) return { text: null, reason: error.message };
      throw error;
    }
  }

  #showCommand() {
    const { command, about, copy } = this.#ui;
    const { text, reason } = this.#command(this.#version);
    const lost = notKept(this.#version, this.#editor.work.item).map((key) => this.#editor.say(key));
    command.value = text ?? "";
    copy.disabled = text === null;
    if (text === null) about.textContent = this.#editor.say("formLacks", { version: this.#versionTitle(this.#version), reason });
    else if (lost.length) about.textContent = this.#editor.say("lost", { what: lost.join(", ") });
    else about.textContent = text.length > CHAT && this.#version !== "bedrock" ? this.#editor.say("long", { count: text.length }) : "";
  }

  // Taking in and out

  #link() {
    const own = this.hasAttribute("linked") ? location.href.split("#")[0] : (this.getAttribute("page") ?? location.href.split("#")[0]);
    return `${own}#${writeHash(shownOf(this.#editor.work))}`;
  }

  #embed() {
    const attributes = Object.entries(this.#attributes()).filter(([, value]) => value !== null).map(([name, value]) => ` ${name}="${value}"`);
    const own = import.meta.url ?? ""; // in a bundle, the module of somebody's site or a file of its maker
    const source = /^https?:.*\/drapery-designer\.js$/.test(own) ? own : "drapery-designer.js";
    return `<script type="module" src="${source}"></${"script"}>\n<drapery-banner${attributes.join("")}></drapery-banner>`;
  }

  async #copy(/** @type {string} */ text, /** @type {string} */ what) {
    try {
      await navigator.clipboard.writeText(text);
      this.#editor.tell(`${this.#editor.say("copied")}: ${this.#editor.say(what)}`);
    } catch {
      const { command } = this.#ui; // pages without https have no clipboard
      command.value = text;
      command.focus();
      command.select();
      const isCopied = document.execCommand("copy");
      this.#editor.tell(this.#editor.say(isCopied ? "copied" : "copyFailed"));
      if (isCopied) this.#showCommand();
    }
  }

  async #save() {
    const { banner } = this.#ui;
    const { kind } = this.#editor.work;
    if (kind === "shield" || this.#pack || this.#skin) return this.#give(await banner.snapshot(), `${kind}.png`);
    const canvas = make("canvas");
    drawPixels(canvas, await banner.picture());
    this.#give(await new Promise((done) => canvas.toBlob(done)), "banner.png");
  }

  async #film(/** @type {HTMLButtonElement} */ button) {
    button.disabled = true;
    await this.#try(async () => {
      const film = await this.#ui.banner.record();
      this.#give(film, `banner.${film.type.includes("mp4") ? "mp4" : "webm"}`);
    });
    button.disabled = false;
  }

  #give(/** @type {Blob} */ file, /** @type {string} */ name) {
    const address = URL.createObjectURL(file);
    make("a", { href: address, download: name }).click();
    setTimeout(() => URL.revokeObjectURL(address), 10_000);
  }

  #read(/** @type {string} */ text) {
    const { field, wrong } = this.#ui;
    try {
      const left = this.setDesign(text);
      field.value = "";
      this.#editor.tell(left.length ? this.#editor.say("notKept", { what: left.join(", ") }) : "");
      wrong.hidden = true;
    } catch (error) {
      if (!(error instanceof DesignError)) throw error;
      field.value = text.slice(0, TABLES.maxText);
      Object.assign(wrong, { hidden: false, textContent: this.#editor.say("notRead", { reason: error.message }) });
    }
    field.setAttribute("aria-invalid", String(!wrong.hidden));
  }

  #drop = (/** @type {DragEvent} */ event) => {
    const [file] = event.dataTransfer?.files ?? [];
    if (!file) return; // a text goes into a field
    event.preventDefault();
    this.#whole?.then(() => this.#take(file));
  };

  // Show all pictures with the textures of a pack, or the player of a skin.
  async #take(/** @type {File} */ file) {
    try {
      if (file.name.toLowerCase().endsWith(".png")) return this.#dress(await readSkin(file), this.#editor.say("skinShown", { name: short(file.name) }));
      const pack = await readPack(file);
      const some = (/** @type {string[]} */ names) => names.slice(0, MOST_NAMED).join(", ") + (names.length > MOST_NAMED ? ` + ${names.length - MOST_NAMED}` : "");
      const told = [this.#editor.say("packShown", { name: short(file.name), count: Object.keys(pack.banner).length + Object.keys(pack.shield).length })];
      if (pack.lacks.length) told.push(this.#editor.say("packLacks", { what: some(pack.lacks.map(this.#editor.caption)) }));
      if (pack.refused.length) told.push(this.#editor.say("packRefused", { what: some(pack.refused) }));
      await this.#wear(pack, told.join(" "));
    } catch (error) {
      this.#tellPack(this.#editor.say("notRead", { reason: /** @type {Error} */ (error).message }), true);
    }
  }

  // Show a player in a skin, who wears the design; null for the banner again.
  #dress(/** @type {ImageData | null} */ skin, told = "") {
    this.#skin = skin;
    this.#build();
    this.#ui.banner.alt = told || null;
    this.#tellPack(told, false);
    this.#editor.show();
  }

  // The design, its faces, and what has them on a player: a shield, once its faces are there.
  #wearing() {
    const { faces, every } = this.#editor;
    return [this.design, faces, faces && faces === every.shield ? "shield" : this.#cloth];
  }

  #dressed() {
    this.#worn = this.#wearing();
    const [, faces, garment] = this.#worn;
    const sheet = sheetWith(faces.small.face(shownOf(this.#editor.work)), garment !== "shield");
    return { skin: this.#skin, garment, sheet, shieldBase: this.#pack?.shield[""] };
  }

  #hold(/** @type {string} */ garment) {
    if (garment !== "shield") this.#cloth = garment;
    this.#editor.setKind(garment === "shield" ? garment : "banner");
    this.#editor.show();
  }

  async #wear(/** @type {typeof this.#pack} */ pack, /** @type {string} */ told) {
    this.#pack = pack;
    await Promise.all(["banner", "shield"].map((kind) => this.#editor.open(kind)));
    if (!this.#skin) this.#ui.banner.pack = pack;
    this.#tellPack(told, false);
    this.#editor.show();
  }

  #tellPack(/** @type {string} */ text, /** @type {boolean} */ isWrong) {
    const { pack, without } = this.#ui;
    pack.textContent = text;
    pack.classList.toggle("fault", isWrong);
    without.hidden = !this.#pack;
  }

  // A text that is pasted outside of fields.
  #paste = (/** @type {ClipboardEvent} */ event) => {
    const [target] = event.composedPath();
    const isOurs = target === document.body || event.composedPath().includes(this);
    if (!isOurs || (target instanceof HTMLElement && target.matches("input, textarea, [contenteditable]"))) return;
    const text = event.clipboardData?.getData("text/plain");
    if (text) this.#whole?.then(() => this.#read(text));
  };
}

define("drapery-designer", DraperyDesigner);
