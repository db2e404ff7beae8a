// Designs and packs beside each other: two faces with a slider between them.

import { HIDDEN, drawPixels, make } from "../web/designer/dom.js";
import { Faces } from "../web/designer/faces.js";
import { shownOf } from "../web/designer/model.js";

export const KINDS = ["banner", "shield"];
const [COLUMNS, GAP] = [9, 2]; // of a sheet of patterns; between them [texels]

export const readFaces = async (address) => Faces.read(await (await fetch(address)).arrayBuffer());

class Slider {
  constructor(say) {
    this.say = say;
    this.faces = [0, 1].map(() => make("canvas", HIDDEN));
    this.field = make("input", { type: "range", class: "slider", "aria-label": say("design"), oninput: () => this.whole.style.setProperty("--cut", `${this.field.value}%`) });
    this.whole = make("div", { class: "versus-slider" }, make("div", { class: "versus-faces" }, ...this.faces), this.field);
  }

  // title: names the right one of two faces; the left one is the design now.
  show(title, faces) {
    this.field.ariaLabel = this.say("versus", { title });
    faces.forEach((each, at) => drawPixels(this.faces[at], each));
  }
}

// The design and one that is kept or was shown before.
export class Comparison {
  constructor(designer) {
    const { say } = designer.editor;
    Object.assign(this, { designer, other: null, slider: new Slider(say) });
    const keep = make("button", { type: "button", onclick: () => this.choose(designer.editor.work) }, say("keep"));
    this.choice = make("select", { class: "field", onchange: () => this.choose(this.listed[this.choice.value]) });
    const field = make("label", { class: "option" }, make("span", {}, say("compareWith")), this.choice);
    const whole = make("div", { class: "stack" }, make("p", { class: "hint" }, say("compareHint")), keep, field, this.slider.whole);
    this.nodes = [make("h2", {}, say("compare")), whole];
  }

  choose(other = null) {
    this.other = other;
    this.show();
  }

  show() {
    const { other, choice, slider, designer: { states, editor: { every, say, work }, titleOf } } = this;
    const title = (each) => (states.includes(each) ? `${states.indexOf(each) + 1}: ` : "") + titleOf(each);
    this.listed = other && !states.includes(other) ? [other, ...states] : states;
    const choices = this.listed.map((each, at) => make("option", { value: at, selected: each === other }, title(each)));
    choice.replaceChildren(make("option", { value: "" }, say("nothing")), ...choices);
    const pair = other ? [work, other] : [];
    slider.whole.hidden = !pair.length || !pair.every(({ kind }) => every[kind]);
    if (!slider.whole.hidden) slider.show(titleOf(other), pair.map((each) => every[each.kind].face(shownOf(each))));
  }
}

// The design and all patterns, of the page's packs and of others.
export class PackComparison {
  constructor(designer) {
    const { say } = designer.editor;
    Object.assign(this, { designer, slider: new Slider(say) });
    const canvas = (name) => make("canvas", { class: `versus-${name}`, role: "img" });
    this.sides = [0, 1].map(() => ({ caption: make("figcaption"), design: canvas("design"), patterns: canvas("patterns") }));
    const sides = this.sides.map((each) => make("figure", { class: "versus-side" }, ...Object.values(each)));
    this.whole = make("div", { hidden: true }, this.slider.whole, make("div", { class: "versus" }, ...sides));
  }

  // packs: their title and the addresses of their faces; null for none.
  async open(packs) {
    this.packs = packs;
    document.querySelector('[data-part="beside"]').replaceChildren(this.whole); // the panel comes after the editor
    const every = await Promise.all(KINDS.map((kind) => packs && readFaces(packs.faces[kind]))).catch(() => [null]);
    if (this.packs === packs) this.every = every;
    this.show();
  }

  show() {
    const { packs, every = [], designer: { editor: { every: own, say, work } } } = this;
    const pair = [own[work.kind], every[KINDS.indexOf(work.kind)]];
    this.whole.hidden = !pair.every(Boolean);
    if (this.whole.hidden) return;
    const dye = work.layers.at(-1)?.dye ?? "black";
    const base = [work.base, "white", "black"].find((each) => each !== dye);
    const faces = pair.map((each) => each.face(shownOf(work)));
    this.slider.show(packs.title, faces);
    this.sides.forEach(({ caption, design, patterns }, at) => {
      caption.textContent = at ? packs.title : say("yourPacks");
      design.ariaLabel = `${say("design")}: ${caption.textContent}`;
      patterns.ariaLabel = `${say("patterns")}: ${caption.textContent}`;
      drawPixels(design, faces[at]);
      drawPatterns(patterns, pair[at].small, base, dye);
    });
  }
}

function drawPatterns(canvas, faces, base, dye) {
  const { patterns, front } = faces;
  const [wide, high] = [front.width + GAP, front.height + GAP];
  const sheet = faces.previews({ base, layers: [] }, 0, dye, patterns);
  Object.assign(canvas, { width: COLUMNS * wide, height: Math.ceil(patterns.length / COLUMNS) * high });
  const context = canvas.getContext("2d");
  patterns.forEach((_, at) => {
    const from = at * front.width;
    context.putImageData(sheet, (at % COLUMNS) * wide - from, Math.floor(at / COLUMNS) * high, from, 0, front.width, front.height);
  });
}
