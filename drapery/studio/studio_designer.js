// The design of the page: the designer's editor in the studio's places. An edit is made and drawn here, and the
// server is told of it.

import { readDesign } from "../web/component/design.js";
import { HIDDEN, drawPixels, iconButton, make } from "../web/designer/dom.js";
import { Editor } from "../web/designer/editor.js";
import { History, shownOf, workOf, writeShorthand } from "../web/designer/model.js";
import { kept } from "../web/designer/storage.js";
import { TITLES } from "../web/designer/tables.js";
import { Comparison, KINDS, PackComparison, readFaces } from "./comparisons.js";

const KEPT = "drapery-history"; // the key of the history in the browser's storage
const SHOWN_STEPS = 12; // the most on the strip: those around the present one
const MAX_TITLE = 80;
const MAX_ORIGIN = 2 ** 48;
const OTHER_KIND = { banner: "shield", shield: "banner" };

// What the server knows of a design.
const designOf = ({ base, kind, layers, title, origin }) => ({ base, kind, layers, title, origin });

export class StudioDesigner {
  // given: design, as `sketch.editor_tree` has it; motion: the options of the picture, as links have them;
  // language and words, as an Editor has them; token of the session. faces: the addresses of the files of faces by
  // their kind. tell: takes each design for the server, and the options that an undone step had.
  constructor({ design, motion, language, words, token }, faces, tell) {
    Object.assign(this, { token, tell, buttons: new Map(), heard: JSON.stringify(motion) });
    this.editor = new Editor(this.opened(workOf(design, {}, motion)), {
      openFaces: (kind) => readFaces(this.faces[kind]),
      begin: (work) => ({ title: "", origin: Math.floor(Math.random() * MAX_ORIGIN), ...work }),
      show: () => this.show(),
      announce: () => this.announce(),
    });
    Object.assign(this.editor, { language, words, chosen: design.layers.length ? null : "field" });
    Object.assign(this, { comparison: new Comparison(this), packComparison: new PackComparison(this) });
    document.querySelector(".studio").addEventListener("act", (event) => this.act(event.detail));
    new MutationObserver(() => this.drawButtons(":not([width])")).observe(document.querySelector(".studio"), { childList: true, subtree: true });
    // A file that was sent is known to the server again once it has heard of the earlier session.
    const isSent = Object.values(this.editor.work.motion.shown ?? {}).some((each) => /[\\/]/.test(each));
    Promise.all([this.redraw(faces), isSent && window.studio.whole()]).then(() => this.announce());
  }

  // The history of a work. It goes on from the page that was loaded before at this place of the browser's
  // history; a work that is not in it, of an address, becomes its last step. No address says what is shown in
  // place of the banner.
  opened(work) {
    const { token, history } = kept(() => JSON.parse(sessionStorage.getItem(KEPT))) ?? {};
    const before = token === window.studio.earlier && History.read(history, () => true); // the server knows options
    if (!before) return new History(work);
    const plain = (each) => JSON.stringify({ ...designOf(each), layers: workOf(each).layers, origin: 0, motion: { ...each.motion, shown: null } });
    if (![before.work, ...before.past, ...before.future].map(plain).includes(plain(work))) before.change(work);
    return before;
  }

  // Draw with the faces of packs.
  async redraw(faces) {
    const { editor } = this;
    this.faces = faces;
    await Promise.all(KINDS.map((kind) => editor.open(kind)));
    this.buttons.clear();
    const names = String(editor.faces?.patterns);
    if (names !== this.names || !editor.controls) this.build();
    this.names = names;
    editor.show();
    this.drawButtons();
  }

  // Draw the designs of buttons, which the server adds, and name these.
  drawButtons(which = "") {
    for (const canvas of document.querySelectorAll(`[data-face]${which}`)) {
      const design = readDesign(canvas.dataset.face);
      const faces = this.editor.every[design.kind];
      if (faces) drawPixels(canvas, faces.small.face(design));
      canvas.parentElement.title = [canvas.dataset.label, this.described(design)].filter(Boolean).join(": ");
      canvas.parentElement.ariaLabel = canvas.parentElement.title;
    }
  }

  build() {
    const { editor } = this;
    editor.build();
    const { parts, say } = editor;
    this.title = make("input", {
      type: "text", class: "title", placeholder: say("untitled"), "aria-label": say("titleOf"), maxLength: MAX_TITLE,
      onchange: () => editor.change({ ...editor.work, title: this.title.value.trim() }),
      onblur: () => this.show(),
    });
    this.other = make("canvas", HIDDEN);
    this.missing = make("p", { class: "warning", role: "status", hidden: true });
    this.news = make("p", { class: "unseen", role: "status" });
    this.strip = make("div", { class: "steps-strip", role: "group", "aria-label": say("history") });
    const fresh = iconButton("plus", say("new"), () => this.act("new"));
    const placed = {
      tools: [parts.undo, parts.redo, fresh, parts.random, parts.clear, parts.kind],
      dyes: parts.dyes, layers: [this.missing, this.title, ...parts.layers, parts.status], patterns: parts.patterns ?? [],
      loom: [make("h2", {}, say("loom")), parts.loom], face: [parts.flat, this.news], other: [this.other], steps: [this.strip],
      compare: this.comparison.nodes,
    };
    for (const [name, nodes] of Object.entries(placed)) document.querySelector(`[data-part="${name}"]`)?.replaceChildren(...nodes);
  }

  // Take what an address, a library or a text holds, or null, and the options of the picture; both can be undone.
  // isAnswer: whether the options follow from the present step.
  lay(design, motion, isAnswer) {
    const { history, work } = this.editor;
    this.heard = JSON.stringify(motion);
    const names = Object.keys({ ...work.motion, ...motion }).filter((name) => JSON.stringify(work.motion[name]) !== JSON.stringify(motion[name]));
    const isSlid = names.every((name) => typeof (motion[name] ?? work.motion[name]) === "number");
    if (isAnswer) history.work = { ...work, motion };
    else if (design) this.editor.begin(workOf(design, {}, motion));
    else this.editor.change({ ...work, motion }, isSlid ? `motion ${names}` : "");
    if (isAnswer || this.editor.work === work) this.announce(); // the server may have heard of another one since
  }

  announce() {
    const { work, history } = this.editor;
    kept(() => sessionStorage.setItem(KEPT, JSON.stringify({ token: this.token, history: history.write() })));
    document.dispatchEvent(new CustomEvent("drapery-change", { detail: { text: writeShorthand(shownOf(work)) } }));
    const motion = JSON.stringify(work.motion);
    this.tell({ ...designOf(work), motion: motion === this.heard ? null : work.motion });
    this.heard = motion;
  }

  // Do what a key or a button of the page stands for.
  act(what) {
    const { editor } = this;
    const { work, chosen, acts } = editor;
    const doing = {
      undo: () => editor.go("undo"),
      redo: () => editor.go("redo"),
      new: () => editor.begin(workOf({ base: "white", kind: work.kind, layers: [] }, {}, work.motion), "field"),
      random: () => editor.random(),
      kind: () => editor.setKind(OTHER_KIND[work.kind]),
      none: () => acts.select(null),
    };
    const ofLayer = {
      up: () => work.layers[chosen + 1] && acts.move(chosen, chosen + 1),
      down: () => chosen > 0 && acts.move(chosen, chosen - 1),
      hide: () => acts.hide(chosen),
      duplicate: () => acts.double(chosen),
      remove: () => acts.remove(chosen),
    };
    (doing[what] ?? (typeof chosen === "number" ? ofLayer[what] : null))?.();
  }

  show() {
    const { work, every, faces, say } = this.editor;
    if (document.activeElement !== this.title) this.title.value = work.title;
    const other = every[OTHER_KIND[work.kind]];
    if (other) drawPixels(this.other, other.face(shownOf(work)));
    document.title = `${this.titleOf(work)} - Drapery Studio`;
    this.news.textContent = this.described(work);
    const added = new Set(work.layers.map(({ pattern }) => pattern).filter((name) => !Object.hasOwn(TITLES, name)));
    this.missing.textContent = faces ? [...added].filter((name) => !faces.patterns.includes(name)).map((name) => say("missing", { name })).join(" ") : "";
    this.missing.hidden = !this.missing.textContent;
    this.showSteps();
    this.comparison.show();
    this.packComparison.show();
  }

  // All designs of the history, each once.
  get states() {
    const { past, work, future } = this.editor.history;
    const all = [...past, work, ...future.toReversed()];
    const texts = all.map((each) => JSON.stringify(designOf(each)));
    return all.filter((_, at) => texts[at] !== texts[at - 1]); // another wind is no other picture
  }

  // The states around the present one; a button that is still shown stays, because a click on one that is
  // replaced is lost.
  showSteps() {
    const { states, editor: { history: { past, work } } } = this;
    const before = [...past, work];
    const present = states.findLastIndex((each) => before.includes(each));
    const first = Math.max(0, Math.min(present - SHOWN_STEPS / 2, states.length - SHOWN_STEPS));
    const shown = states.length > 1 ? states.slice(first, first + SHOWN_STEPS) : [];
    this.buttons = new Map(shown.map((state) => [state, this.buttons.get(state) ?? this.step(state)]));
    const focused = document.activeElement;
    const buttons = [...this.buttons.values()];
    if (buttons.some((each, at) => this.strip.children[at] !== each) || buttons.length !== this.strip.children.length) this.strip.replaceChildren(...buttons);
    if (this.strip.contains(focused)) focused.focus();
    buttons.forEach((each, at) => {
      each.ariaCurrent = first + at === present ? "step" : "false";
      each.ariaLabel = each.title = this.editor.say("step", { number: first + at + 1, design: this.described(shown[at]) });
    });
  }

  step(state) {
    const canvas = make("canvas", HIDDEN);
    const faces = this.editor.every[state.kind];
    if (faces) drawPixels(canvas, faces.small.face(shownOf(state)));
    return make("button", { type: "button", class: "step", onclick: () => this.goTo(state) }, canvas);
  }

  described(work) {
    const { dyeTitle, caption, say } = this.editor;
    const layers = shownOf(work).layers.map(({ pattern, dye }) => say("layerIn", { pattern: caption(pattern), dye: dyeTitle(dye) }));
    return `${say(work.kind)}: ${[dyeTitle(work.base), ...layers].join("; ")}`;
  }

  titleOf = (work) => work.title || this.described(work);

  goTo(state) {
    const { editor } = this;
    const { history } = editor;
    const way = history.past.includes(state) ? "undo" : "redo";
    while (history.work !== state && history[way]());
    editor.chosen = null;
    editor.show();
    this.announce();
  }
}
