// What registers elements, and where the files of a package are.

// Without a DOM, as on a server that renders pages, an import defines nothing.
export const Element = globalThis.HTMLElement ?? Object;

/** The files of a package by name: a text holds one in base64. A bundle lists them here.
 * @type {Record<string, string | (() => URL)>} */
export const PLACES = {};

/** A second copy of a module does nothing.
 * @param {string} name @param {CustomElementConstructor} element */
export function define(name, element) {
  const known = globalThis.customElements;
  if (known && !known.get(name)) known.define(name, element);
}
