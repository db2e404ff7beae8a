// The dyes, the patterns, and numbers with a slider.

import { TABLES } from "../component/tables.js";
import { HIDDEN, make, roving } from "./dom.js";
import { foundPatterns } from "./search.js";

/** A group of sixteen dyes. choose: called with a dye's name.
 * @param {(dye: string) => void} choose @param {{ label: string, titleOf: (dye: string) => string }} words */
export function dyeButtons(choose, { label, titleOf }) {
  const buttons = TABLES.dyes.map((/** @type {string} */ dye) => {
    const title = titleOf(dye);
    const style = `--dye: rgb(${TABLES.rgb[dye].join(" ")})`;
    const button = make("button", { type: "button", class: "dye", "data-dye": dye, "aria-label": title, title, tabIndex: -1, onclick: () => choose(dye) });
    button.style.cssText = style;
    return button;
  });
  buttons[0].tabIndex = 0;
  const group = make("div", { class: "dye-grid", role: "group", "aria-label": label }, ...buttons);
  roving(group, () => buttons);
  return { group, show: (/** @type {string} */ dye) => buttons.forEach((/** @type {any} */ each) => each.setAttribute("aria-pressed", String(each.dataset.dye === dye))) };
}

// All patterns, previewed over the design, and a field to find one.
export class PatternGrid {
  /** @param {{ name: string, title: string, caption: string, words: string }[]} patterns
   * @param {(pattern: string) => void} choose @param {Record<string, string>} words */
  constructor(patterns, choose, words) {
    this.patterns = patterns;
    this.cells = patterns.map((pattern) => {
      const canvas = make("canvas", HIDDEN);
      const label = { "aria-label": pattern.title, title: pattern.title, "data-pattern": pattern.name };
      const caption = make("span", { class: "caption", "aria-hidden": "true" }, pattern.caption);
      const button = make("button", { type: "button", class: "pattern", ...label, tabIndex: -1, onclick: () => choose(pattern.name) }, canvas, caption);
      return { button, canvas, context: canvas.getContext("2d", { willReadFrequently: true }) };
    });
    this.grid = make("div", { class: "pattern-grid", role: "group", "aria-label": words.label }, ...this.cells.map(({ button }) => button));
    this.nothing = make("p", { class: "hint", hidden: true }, words.nothing);
    this.count = make("p", { class: "unseen", role: "status" });
    const first = () => this.shownButtons()[0]?.click();
    this.field = make("input", {
      type: "search", class: "find", placeholder: words.find, "aria-label": words.find,
      oninput: () => this.search(),
      onkeydown: (/** @type {KeyboardEvent} */ event) => {
        if (event.key === "Enter") first();
        else if (event.key === "Escape" && !this.field.value) this.field.blur(); // the browser empties one with words
      },
    });
    this.cells[0].button.tabIndex = 0;
    roving(this.grid, () => this.shownButtons());
  }

  shownButtons() {
    return /** @type {HTMLElement[]} */ ([...this.grid.children].filter((each) => !each.hidden));
  }

  // Show the patterns that fit the words of the field, the best first.
  search() {
    const found = foundPatterns(this.field.value, this.patterns);
    const byName = new Map(this.cells.map(({ button }) => [button.dataset.pattern, button]));
    const others = this.patterns.filter(({ name }) => !found.includes(name)).map(({ name }) => name);
    others.forEach((name) => (byName.get(name).hidden = true));
    found.forEach((name) => (byName.get(name).hidden = false));
    this.grid.append(...[...found, ...others].map((name) => byName.get(name)));
    this.cells.forEach(({ button }) => (button.tabIndex = button.dataset.pattern === found[0] ? 0 : -1));
    this.nothing.hidden = found.length > 0;
    this.count.textContent = this.field.value ? String(found.length) : "";
  }

  /** Draw a picture with all patterns beside each other.
   * @param {ImageData} sheet @param {string} [chosen] the pattern of the layer that is edited */
  show(sheet, chosen) {
    const size = { width: sheet.width / this.cells.length, height: sheet.height };
    this.cells.forEach(({ button, canvas, context }, at) => {
      if (canvas.height !== size.height) Object.assign(canvas, size);
      context.putImageData(sheet, -at * size.width, 0, at * size.width, 0, size.width, size.height);
      button.setAttribute("aria-pressed", String(button.dataset.pattern === chosen));
    });
  }
}

let numbers = 0; // of fields that have been made, for ids

/** A slider with a field to type a number in; a comma is a point. A number out of bounds is an error at
 * the field, and changes nothing.
 * @param {{ name: string, unit: string, bounds: number[], step?: number, error: string, change: (value: number) => void }} words */
export function numberField({ name, unit, bounds: [least, most], step = 0.5, error, change }) {
  const id = `number${++numbers}`;
  const fault = make("p", { class: "fault", id: `${id}-fault`, role: "alert", hidden: true });
  const slider = make("input", { type: "range", min: String(least), max: String(most), step: String(step), "aria-label": name });
  const field = make("input", { type: "text", inputMode: "decimal", class: "number", id, "aria-describedby": `${id}-unit ${id}-fault`, autocomplete: "off" });
  const tell = (/** @type {boolean} */ isWrong) => {
    fault.hidden = !isWrong;
    fault.textContent = isWrong ? error : "";
    field.setAttribute("aria-invalid", String(isWrong));
  };
  slider.addEventListener("input", () => {
    tell(false);
    field.value = slider.value;
    change(Number(slider.value));
  });
  field.addEventListener("input", () => {
    const text = field.value.trim().replace(",", ".");
    const value = Number(text);
    const isWrong = !/\d/.test(text) || !(value >= least && value <= most);
    tell(isWrong);
    if (isWrong) return;
    slider.value = String(value);
    change(value);
  });
  const whole = make("div", { class: "number-field" },
    make("label", { htmlFor: id }, name), slider, field, make("span", { class: "unit", id: `${id}-unit` }, unit), fault);
  const show = (/** @type {number} */ value) => {
    slider.value = String(value);
    if (Number(field.value.trim().replace(",", ".")) === value && field.value.trim()) return; // "4," stays as it is typed
    field.value = String(value);
    tell(false);
  };
  return { whole, show };
}

/** A menu with its name.
 * @param {string} name @param {Record<string, string>} titles by value @param {(value: string) => void} choose */
export function menu(name, titles, choose) {
  const field = make("select", { onchange: () => choose(field.value) }, ...Object.entries(titles).map(([value, title]) => make("option", { value }, title)));
  return { whole: make("label", { class: "menu" }, make("span", {}, name), field), show: (/** @type {string} */ value) => (field.value = value) };
}

/** Buttons of which one is pressed.
 * @param {string} label @param {Record<string, string>} titles by value @param {(value: string) => void} choose */
export function segments(label, titles, choose) {
  const buttons = Object.entries(titles).map(([value, title]) => make("button", { type: "button", "data-value": value, onclick: () => choose(value) }, title));
  const group = make("div", { class: "segments", role: "group", "aria-label": label }, ...buttons);
  return { whole: group, show: (/** @type {string} */ value) => buttons.forEach((each) => each.setAttribute("aria-pressed", String(each.dataset.value === value))) };
}
