// The live cloth on a canvas: what the server streams, seen from where the user has walked to.

import { Drawing } from "./drawing.js";
import { Hands } from "./input.js";
import { clipMatrix, readCamera, sight } from "./matrices.js";
import { azimuth, Orbit } from "./orbit.js";
import { meetsCloth } from "./picking.js";
import { Stream } from "./stream.js";

const SLOW = 40; // milliseconds for a picture
const NO_WEBGL =
  "The live cloth needs WebGL 2, which this browser does not offer: turn on its hardware acceleration, or use another.";

export class Viewer {
  // tell: takes a line for the user; labels: an element for the panes' labels; state: takes what
  // the wind does and how many pictures a second are drawn.
  constructor(canvas, labels, address, tell, state) {
    Object.assign(this, { canvas, labels, tell, state });
    this.orbit = new Orbit();
    this.cameras = [];
    this.undrawn = 0;
    this.drawn = 0;
    const gl = canvas.getContext("webgl2", { alpha: true, antialias: false, premultipliedAlpha: true });
    if (!gl) return void tell(NO_WEBGL);
    this.gl = gl;
    this.drawing = new Drawing(gl);
    this.stream = new Stream(address, (message) => this.hear(message), tell);
    this.hands = new Hands(this);
    this.watch();
  }

  watch() {
    this.ears = [
      [this.canvas, "webglcontextlost", (event) => this.lose(event)],
      [this.canvas, "webglcontextrestored", () => this.restore()],
      [document, "visibilitychange", () => this.hide()],
    ];
    for (const [target, name, call] of this.ears) target.addEventListener(name, call);
    this.resizing = new ResizeObserver(() => this.resize());
    this.resizing.observe(this.canvas);
    this.seeing = new IntersectionObserver(([entry]) => {
      this.away = !entry.isIntersecting;
      this.hide();
    });
    this.seeing.observe(this.canvas);
    this.counting = setInterval(() => this.count(), 1000);
    this.resize();
  }

  end() {
    clearInterval(this.counting);
    cancelAnimationFrame(this.frame);
    this.resizing?.disconnect();
    this.seeing?.disconnect();
    for (const [target, name, call] of this.ears ?? []) target.removeEventListener(name, call);
    this.hands?.end();
    this.stream?.end();
    this.drawing?.free();
  }

  hear({ header, arrays }) {
    this.undrawn++;
    if (header.kind === "scene") {
      this.sceneMessage = { header, arrays };
      this.drawing.setScene(header, arrays);
      this.untried = header.samples > 1 && !this.coarse;
      this.resize();
      this.label(header);
    } else if (header.version === this.drawing.scene?.header.version) {
      this.drawing.setMoment(header, arrays);
      this.wind = header.wind ?? null;
      this.time = header.time;
      if (header.cameras) this.look(header.cameras);
    }
    this.redraw();
  }

  look({ cut, list }) {
    if (cut) this.orbit.reset();
    this.cameras = list.map(readCamera);
  }

  // The panes' labels, over them.
  label({ panes, columns }) {
    this.labels.replaceChildren();
    if (!panes.some((pane) => pane.label)) return;
    this.labels.style.gridTemplateColumns = `repeat(${columns}, 1fr)`;
    for (const pane of panes) {
      const cell = document.createElement("div");
      const text = document.createElement("span");
      text.textContent = pane.label;
      cell.append(text);
      this.labels.append(cell);
    }
  }

  redraw() {
    this.frame ??= requestAnimationFrame(() => {
      this.frame = null;
      this.draw();
      if (this.undrawn) {
        this.stream.say({ drawn: this.undrawn });
        this.drawn++;
        this.undrawn = 0;
      }
    });
  }

  draw() {
    // The cameras of a scene come with its first moment, which may be a frame later.
    if (this.gl.isContextLost() || this.cameras.length !== this.drawing.scene?.header.panes.length) return;
    const rects = this.rects(this.canvas.width, this.canvas.height);
    const matrices = rects.map(([, , width, height], number) => clipMatrix(this.camera(number), width / height));
    const start = performance.now();
    this.drawing.draw(rects, matrices);
    if (this.untried) this.judge(start);
    if (this.wind) this.state({ wind: this.wind, azimuth: this.azimuth() });
    else this.state({ wind: null });
  }

  // Where a picture takes too long, one sample a pixel must do.
  judge(start) {
    this.untried = false;
    this.gl.readPixels(0, 0, 1, 1, this.gl.RGBA, this.gl.UNSIGNED_BYTE, new Uint8Array(4));
    this.coarse = performance.now() - start > SLOW;
    if (this.coarse) this.resize();
  }

  camera(number) {
    const base = this.cameras[number];
    return this.drawing.scene.header.panes[number].flat ? base : this.orbit.camera(base);
  }

  // Each pane's rectangle in a canvas of this size, from the lower left.
  rects(width, height) {
    const { panes, columns } = this.drawing.scene.header;
    const rows = Math.ceil(panes.length / columns);
    const [wide, high] = [Math.floor(width / columns), Math.floor(height / rows)];
    return panes.map((pane, number) => {
      const row = Math.floor(number / columns);
      return [(number % columns) * wide, height - (row + 1) * high, wide, high];
    });
  }

  // The pane at a point of the canvas [CSS pixels], and the line of sight through that point.
  sightAt(x, y) {
    if (!this.cameras.length) return null;
    const { clientWidth, clientHeight } = this.canvas;
    const up = clientHeight - y;
    const rects = this.rects(clientWidth, clientHeight);
    const number = rects.findIndex(([l, b, w, h]) => x >= l && x < l + w && up >= b && up < b + h);
    // A drag may leave its pane and the canvas; the line of sight is then that of its pane.
    const pane = this.hands?.pulling && this.pane !== undefined ? this.pane : number;
    if (pane < 0 || !this.cameras[pane]) return null;
    const [left, bottom, width, height] = rects[pane];
    const [cx, cy] = [(2 * (x - left)) / width - 1, (2 * (up - bottom)) / height - 1];
    return { pane, ray: sight(this.camera(pane), width / height, cx, cy) };
  }

  grips(x, y) {
    const found = this.sightAt(x, y);
    if (!found || !this.drawing.scene.header.grip.length) return false;
    this.pane = found.pane;
    return meetsCloth(this.drawing.scene, found.pane, found.ray);
  }

  ray(x, y) {
    const { ray } = this.sightAt(x, y);
    return [...ray.origin, ...ray.along, ...ray.facing];
  }

  azimuth() {
    return this.cameras.length ? azimuth(this.camera(0)) : 0;
  }

  say(words) {
    this.stream.say(words);
  }

  resize() {
    const { clientWidth, clientHeight } = this.canvas;
    if (!clientWidth || !clientHeight) return this.hide();
    // More samples a pixel are drawn as a larger picture, which the browser makes smaller.
    const ratio = window.devicePixelRatio || 1;
    const finer = (this.drawing.scene?.header.samples ?? 1) > 1 && ratio < 1.5 && !this.coarse ? 2 : 1;
    const [width, height] = [clientWidth, clientHeight].map((side) => Math.round(side * ratio * finer));
    if (this.canvas.width !== width || this.canvas.height !== height) {
      Object.assign(this.canvas, { width, height });
      this.redraw();
    }
    const shape = `${clientWidth}x${clientHeight}`;
    if (shape !== this.shape) this.stream.say({ shape: [clientWidth, clientHeight] }, true);
    this.shape = shape;
    this.hide();
  }

  // What nobody sees need not move.
  hide() {
    const hidden = document.hidden || this.away || !this.canvas.clientWidth;
    if (hidden !== this.hidden) this.stream?.say({ hidden }, true);
    if (hidden) this.hands?.release();
    this.hidden = hidden;
  }

  lose(event) {
    event.preventDefault();
    this.tell("The graphics card has been lost; waiting for it.");
  }

  restore() {
    this.tell("");
    const { positions, light } = this.drawing.scene ?? {};
    const { tints } = this.drawing;
    this.drawing = new Drawing(this.gl);
    if (!this.sceneMessage || !tints) return;
    this.drawing.setScene(this.sceneMessage.header, this.sceneMessage.arrays);
    this.drawing.setMoment({ runs: [[0, light.length]], tints }, { positions, light });
    this.redraw();
  }

  count() {
    this.state({ rate: this.drawn });
    this.drawn = 0;
  }

  // The picture as a PNG's data URL, drawn now.
  snapshot() {
    this.draw();
    return this.canvas.toDataURL("image/png");
  }
}
