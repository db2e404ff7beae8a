/** One layer of a design: the id of its pattern, and the name of its dye. */
export interface Layer {
  pattern: string;
  dye: string;
}

/** A banner or shield; its lowest layer comes first. */
export interface Design {
  base: string;
  layers: Layer[];
  kind: "banner" | "shield";
}

export class DesignError extends Error {}

/** Read a design: shorthand, a /give command, an item, JSON, or a link of an editor. */
export function readDesign(text: string): Design;

/**
 * `<drapery-banner design="white creeper:lime" wind="4">`.
 *
 * Attributes: `design`; `kind` ("standing" or "wall"); `wind` [m/s]; `direction`, to which the wind
 * blows [degrees]; `paused`; `alt`. Events: `drapery-ready`; `drapery-error`, whose `detail` is the
 * line of the console.
 */
export class DraperyBanner extends HTMLElement {
  /** Whether its cloth is still. */
  paused: boolean;
  /** A PNG of what is seen now. */
  snapshot(): Promise<Blob>;
}

declare global {
  interface HTMLElementTagNameMap {
    "drapery-banner": DraperyBanner;
  }
}
