// <drapery-banner design="white creeper:lime" wind="4">: a banner of live cloth.

import { nameOf, numberOf } from "./attributes.js";
import { Element, define } from "./places.js";
import { Player } from "./player.js";
import { scenesInPage, wake } from "./shared.js";
import { TABLES } from "./tables.js";
import { isSlim, readTexture, wholeSkin } from "./textures.js";

const FOLLOW = 75; // so far the wind turns to each side with the pointer [degrees]
const ATTRIBUTES = ["kind", "view", "daylight", "wind", "direction", "seed", "phase", "paused", "alt"];
const LESS_MOTION = globalThis.matchMedia?.("(prefers-reduced-motion: reduce)");

export class DraperyBanner extends Element {
  static observedAttributes = ["design", "fabric", ...ATTRIBUTES];
  static sources = ["kind", "fabric"]; // attributes that need another scene

  #starts = 0;
  #player = null;
  #seen = true;
  #wind = { wind: undefined, direction: undefined, seed: undefined, phase: undefined };
  #isPaused = undefined; // as the user or the page wants it now; else as the attribute and the system say
  #isStarting = false;
  #films = 0; // that are recorded now
  #isChanged = false; // since the page was told
  #told = new Set();
  #pack = null;
  #canvas = document.createElement("canvas");
  #slot = document.createElement("slot");
  #observers = [
    new ResizeObserver(() => this.#play()),
    new IntersectionObserver((entries) => this.#play(entries.at(-1).isIntersecting)),
  ];

  constructor() {
    super();
    const styles = new CSSStyleSheet();
    styles.replaceSync(TABLES.styles);
    const root = this.attachShadow({ mode: "open" });
    root.adoptedStyleSheets = [styles];
    root.append(this.#canvas, this.#slot);
    Object.assign(this.#canvas, { hidden: true, tabIndex: 0 }).setAttribute("role", "img");
    this.#listen();
  }

  // Whether its cloth is still; the space bar changes it too.
  get paused() {
    return this.#isPaused ?? (this.hasAttribute("paused") || LESS_MOTION.matches);
  }

  set paused(paused) {
    if (this.isConnected) this.#pause(Boolean(paused));
    else this.toggleAttribute("paused", paused);
  }

  // Textures in place of those of the scene: { banner, shield }, each with pixels by the name of a pattern, and
  // by "" what lies below all patterns.
  get pack() {
    return this.#pack;
  }

  set pack(pack) {
    this.#pack = pack;
    if (this.isConnected) this.#start();
  }

  connectedCallback() {
    takeOver(this, ["pack", ...this.constructor.observedAttributes]);
    LESS_MOTION.addEventListener("change", this.#settle);
    this.#observers.forEach((each) => each.observe(this));
    if (!this.#player && !this.#isStarting) this.#start();
  }

  // An element that is put elsewhere goes on as it is.
  disconnectedCallback() {
    queueMicrotask(() => {
      if (this.isConnected) return;
      LESS_MOTION.removeEventListener("change", this.#settle);
      this.#observers.forEach((each) => each.disconnect());
      this.#starts++;
      this.#isStarting = false;
      this.#show(null);
    });
  }

  connectedMoveCallback() {}

  attributeChangedCallback(name, before, now) {
    if (!this.isConnected || before === now) return;
    if (name === "paused") return this.#pause(undefined);
    const isSource = this.constructor.sources.includes(name);
    if (this.#player && !isSource) this.#apply(name);
    else if (isSource || name === "design") this.#start();
  }

  #settle = () => this.#pause(undefined);

  #pause(isPaused) {
    this.#isPaused = isPaused;
    this.#play();
    this.dispatchEvent(new CustomEvent("drapery-pause", { detail: this.paused, bubbles: true }));
  }

  // A PNG of what is seen now, as a Blob.
  async snapshot() {
    this.#shown.draw();
    return new Promise((done) => this.#canvas.toBlob(done));
  }

  // A film of the live cloth, so long [s], as a Blob in the browser's own format: WebM, or MP4. The cloth
  // moves, whether it is in sight, paused or not.
  async record(seconds = "") {
    const length = numberOf("seconds", String(seconds)) ?? 4;
    this.#shown.draw(); // gives the canvas its size, which no film changes
    const recorder = new MediaRecorder(this.#shown.canvas.captureStream());
    const parts = [];
    recorder.ondataavailable = ({ data }) => parts.push(data);
    const ended = new Promise((done) => (recorder.onstop = done));
    this.#films++;
    this.#play();
    recorder.start();
    setTimeout(() => recorder.stop(), 1000 * length);
    await ended;
    this.#films--;
    this.#play();
    return new Blob(parts, { type: recorder.mimeType });
  }

  // The pixels of the still that `drapery render` draws of the design with the scene's options.
  async picture() {
    return this.#shown.picture();
  }

  // The name of its scene, and what replaces parts of it: textures or the fabric.
  async source() {
    const kind = nameOf("kind", this.getAttribute("kind") ?? "standing", [...TABLES.kinds, ...scenesInPage()]);
    const isShield = kind === "shield";
    return [kind, { fabric: isShield ? null : this.getAttribute("fabric"), textures: this.#pack?.[isShield ? "shield" : "banner"] }];
  }

  // What a design looks like, in words.
  words({ base, layers }) {
    const patterns = layers.map(({ pattern, dye }) => `, ${dye} ${pattern}`);
    return `${base} ${this.getAttribute("kind") === "shield" ? "shield" : "banner"}${patterns.join("")}`.replaceAll("_", " ");
  }

  get #shown() {
    if (this.#player) return this.#player;
    throw new Error("drapery: the element shows no live cloth yet; wait for drapery-ready");
  }

  async #start() {
    const start = ++this.#starts;
    this.#isStarting = true;
    try {
      const [kind, { textures = {}, fabric = null }] = await this.source();
      const isWanted = () => start === this.#starts;
      const name = `${kind}.bin`;
      const isOpen = this.#player?.name === name && this.#player.fabric === fabric;
      if (isOpen && isWanted()) return this.#retexture(textures);
      const player = await Player.open(this.#canvas, name, this.getAttribute("design"), { textures, fabric }, isWanted);
      if (isWanted()) this.#show(player);
      else player?.end();
    } catch (error) {
      if (start === this.#starts) this.#tell(error);
    } finally {
      if (start === this.#starts) this.#isStarting = false;
    }
  }

  // Show the live cloth, or without it what the page put into the element.
  #show(player) {
    this.#player?.end();
    this.#player = player;
    this.#canvas.hidden = !player;
    this.#slot.hidden = Boolean(player);
    if (player) this.#apply("view", "daylight", ...Object.keys(this.#wind));
  }

  // Other textures change neither the cloth nor the view.
  #retexture(textures) {
    this.#try((player) => player.retexture(textures));
    this.#isChanged = true;
    this.#apply();
  }

  // Do what attributes say. Only those that have changed are read: a wrong value is told once.
  #apply(...names) {
    for (const name of names)
      this.#try((player) => {
        if (name === "design") player.setDesign(this.getAttribute(name));
        else if (name === "view") player.setView(this.getAttribute(name));
        else if (name === "daylight") player.setDaylight(numberOf(name, this.getAttribute(name)));
        else if (name in this.#wind) this.#wind[name] = numberOf(name, this.getAttribute(name));
        this.#isChanged = true;
      });
    queueMicrotask(() => this.#announce());
    this.#try((player) => this.#blow(player));
    this.#canvas.setAttribute("aria-label", this.getAttribute("alt") ?? this.words(this.#player.design));
    this.#play();
  }

  // One event for all that a page changes at once.
  #announce() {
    if (!this.#isChanged || !this.#player || this.#isStarting) return;
    this.#isChanged = false;
    this.dispatchEvent(new CustomEvent("drapery-ready", { bubbles: true }));
  }

  #blow(player, direction = this.#wind.direction) {
    player.setWind({ ...this.#wind, direction });
  }

  // Act on the live cloth, if there is any, and draw it again.
  #try(act) {
    if (!this.#player) return;
    wake(this.#player);
    try {
      act(this.#player);
    } catch (error) {
      this.#tell(error);
    }
  }

  // One line on the console for each fault; what was seen before stays.
  #tell({ message }) {
    const line = `drapery: ${message}`;
    if (!this.#told.has(line)) console.warn(line);
    this.#told.add(line);
    this.dispatchEvent(new CustomEvent("drapery-error", { detail: line, bubbles: true }));
  }

  #play(seen = this.#seen) {
    this.#seen = seen;
    this.#try((player) => (player.playing = this.#films > 0 || (seen && !this.paused)));
  }

  #listen() {
    const canvas = this.#canvas;
    const on = (name, act) => canvas.addEventListener(name, (event) => this.#try((player) => act(event, player)));
    on("pointerdown", (event, player) => {
      canvas.setPointerCapture(event.pointerId);
      player.grabAt(event.offsetX, event.offsetY);
    });
    on("pointermove", (event, player) => {
      if (player.grab) player.pullTo(event.offsetX, event.offsetY);
      else if (canvas.hasPointerCapture(event.pointerId)) player.orbit.drag(event.movementX, event.movementY);
      else if (event.pointerType === "mouse") this.#follow(event.offsetX, player);
    });
    on("lostpointercapture", (event, player) => player.drop());
    on("pointerleave", (event, player) => this.#blow(player));
    on("keydown", (event, player) => {
      if (event.ctrlKey || event.altKey || event.metaKey) return;
      if (event.key === " ") this.paused = !this.paused;
      else if (!player.orbit.press(event.key)) return;
      event.preventDefault();
    });
  }

  // The wind blows to the viewer, and to the side on which the mouse is.
  #follow(x, player) {
    const side = (2 * x) / this.#canvas.clientWidth - 1;
    const ahead = (player.header.textures && player.cloths[0]?.info.heading) ?? player.azimuth() + player.header.turned;
    this.#blow(player, ahead + FOLLOW * side);
  }
}

// A player with cloth on its back: skin and cape are addresses of PNG files.
export class DraperyPlayer extends DraperyBanner {
  static observedAttributes = ["skin", "cape", "pose", ...ATTRIBUTES];
  static sources = ["skin", "cape", "pose", "kind"];
  static kind = "cape";

  async source() {
    const kind = nameOf("kind", this.getAttribute("kind") ?? this.constructor.kind, [...TABLES.worn, ...scenesInPage()]);
    const pose = nameOf("pose", this.getAttribute("pose") ?? "walk", TABLES.poses);
    const [skin, cape] = await Promise.all(["skin", "cape"].map((name) => readTexture(name, this.getAttribute(name))));
    const shape = skin && isSlim(skin) ? "-slim" : "";
    const textures = { ...(skin && { skin: wholeSkin(skin) }), ...(cape && { cape }) };
    return [TABLES.worn.includes(kind) ? `${kind}-${pose}${shape}` : kind, { textures }];
  }

  words() {
    return `player with ${this.getAttribute("kind") ?? this.constructor.kind}`;
  }
}

export class DraperyCape extends DraperyPlayer {}

export class DraperyElytra extends DraperyPlayer {
  static kind = "elytra";
}

// Properties that a page has set before this module was there.
export function takeOver(element, names) {
  for (const name of names.filter((each) => Object.hasOwn(element, each))) {
    const value = element[name];
    delete element[name];
    element[name] = value;
  }
}

// Properties say what attributes say; null removes one.
for (const element of [DraperyBanner, DraperyPlayer])
  for (const name of element.observedAttributes.filter((each) => each !== "paused"))
    Object.defineProperty(element.prototype, name, {
      configurable: true,
      enumerable: true,
      get() {
        return this.getAttribute(name);
      },
      set(value) {
        if (value === null || value === undefined) this.removeAttribute(name);
        else this.setAttribute(name, value);
      },
    });

const ELEMENTS = { banner: DraperyBanner, player: DraperyPlayer, cape: DraperyCape, elytra: DraperyElytra };
for (const [name, element] of Object.entries(ELEMENTS)) define(`drapery-${name}`, element);
