// <drapery-banner design="white creeper:lime" wind="4">: a banner of live cloth.

import { readDesign } from "./design.js";
import { Player } from "./player.js";
import { wake } from "./shared.js";
import { isSlim, readTexture, wholeSkin } from "./textures.js";

const TURN = 0.0075; // radians a pixel
const STEP = Math.PI / 24;
const FOLLOW = 75; // so far the wind turns to each side with the pointer [degrees]
const STYLE = `
  :host { display: inline-block; inline-size: 14rem; aspect-ratio: 2 / 3; }
  :host([hidden]) { display: none; }
  :host(:focus-visible) { outline: 2px solid Highlight; outline-offset: 2px; }
  canvas { inline-size: 100%; block-size: 100%; display: block; touch-action: pan-y pinch-zoom; }
  canvas[hidden], slot[hidden] { display: none; }
  ::slotted(img) { inline-size: 100%; block-size: 100%; object-fit: contain; }`;
const KEYS = {
  " ": (element) => (element.paused = !element.paused),
  ArrowLeft: (element, orbit) => orbit.turn(-STEP, 0),
  ArrowRight: (element, orbit) => orbit.turn(STEP, 0),
  ArrowUp: (element, orbit) => orbit.turn(0, STEP),
  ArrowDown: (element, orbit) => orbit.turn(0, -STEP),
  "+": (element, orbit) => orbit.dolly(0.9),
  "=": (element, orbit) => orbit.dolly(0.9),
  "-": (element, orbit) => orbit.dolly(1 / 0.9),
  Home: (element, orbit) => orbit.reset(),
};

const ATTRIBUTES = ["kind", "wind", "direction", "paused", "alt"];

export class DraperyBanner extends HTMLElement {
  static observedAttributes = ["design", ...ATTRIBUTES];
  static sources = ["kind"]; // attributes that need another scene

  #attempt = 0;
  #player = null;
  #seen = true;
  #told = "";
  #given = new Set(); // attributes that are not the page's
  #canvas = document.createElement("canvas");
  #slot = document.createElement("slot");
  #resizing = new ResizeObserver(() => this.#resize());
  #seeing = new IntersectionObserver((entries) => this.#play(entries.at(-1).isIntersecting));

  constructor() {
    super();
    const style = new CSSStyleSheet();
    style.replaceSync(STYLE);
    const root = this.attachShadow({ mode: "open" });
    root.adoptedStyleSheets = [style];
    root.append(this.#canvas, this.#slot);
    this.#canvas.hidden = true;
    this.#listen();
  }

  // Whether its cloth is still; the space bar changes it too.
  get paused() {
    return this.hasAttribute("paused");
  }

  set paused(paused) {
    this.toggleAttribute("paused", paused);
  }

  connectedCallback() {
    if (matchMedia("(prefers-reduced-motion: reduce)").matches) this.paused = true;
    this.#resizing.observe(this);
    this.#seeing.observe(this);
    this.#start();
  }

  disconnectedCallback() {
    this.#resizing.disconnect();
    this.#seeing.disconnect();
    this.#attempt++;
    this.#player?.end();
    this.#player = null;
    this.#show(false);
  }

  attributeChangedCallback(name) {
    if (!this.isConnected) return;
    const isSource = this.constructor.sources.includes(name);
    if (this.#player && !isSource) this.#apply(name);
    else if (isSource || name === "design") this.#start();
  }

  // A PNG of what is seen now, as a Blob.
  snapshot() {
    if (!this.#player) throw new Error("drapery: the element shows no live cloth yet; wait for drapery-ready");
    this.#player.draw();
    return new Promise((done) => this.#canvas.toBlob(done));
  }

  // The name of its scene, and the textures that replace those of the scene.
  async source() {
    return [this.getAttribute("kind") ?? "standing", {}];
  }

  // What it shows, in words.
  words({ base = "", layers = [] } = {}) {
    return [`${base} banner`, ...layers.map(({ pattern, dye }) => `${dye} ${pattern}`)].join(", ");
  }

  async #start() {
    const attempt = ++this.#attempt;
    try {
      const design = this.hasAttribute("design") && readDesign(this.getAttribute("design"));
      const [name, textures] = await this.source();
      const player = await Player.open(this.#canvas, `${name}.bin`, textures);
      if (attempt !== this.#attempt) return player.end();
      try {
        if (design) player.setDesign(design);
      } catch (error) {
        player.end();
        throw error;
      }
      this.#player?.end();
      this.#player = player;
      this.#show(true);
    } catch (error) {
      if (attempt === this.#attempt) this.#tell(error);
    }
  }

  #apply(name) {
    try {
      const player = this.#player;
      if (name === "design" && this.hasAttribute("design")) player.setDesign(readDesign(this.getAttribute("design")));
      this.#play();
      this.#describe();
      if (name === "wind" || name === "direction") player.setWind(this.#number("wind"), this.#number("direction"));
    } catch (error) {
      this.#tell(error);
    }
  }

  // One line on the console for each fault; what was seen before stays.
  #tell(error) {
    const line = `drapery: ${error.message}`;
    if (line !== this.#told) console.warn(line);
    this.#told = line;
    this.dispatchEvent(new CustomEvent("drapery-error", { detail: line, bubbles: true }));
  }

  #number(name) {
    const text = this.getAttribute(name)?.trim();
    const number = text ? Number(text) : undefined;
    if (Number.isNaN(number)) throw new Error(`${name}="${text}" is not a number`);
    return number;
  }

  // Show the live cloth, or else what the page put into the element.
  #show(live) {
    this.#canvas.hidden = !live;
    this.#slot.hidden = live;
    if (live) {
      this.#give("role", "img");
      this.#give("tabindex", "0");
      this.#apply("wind");
      this.#resize();
      this.dispatchEvent(new CustomEvent("drapery-ready", { bubbles: true }));
    } else this.#given.forEach((name) => this.removeAttribute(name));
  }

  #give(name, value) {
    if (this.hasAttribute(name) && !this.#given.has(name)) return;
    this.#given.add(name);
    this.setAttribute(name, value);
  }

  #describe() {
    const words = this.words(this.#player.design);
    this.#give("aria-label", this.getAttribute("alt") ?? words.replaceAll("_", " ").trim());
  }

  #play(seen = this.#seen) {
    this.#seen = seen;
    if (!this.#player) return;
    this.#player.playing = seen && !this.paused;
    wake(this.#player);
  }

  #resize() {
    const ratio = devicePixelRatio || 1;
    const finer = ratio < 1.5 ? 2 : 1; // the browser scales the picture down, which smooths edges
    const { clientWidth, clientHeight } = this.#canvas;
    const [width, height] = [clientWidth, clientHeight].map((side) => Math.round(side * ratio * finer));
    if (this.#canvas.width !== width || this.#canvas.height !== height) {
      Object.assign(this.#canvas, { width, height });
      if (this.#player?.moved && width && height) this.#player.draw(); // a new size clears the canvas
    }
    this.#play();
  }

  #listen() {
    const canvas = this.#canvas;
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      this.#player.grabAt(event.offsetX, event.offsetY);
    });
    canvas.addEventListener("pointermove", (event) => {
      if (!canvas.hasPointerCapture(event.pointerId)) this.#follow(event);
      else if (this.#player.grab) this.#player.pullTo(event.offsetX, event.offsetY);
      else this.#player.orbit.turn(-TURN * event.movementX, TURN * event.movementY);
      wake(this.#player);
    });
    canvas.addEventListener("lostpointercapture", () => this.#player?.drop());
    canvas.addEventListener("pointerleave", () => this.#player && this.#apply("wind"));
    this.addEventListener("keydown", (event) => {
      if (!this.#player || !Object.hasOwn(KEYS, event.key) || event.ctrlKey || event.altKey || event.metaKey) return;
      event.preventDefault();
      KEYS[event.key](this, this.#player.orbit);
      wake(this.#player);
    });
  }

  // The wind blows to the viewer, and to the side on which the mouse is.
  #follow({ pointerType, offsetX }) {
    if (pointerType !== "mouse") return;
    const side = (2 * offsetX) / this.#canvas.clientWidth - 1;
    const ahead = this.#player.heading ?? this.#player.azimuth() + this.#player.header.turned;
    const heading = ahead + FOLLOW * side;
    try {
      this.#player.setWind(this.#number("wind"), heading);
    } catch (error) {
      this.#tell(error);
    }
  }
}

// A player with cloth on its back: skin and cape are addresses of PNG files.
export class DraperyPlayer extends DraperyBanner {
  static observedAttributes = ["skin", "cape", "pose", ...ATTRIBUTES];
  static sources = ["skin", "cape", "pose", "kind"];
  static kind = "cape";

  async source() {
    const [skin, cape] = await Promise.all(["skin", "cape"].map((name) => readTexture(name, this.getAttribute(name))));
    const [kind, pose] = [this.getAttribute("kind") ?? this.constructor.kind, this.getAttribute("pose")];
    const shape = skin && isSlim(skin) ? "-slim" : "";
    const textures = { ...(skin && { skin: wholeSkin(skin) }), ...(cape && { cape }) };
    return [kind === "player" ? kind : `${kind}-${pose ?? "walk"}${shape}`, textures];
  }

  words() {
    return `player with ${this.getAttribute("kind") ?? this.constructor.kind}`;
  }
}

export class DraperyCape extends DraperyPlayer {}

export class DraperyElytra extends DraperyPlayer {
  static kind = "elytra";
}

const ELEMENTS = { banner: DraperyBanner, player: DraperyPlayer, cape: DraperyCape, elytra: DraperyElytra };
for (const [name, element] of Object.entries(ELEMENTS)) customElements.define(`drapery-${name}`, element);
