// The live cloth of the studio: the browser plays the scenes that the server makes, with its user's
// camera, hand and keys. A picture by the renderer stands for what cannot be played.

import { Player } from "../web/component/player.js";
import { wake, wholeContext } from "../web/component/shared.js";
import { TABLES } from "../web/component/tables.js";
import { unpack } from "../web/viewer/messages.js";
import { Orbit } from "../web/viewer/orbit.js";
import { InputHandler } from "./live_input.js";

const TURN_RATE = 150; // how fast the keys turn the wind [degrees/s]
const SPEED_RATE = 5; // how fast they change its speed [m/s²]
const KEY_DIRECTIONS = { w: 180, s: 0, a: -90, d: 90 }; // seen by the viewer: away, towards, left, right [degrees]

// The same direction as -180 to 180 degrees.
const around = (degrees) => ((((degrees + 180) % 360) + 360) % 360) - 180;

const between = (value, least, most) => Math.min(most, Math.max(least, value));

// The wind, { speed, heading }, after keys have been held for a time [s]. azimuth: that of the viewer in the
// frame of the cloth [degrees].
function steered({ speed, heading }, keys, azimuth, seconds) {
  const towards = Object.keys(KEY_DIRECTIONS).filter((key) => keys.has(key));
  const angles = towards.map((key) => ((azimuth + KEY_DIRECTIONS[key]) * Math.PI) / 180);
  const [x, z] = [Math.sin, Math.cos].map((part) => angles.reduce((sum, angle) => sum + part(angle), 0));
  const limit = TURN_RATE * seconds;
  const turn = x * x + z * z > 1e-6 ? between(around((Math.atan2(x, z) * 180) / Math.PI - heading), -limit, limit) : 0;
  const rise = SPEED_RATE * seconds * (keys.has("e") - keys.has("q"));
  return { speed: between(speed + rise, ...TABLES.bounds.wind), heading: turn ? around(heading + turn) : heading };
}

// What an address answers. Throws an Error with the server's line for what it refuses.
async function answerOf(address) {
  const answer = await fetch(address);
  if (answer.status !== 200) throw new Error(await answer.text()); // 204: it is not shown any more
  return answer;
}

const bytesOf = async (answer) => new Uint8Array(await (await answer).arrayBuffer());

class CountedPlayer extends Player {
  moment(seconds) {
    this.count?.();
    return super.moment(seconds);
  }
}

export class LiveViewer {
  // host: the element for the canvases. tell: takes what the page shows beside them: line, picture, wind,
  // azimuth, rate. emit: takes the name of an event for the server, and its value.
  constructor(host, tell, emit) {
    Object.assign(this, { host, tell, emit, players: [], modules: {}, keys: new Set(), seen: true, shown: 0 });
    this.orbit = new Orbit();
    this.input = new InputHandler(this);
    // Until the server knows it.
    this.isStill = matchMedia("(prefers-reduced-motion: reduce)").matches;
    if (this.isStill) emit("still");
    this.observers = [
      new ResizeObserver(() => this.redraw()),
      new IntersectionObserver((entries) => this.play(entries.at(-1).isIntersecting)),
    ];
    this.observers.forEach((each) => each.observe(host));
    this.follow = (event) => this.lay(event.detail.text);
    document.addEventListener("drapery-change", this.follow);
    this.counting = setInterval(() => {
      this.tell({ rate: this.shown });
      this.shown = 0;
    }, 1000);
  }

  end() {
    this.isOver = true;
    clearInterval(this.counting);
    document.removeEventListener("drapery-change", this.follow);
    this.observers.forEach((each) => each.disconnect());
    this.input.end();
    this.replace([]);
  }

  // Begin in a place that the page has before its framework.
  static begin(place, state) {
    const [told, events] = [{}, []];
    const viewer = new LiveViewer(place.firstChild, (each) => Object.assign(told, each), (...event) => events.push(event));
    this.first = place.viewer = Object.assign(viewer, { told, events });
    viewer.show(state);
  }

  // The viewer in the place of an element of the framework: the first one goes on there.
  static at(host, tell, emit) {
    const viewer = this.first ?? new LiveViewer(host, tell, emit);
    if (this.first) {
      viewer.host.parentElement.remove();
      host.replaceWith(viewer.host);
      Object.assign(viewer, { tell, emit });
      tell(viewer.told);
      viewer.events.forEach((event) => emit(...event));
    }
    this.first = null;
    return viewer;
  }

  // What the server wants to be seen; `Viewport.shown` says what it has.
  show(state) {
    const before = this.state;
    this.state = state;
    if (before) this.apply(before);
    this.load();
  }

  // Show what the page's editor has, before the server knows it.
  lay(text) {
    this.laid = text;
    try {
      this.each((player) => player.setDesign(this.design));
    } catch {
      // The server says what is wrong, or has a scene for it.
    }
  }

  // The design of the scenes; null where they have a texture instead.
  get design() {
    return this.state.design && (this.laid ?? this.state.design);
  }

  // The address of what is to be seen: of the scenes, or of the picture instead of them.
  get wanted() {
    const scenes = this.state.scenes.join(" ");
    return !scenes || scenes === this.refused ? this.state.pictures.join(" ") : scenes;
  }

  // Load what is wanted until it is here; what is passed over is not asked for.
  async load() {
    if (this.isLoading) return;
    this.isLoading = true;
    while (!this.isOver && this.wanted !== this.loaded) {
      const { wanted } = this;
      const { scenes, pictures } = this.state;
      const isPicture = wanted === pictures.join(" ");
      try {
        await (isPicture ? this.showPictures(pictures) : this.openScenes(scenes));
        this.loaded = wanted;
      } catch (error) {
        if (isPicture) this.loaded = wanted;
        else this.refused = wanted;
        this.reason = error.message;
        this.tell({ line: error.message });
      }
    }
    this.isLoading = false;
  }

  async openScenes(addresses) {
    this.tell({ line: this.state.line });
    await wholeContext(); // throws an Error where there is no WebGL 2
    const files = await Promise.all(addresses.map((address) => this.fileOf(address)));
    if (this.isOver) return;
    const canvases = this.canvasesFor(files.length);
    const made = files.map(([file, module], number) => CountedPlayer.made(canvases[number], unpack(file.buffer), module, this.design));
    const players = await Promise.all(made);
    const follows = players.map((player, number) => this.players.length > 0 && player.follow(this.players[number] ?? this.players[0]));
    this.isDisturbed = follows.includes(true) && (this.isDisturbed || this.motion !== this.state.motion);
    this.motion = this.state.motion;
    this.replace(players);
    this.apply(null);
    this.tell({ line: this.state.line, picture: null });
  }

  // A scene, and the module of the kernels that it calls: the same object for the same kernels.
  async fileOf(address) {
    const answer = await answerOf(address);
    const kernels = answer.headers.get("kernels");
    this.modules[kernels] ??= bytesOf(answerOf(kernels));
    this.modules[kernels].catch(() => delete this.modules[kernels]); // the next scene tries again
    return Promise.all([bytesOf(answer), this.modules[kernels]]);
  }

  // Show one picture after the other, as long as they are wanted.
  async showPictures(addresses) {
    const { scenes, line, note } = this.state;
    this.tell({ line: note || line });
    for (const [number, address] of addresses.entries()) {
      const url = URL.createObjectURL(await (await answerOf(address)).blob());
      if (this.wanted !== addresses.join(" ")) return;
      this.replace([]);
      URL.revokeObjectURL(this.url);
      this.url = url;
      const isLast = number === addresses.length - 1;
      this.tell({ picture: url, wind: null, line: (!isLast && note) || (scenes.length ? this.reason : line) });
    }
  }

  replace(players) {
    this.players.forEach((player) => player.end());
    this.players = players;
    if (!players.length) this.host.replaceChildren();
  }

  // So many canvases with the names of what they show.
  canvasesFor(count) {
    if (this.host.children.length !== count)
      this.host.replaceChildren(
        ...Array.from({ length: count }, () => {
          const pane = Object.assign(document.createElement("div"), { className: "viewer-pane" });
          const canvas = document.createElement("canvas");
          canvas.setAttribute("aria-label", this.host.getAttribute("aria-label"));
          pane.append(canvas, document.createElement("span"));
          return pane;
        }),
      );
    const panes = [...this.host.children];
    panes.forEach((pane, number) => (pane.lastChild.textContent = this.state.labels[number] ?? ""));
    return panes.map((pane) => pane.firstChild);
  }

  each(act) {
    this.players.forEach(act);
  }

  // Do what has changed since an earlier state; all of it for new players.
  apply(before) {
    const { state } = this;
    const differs = (...names) => !before || names.some((name) => before[name] !== state[name]);
    try {
      if (differs("design")) this.each((player) => player.setDesign(this.design));
      if (differs("daylight")) this.each((player) => player.setDaylight(state.daylight));
    } catch (error) {
      this.tell({ line: error.message });
    }
    if (this.cut !== state.cut) this.orbit.reset();
    if (differs("view", "cut"))
      this.each((player) => {
        player.setView(state.view);
        player.orbit = this.orbit;
      });
    this.cut = state.cut;
    if (before && differs("starts")) {
      this.each((player) => player.reset());
      this.isDisturbed = false;
    }
    if (differs("wind", "direction", "on")) this.blow({ speed: state.wind, heading: state.direction ?? this.cloth?.info.heading ?? 0, on: state.on });
    const isPausedByUser = before && !before.paused && state.paused && !this.isStill;
    if (isPausedByUser && this.cloth && !this.isDisturbed) this.emit("stopped", this.time);
    if (state.paused) this.isStill = false;
    this.play();
  }

  play(seen = this.seen) {
    this.seen = seen;
    this.each((player) => (player.playing = seen && !this.state.paused && !this.isStill));
    if (this.players[0]) this.players[0].count = () => this.count();
    this.redraw();
  }

  redraw() {
    this.each(wake);
  }

  count() {
    this.shown++;
    const { speed, heading, on } = this.wind;
    const wind = this.cloth ? [speed, heading - this.turned, on] : null;
    this.tell({ wind, azimuth: this.azimuth() });
  }

  get cloth() {
    return this.players[0]?.cloths[0];
  }

  // The simulated time [s].
  get time() {
    return this.cloth?.time ?? 0;
  }

  get turned() {
    return this.players[0]?.header.turned ?? 0;
  }

  azimuth() {
    return this.players[0]?.azimuth() ?? 0;
  }

  // The wind

  blow(wind) {
    const before = String(Object.values(this.wind ?? {}));
    this.wind = { ...this.wind, ...wind };
    this.isDisturbed ||= this.time > 0 && before !== String(Object.values(this.wind));
    const { speed, heading, on } = this.wind;
    this.each((player) => player.setWind({ wind: on ? speed : 0, direction: heading }));
    this.redraw();
  }

  switchWind() {
    if (!this.cloth) return;
    this.blow({ on: !this.wind.on });
    this.emit("switch");
  }

  // Steer the wind as long as keys are held, then tell the server. keys: a set that changes with them.
  steer(keys) {
    this.keys = keys;
    if (this.steering || !keys.size || !this.cloth) return;
    let before = performance.now();
    const step = (now) => {
      this.blow(steered(this.wind, this.keys, this.azimuth() + this.turned, Math.max(0, now - before) / 1000));
      before = now;
      this.steering = this.keys.size ? requestAnimationFrame(step) : null;
      if (!this.keys.size) this.emit("wind", [this.wind.speed, this.wind.heading]);
    };
    this.steering = requestAnimationFrame(step);
  }

  // The hand: two designs side by side have one motion.

  hitsCloth(x, y) {
    return this.cloth !== undefined && this.players[0].hitsCloth(x, y);
  }

  grabAt(x, y) {
    this.each((player) => player.grabAt(x, y));
    const isGrabbed = Boolean(this.players[0]?.grab);
    this.isDisturbed ||= isGrabbed;
    this.redraw();
    return isGrabbed;
  }

  pullTo(x, y) {
    this.each((player) => player.grab && player.pullTo(x, y));
  }

  drop() {
    this.each((player) => player.drop());
  }
}
