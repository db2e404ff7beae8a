// Small helpers to make elements and to keep one of several in the order of the tab key.

/** An element. Names of properties that begin with `on` are events; `class`, `role`, `aria-…` and
 * `data-…` are attributes, others properties.
 * @param {string} tag @param {Record<string, any>} [words] @param {(Node | string | null | undefined)[]} inside @returns {any} */
export function make(tag, words = {}, ...inside) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(words)) {
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else if (/^(class|role|for|list|part)$|^(aria|data)-/.test(name)) element.setAttribute(name, String(value));
    else Object.assign(element, { [name]: value });
  }
  element.append(...inside.filter((each) => each !== null && each !== undefined));
  return element;
}

/** What a picture has that the name of its button tells. */
export const HIDDEN = { "aria-hidden": "true" };

const SHAPES = {
  undo: "M9 14 4 9l5-5M4 9h10a6 6 0 0 1 0 12h-3",
  redo: "m15 14 5-5-5-5M20 9H10a6 6 0 0 0 0 12h3",
  dice: "M4 4h16v16H4zM8.5 8.5h.01M15.5 8.5h.01M12 12h.01M8.5 15.5h.01M15.5 15.5h.01",
  plus: "M12 5v14M5 12h14",
  clear: "M4 7h16M9 7V4h6v3M6 7l1 13h10l1-13M10 11v5M14 11v5",
  eye: "M2 12s4-7 10-7 10 7 10 7-4 7-10 7S2 12 2 12zM12 9a3 3 0 1 0 0 6 3 3 0 0 0 0-6",
  hidden: "M3 3l18 18M10.6 5.1A10 10 0 0 1 12 5c6 0 10 7 10 7a17 17 0 0 1-3 3.6M6.5 6.6A16 16 0 0 0 2 12s4 7 10 7a10 10 0 0 0 4.5-1.1",
  double: "M8 8h12v12H8zM4 16V4h12",
  grip: "M9 6h.01M15 6h.01M9 12h.01M15 12h.01M9 18h.01M15 18h.01",
  play: "M7 4v16l13-8z",
  pause: "M8 5v14M16 5v14",
};

/** A picture of lines, hidden from screen readers.
 * @param {keyof typeof SHAPES} name */
export function icon(name) {
  const space = "http://www.w3.org/2000/svg";
  const picture = document.createElementNS(space, "svg");
  const path = document.createElementNS(space, "path");
  picture.setAttribute("viewBox", "0 0 24 24");
  picture.setAttribute("aria-hidden", "true");
  path.setAttribute("d", SHAPES[name]);
  picture.append(path);
  return picture;
}

/** A button with a picture and a name.
 * @param {keyof typeof SHAPES} name @param {string} label @param {(event: Event) => void} act @param {Record<string, any>} [words] */
export function iconButton(name, label, act, words = {}) {
  return make("button", { type: "button", class: "icon", "aria-label": label, title: label, onclick: act, ...words }, icon(name));
}

/** Let arrows, Home and End move the focus among elements, of which one is in the order of the tab key.
 * @param {HTMLElement} holder @param {() => HTMLElement[]} items @param {boolean} [isList] of one column */
export function roving(holder, items, isList = false) {
  const choose = (/** @type {HTMLElement | undefined} */ chosen) => {
    if (!chosen) return;
    items().forEach((each) => (each.tabIndex = each === chosen ? 0 : -1));
    chosen.focus();
  };
  holder.addEventListener("focusin", (event) => {
    const all = items();
    if (all.includes(/** @type {any} */ (event.target))) all.forEach((each) => (each.tabIndex = each === event.target ? 0 : -1));
  });
  holder.addEventListener("keydown", (event) => {
    if (event.altKey || event.ctrlKey || event.metaKey) return;
    const all = items();
    const at = all.indexOf(/** @type {any} */ (event.target));
    if (at < 0) return;
    const top = all[at].getBoundingClientRect().top;
    const row = isList ? 1 : all.filter((each) => Math.abs(each.getBoundingClientRect().top - all[0].getBoundingClientRect().top) < 4).length;
    /** @type {Record<string, number>} */
    const steps = { ArrowLeft: -1, ArrowRight: 1, ArrowUp: -row, ArrowDown: row, Home: -at, End: all.length - 1 - at };
    if (!Object.hasOwn(steps, event.key) || Number.isNaN(top)) return;
    event.preventDefault();
    choose(all[at + steps[event.key]]);
  });
}

/** Draw a picture into a canvas, which gets its size.
 * @param {HTMLCanvasElement} canvas @param {ImageData} picture */
export function drawPixels(canvas, picture) {
  Object.assign(canvas, { width: picture.width, height: picture.height });
  canvas.getContext("2d")?.putImageData(picture, 0, 0);
}
