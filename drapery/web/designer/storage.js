// What a browser may refuse.

/** What the browser keeps; null where it keeps nothing.
 * @template T @param {() => T} use @returns {T | null} */
export function kept(use) {
  try {
    return use();
  } catch {
    return null;
  }
}
