import type { Design } from "./drapery-banner.js";

export * from "./drapery-banner.js";

/** The versions of commands; `bedrock` is the data of a block. */
export type Version = "1.21.5" | "1.20.5" | "1.13" | "1.8" | "bedrock";

/** A design in all forms. */
export interface DesignForms extends Design {
  /** As shorthand: `white creeper:lime`. */
  text: string;
  /** What stands after `#` in its link. */
  hash: string;
  /** The text for each version; null where the version cannot hold the design. */
  commands: Record<Version, string | null>;
  name: string;
  lore: string[];
  count: number;
}

/**
 * `<drapery-designer design="white creeper:lime" wind="4" linked>`: an editor of banners.
 *
 * Attributes: `design`, any text that is read; `wind` [m/s]; `linked`, the address of the page holds
 * the design after `#`. Events: `drapery-designer-ready`; `drapery-change`, whose `detail` is the
 * design in all forms; `drapery-error`, whose `detail` is a line that says why.
 */
export class DraperyDesigner extends HTMLElement {
  /** The design as shorthand; any form that is read can be set. Throws DesignError. */
  design: string;
  getDesign(): DesignForms;
  /** Returns the names of what the text says that is not kept. Throws DesignError. */
  setDesign(design: string | Design): string[];
}

declare global {
  interface HTMLElementTagNameMap {
    "drapery-designer": DraperyDesigner;
  }
  interface HTMLElementEventMap {
    "drapery-change": CustomEvent<DesignForms>;
  }
}
