// The live cloth on a canvas: draws what the server streams, with the user's camera.

import { clear, Drawing } from "./drawing.js";
import { InputHandler } from "./input.js";
import { readCamera } from "./matrices.js";
import { Stream } from "./stream.js";
import { View } from "./view.js";

const SLOW = 40; // time to draw a picture [ms]
const NO_WEBGL =
  "The live cloth needs WebGL 2, which this browser does not offer: turn on its hardware acceleration, or use another browser.";

export class Viewer extends View {
  // onStatus: takes a line for the user; labels: an element for the panes' labels; onState: takes
  // the wind and the number of pictures drawn per second.
  constructor(canvas, labels, address, onStatus, onState) {
    super(canvas);
    Object.assign(this, { labels, onStatus, onState });
    this.undrawn = 0;
    this.drawn = 0;
    const gl = canvas.getContext("webgl2", { alpha: true, antialias: false, premultipliedAlpha: true });
    if (!gl) {
      onStatus(NO_WEBGL);
      return;
    }
    this.gl = gl;
    this.drawing = new Drawing(gl);
    this.stream = new Stream(address, (message) => this.receive(message), onStatus);
    this.input = new InputHandler(this);
    this.watch();
    if (matchMedia("(prefers-reduced-motion: reduce)").matches) this.stream.send({ still: true }, true);
  }

  watch() {
    this.listeners = [
      [this.canvas, "webglcontextlost", (event) => this.lose(event)],
      [this.canvas, "webglcontextrestored", () => this.restore()],
      [document, "visibilitychange", () => this.hide()],
    ];
    for (const [target, name, call] of this.listeners) target.addEventListener(name, call);
    this.resizing = new ResizeObserver(() => this.resize());
    this.resizing.observe(this.canvas);
    this.seeing = new IntersectionObserver((entries) => {
      this.away = !entries.at(-1).isIntersecting;
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
    for (const [target, name, call] of this.listeners ?? []) target.removeEventListener(name, call);
    this.input?.end();
    this.stream?.end();
    this.drawing?.free();
  }

  receive({ header, arrays }) {
    this.undrawn++;
    if (header.kind === "scene") {
      this.sceneMessage = { header, arrays };
      this.drawing.setScene(header, arrays);
      this.untimed = header.samples > 1 && !this.tooSlow;
      this.resize();
      this.label(header);
    } else if (header.version === this.drawing.scene?.header.version) {
      this.drawing.setMoment(header, arrays);
      this.wind = header.wind ?? null;
      this.time = header.time;
      if (header.cameras) this.setCameras(header.cameras);
    }
    this.redraw();
  }

  setCameras({ cut, list }) {
    if (cut) this.orbit.reset();
    this.cameras = list.map(readCamera);
  }

  // Place the labels over the panes.
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
        this.stream.send({ drawn: this.undrawn });
        this.drawn++;
        this.undrawn = 0;
      }
    });
  }

  draw() {
    // The first moment of a scene brings its cameras; it may arrive one frame after the scene.
    if (this.gl.isContextLost() || !this.complete) return;
    const start = performance.now();
    const { width, height } = this.canvas;
    clear(this.gl, [0, 0, width, height]);
    this.drawPanes(width, height);
    if (this.untimed) this.measure(start);
    if (this.wind) this.onState({ wind: this.wind, azimuth: this.azimuth() });
    else this.onState({ wind: null });
  }

  // If a picture takes too long, draw with one sample per pixel.
  measure(start) {
    this.untimed = false;
    this.gl.readPixels(0, 0, 1, 1, this.gl.RGBA, this.gl.UNSIGNED_BYTE, new Uint8Array(4));
    this.tooSlow = performance.now() - start > SLOW;
    if (this.tooSlow) this.resize();
  }

  rayAt(x, y) {
    return super.rayAt(x, y, this.input?.pulling ? this.pane : undefined);
  }

  ray(x, y) {
    const { ray } = this.rayAt(x, y);
    return [...ray.origin, ...ray.along, ...ray.facing];
  }

  send(message) {
    this.stream.send(message);
  }

  resize() {
    const { clientWidth, clientHeight } = this.canvas;
    if (!clientWidth || !clientHeight) return this.hide();
    // Several samples per pixel: draw a larger picture, which the browser scales down.
    const ratio = window.devicePixelRatio || 1;
    const finer = (this.drawing.scene?.header.samples ?? 1) > 1 && ratio < 1.5 && !this.tooSlow ? 2 : 1;
    const [width, height] = [clientWidth, clientHeight].map((side) => Math.round(side * ratio * finer));
    if (this.canvas.width !== width || this.canvas.height !== height) {
      Object.assign(this.canvas, { width, height });
      this.redraw();
    }
    const shape = `${clientWidth}x${clientHeight}`;
    if (shape !== this.shape) this.stream.send({ shape: [clientWidth, clientHeight] }, true);
    this.shape = shape;
    this.hide();
  }

  // Report whether the viewer is visible: a hidden viewer does not need motion.
  hide() {
    const hidden = document.hidden || this.away || !this.canvas.clientWidth;
    if (hidden !== this.hidden) this.stream?.send({ hidden }, true);
    if (hidden) this.input?.release();
    this.hidden = hidden;
  }

  lose(event) {
    event.preventDefault();
    this.onStatus("The graphics card has been reset; waiting for it.");
  }

  restore() {
    this.onStatus("");
    const { positions, light } = this.drawing.scene ?? {};
    const { tints } = this.drawing;
    this.drawing = new Drawing(this.gl);
    if (!this.sceneMessage || !tints) return;
    this.drawing.setScene(this.sceneMessage.header, this.sceneMessage.arrays);
    this.drawing.setMoment({ runs: [[0, light.length]], tints }, { positions, light });
    this.redraw();
  }

  count() {
    this.onState({ rate: this.drawn });
    this.drawn = 0;
  }

  // The picture as a PNG's data URL, drawn now.
  snapshot() {
    this.draw();
    return this.canvas.toDataURL("image/png");
  }
}
