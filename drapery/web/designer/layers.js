// The list of layers, the highest first, and the field below them.

import { HIDDEN, drawPixels, icon, iconButton, make, roving } from "./dom.js";

/** @typedef {import("./model.js").Work} Work */
/** @typedef {{ select(at: number | "field" | null): void, move(from: number, to: number): void, hide(at: number): void, remove(at: number): void, double(at: number): void }} Acts */

export class LayerList {
  /** @param {Acts} acts @param {(key: string, values?: Record<string, any>) => string} say
   * @param {{ dye: (name: string) => string, pattern: (name: string) => string }} titles */
  constructor(acts, say, titles) {
    this.acts = acts;
    this.say = say;
    this.titles = titles;
    this.list = make("ol", { class: "layer-list", "aria-label": say("layers") });
    roving(this.list, () => [...this.list.querySelectorAll(".layer")], true);
  }

  /** @param {Work} work @param {number | "field" | null} chosen @param {import("./faces.js").Faces} faces */
  show(work, chosen, faces) {
    const focused = /** @type {any} */ (this.list.getRootNode()).activeElement;
    const kept = this.list.contains(focused) ? { at: focused.closest("li").dataset.at, kind: focused.className } : null;
    const rows = work.layers.map((layer, at) => this.row(layer, at, chosen === at, faces));
    this.list.replaceChildren(...rows.reverse(), this.fieldRow(work.base, chosen === "field", faces));
    const every = [...this.list.querySelectorAll(".layer")];
    every.forEach((each) => (each.tabIndex = -1));
    const main = this.list.querySelector('.layer[aria-pressed="true"]') ?? every[0];
    main.tabIndex = 0;
    if (!kept) return;
    const same = this.list.querySelector(`li[data-at="${kept.at}"]`);
    /** @type {any} */ (same?.querySelector(`[class="${kept.kind}"]`) ?? main).focus();
  }

  /** @param {import("./model.js").EditedLayer} layer @param {number} at @param {boolean} isChosen @param {import("./faces.js").Faces} faces */
  row(layer, at, isChosen, faces) {
    const { acts, say, titles } = this;
    const title = say("layerIn", { pattern: titles.pattern(layer.pattern), dye: titles.dye(layer.dye) });
    const [plain, heraldic] = titles.pattern(layer.pattern).split(" / ");
    const canvas = make("canvas", HIDDEN);
    const ground = { base: ["white", "light_gray"].includes(layer.dye) ? "gray" : "white", layers: [layer] };
    drawPixels(canvas, faces.face(ground));
    const button = make("button", {
      type: "button", class: "layer", "aria-pressed": String(isChosen), "aria-keyshortcuts": "Alt+ArrowUp Alt+ArrowDown Delete H D",
      onclick: () => acts.select(isChosen ? null : at),
      onkeydown: (/** @type {KeyboardEvent} */ event) => this.press(event, at),
    }, canvas, make("span", { class: "layer-name" }, make("b", {}, plain), make("small", {}, heraldic ? `${titles.dye(layer.dye)} · ${heraldic}` : titles.dye(layer.dye))));
    if (layer.hidden) button.append(make("span", { class: "unseen" }, `(${say("hide")})`));
    const grip = make("span", { class: "grip", title: say("move", { number: at + 1 }), onpointerdown: (/** @type {PointerEvent} */ event) => this.drag(event, at) }, icon("grip"));
    const hide = iconButton(layer.hidden ? "hidden" : "eye", `${say(layer.hidden ? "show" : "hide")}: ${title}`, () => acts.hide(at), { class: "icon hide", "aria-pressed": String(Boolean(layer.hidden)) });
    const double = iconButton("double", `${say("duplicate")}: ${title}`, () => acts.double(at), { class: "icon double" });
    const remove = iconButton("clear", `${say("delete")}: ${title}`, () => acts.remove(at), { class: "icon remove" });
    return make("li", { class: layer.hidden ? "is-hidden" : "is-shown", "data-at": at }, grip, button, hide, double, remove);
  }

  /** @param {string} base @param {boolean} isChosen @param {import("./faces.js").Faces} faces */
  fieldRow(base, isChosen, faces) {
    const canvas = make("canvas", HIDDEN);
    drawPixels(canvas, faces.face({ base, layers: [] }));
    const name = make("span", { class: "layer-name" }, make("b", {}, this.say("field")), make("small", {}, this.titles.dye(base)));
    const button = make("button", { type: "button", class: "layer", "aria-pressed": String(isChosen), onclick: () => this.acts.select(isChosen ? null : "field") }, canvas, name);
    return make("li", { class: "is-shown of-field", "data-at": "field" }, button);
  }

  /** @param {KeyboardEvent} event @param {number} at */
  press(event, at) {
    const { acts } = this;
    const last = this.list.children.length - 2;
    const key = event.altKey ? `Alt+${event.key}` : event.key;
    if (event.ctrlKey || event.metaKey) return;
    if (key === "Alt+ArrowUp" && at < last) this.moved(at, at + 1);
    else if (key === "Alt+ArrowDown" && at > 0) this.moved(at, at - 1);
    else if (key === "Delete" || key === "Backspace") acts.remove(at);
    else if (key === "h" || key === "H") acts.hide(at);
    else if (key === "d" || key === "D") acts.double(at);
    else if (!key.startsWith("Alt+Arrow")) return;
    event.preventDefault();
    event.stopPropagation();
  }

  /** Move a layer; the focus goes with it.
   * @param {number} from @param {number} to */
  moved(from, to) {
    this.acts.move(from, to);
    /** @type {any} */ (this.list.querySelector(`li[data-at="${to}"] .layer`))?.focus();
  }

  /** Drag a layer by its grip: the list shows where it will lie.
   * @param {PointerEvent} event @param {number} from */
  drag(event, from) {
    event.preventDefault();
    const grip = /** @type {HTMLElement} */ (event.currentTarget);
    const rows = /** @type {HTMLElement[]} */ ([...this.list.children].slice(0, -1)).reverse(); // by their layer
    const row = rows[from];
    const places = rows.map((each) => each.getBoundingClientRect());
    let to = from;
    grip.setPointerCapture(event.pointerId);
    row.classList.add("dragged");
    const follow = (/** @type {PointerEvent} */ moved) => {
      to = places.findIndex(({ top }) => moved.clientY >= top);
      if (to < 0) to = rows.length - 1;
      const high = places[from].height + 4;
      rows.forEach((each, at) => {
        const shift = at > from && at <= to ? high : at < from && at >= to ? -high : 0;
        each.style.translate = at === from ? `0 ${moved.clientY - event.clientY}px` : `0 ${shift}px`;
      });
    };
    const cancel = (/** @type {KeyboardEvent} */ press) => {
      if (press.key !== "Escape") return;
      to = from;
      grip.releasePointerCapture(event.pointerId);
    };
    const drop = () => {
      removeEventListener("keydown", cancel);
      grip.removeEventListener("pointermove", follow);
      rows.forEach((each) => (each.style.translate = ""));
      row.classList.remove("dragged");
      if (to !== from) this.acts.move(from, to);
    };
    addEventListener("keydown", cancel);
    grip.addEventListener("pointermove", follow);
    grip.addEventListener("lostpointercapture", drop, { once: true });
  }
}
