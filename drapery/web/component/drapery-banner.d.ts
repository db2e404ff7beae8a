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
 * Attributes: `design`; `kind` ("standing", "wall" or "shield"); `fabric`, such as "silk"; `view`, such
 * as "iso"; `daylight`, 1 at noon and 0 at night; `wind` [m/s]; `direction`, to which the wind
 * blows [degrees]; `seed` of the gusts, a whole number; `phase`, how far ahead they are [s]; `paused`;
 * `alt`. Events: `drapery-ready`, also after each change that is shown; `drapery-error`, whose `detail`
 * is the line of the console; `drapery-pause`, whose `detail` is `paused`.
 */
export class DraperyBanner extends HTMLElement {
  /** Whether its cloth is still; until it is set, as the attribute and the system's reduced motion say. */
  paused: boolean;
  /** The attributes as properties; null where there is none, and removes one. */
  design: string | null;
  kind: string | null;
  fabric: string | null;
  view: string | null;
  daylight: string | number | null;
  wind: string | number | null;
  direction: string | number | null;
  seed: string | number | null;
  phase: string | number | null;
  alt: string | null;
  /** A PNG of what is seen now. */
  snapshot(): Promise<Blob>;
  /** A film of the moving cloth, WebM or MP4 by the browser; 4 seconds unless given, at most an hour. */
  record(seconds?: number): Promise<Blob>;
  /** Textures in place of those of the scene, by the name of a pattern, and by "" the one below all patterns. */
  pack: Partial<Record<"banner" | "shield", Record<string, ImageData>>> | null;
  /** The pixels that `drapery render` draws of the design with the options of the package; a page of
   * one file has none. */
  picture(): Promise<ImageData>;
}

/**
 * `<drapery-player>`: a player with cloth on its back.
 *
 * Attributes: `skin` and `cape`, addresses of PNG files; `pose` ("walk", "stand", "run" or
 * "sneak"); `kind` ("cape" or "elytra"); and `view`, `daylight`, the attributes of wind, `paused` and `alt`
 * as above.
 */
export class DraperyPlayer extends DraperyBanner {
  skin: string | null;
  cape: string | null;
  pose: string | null;
}

/** `<drapery-cape skin="skin.png" cape="cape.png" pose="run">`: a player with a cape. */
export class DraperyCape extends DraperyPlayer {}

/** `<drapery-elytra>`: a player with wings of cloth. */
export class DraperyElytra extends DraperyPlayer {}

declare global {
  interface HTMLElementTagNameMap {
    "drapery-banner": DraperyBanner;
    "drapery-player": DraperyPlayer;
    "drapery-cape": DraperyCape;
    "drapery-elytra": DraperyElytra;
  }
}
