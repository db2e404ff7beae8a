// A scene before the user's camera: where its panes lie on a canvas, and what a pointer meets.

import { clipMatrix, sightRay } from "./matrices.js";
import { azimuth, Orbit } from "./orbit.js";
import { meetsCloth } from "./picking.js";

export class View {
  // canvas: what the pointer moves over. `drawing` and `cameras`, one for each pane, come later.
  constructor(canvas) {
    this.canvas = canvas;
    this.orbit = new Orbit();
    this.cameras = [];
    this.drawing = null;
  }

  // Whether the scene and its cameras are there.
  get complete() {
    const panes = this.drawing?.scene?.header.panes;
    return panes !== undefined && this.cameras.length === panes.length;
  }

  // Draw each pane into its part of a rectangle of this size [pixels], whose lower left corner is at
  // [x, y].
  drawPanes(width, height, [x, y] = [0, 0]) {
    const rects = this.rects(width, height);
    const matrices = rects.map(([, , w, h], number) => clipMatrix(this.camera(number, w / h), w / h));
    this.drawing.draw(rects.map(([left, low, w, h]) => [x + left, y + low, w, h]), matrices);
  }

  // The camera of a pane, changed by the user's moves. aspect: width / height of the pane.
  camera(number, aspect) {
    const base = this.baseCamera(number, aspect);
    return this.drawing.scene.header.panes[number].flat ? base : this.orbit.camera(base);
  }

  baseCamera(number) {
    return this.cameras[number];
  }

  // Each pane's rectangle in a canvas of this size, from the lower left.
  rects(width, height) {
    const { panes, columns } = this.drawing.scene.header;
    const rows = Math.ceil(panes.length / columns);
    const [wide, high] = [Math.floor(width / columns), Math.floor(height / rows)];
    return panes.map((pane, number) => {
      const row = Math.floor(number / columns);
      return [(number % columns) * wide, height - (row + 1) * high, wide, high];
    });
  }

  // The pane at a point of the canvas [CSS pixels], and the line of sight through that point.
  // within: a pane to use wherever the point is, since a drag may leave its pane and the canvas.
  rayAt(x, y, within) {
    if (!this.complete) return null;
    const { clientWidth, clientHeight } = this.canvas;
    const up = clientHeight - y;
    const rects = this.rects(clientWidth, clientHeight);
    const number = rects.findIndex(([l, b, w, h]) => x >= l && x < l + w && up >= b && up < b + h);
    const pane = within ?? number;
    if (pane < 0) return null;
    const [left, bottom, width, height] = rects[pane];
    const [cx, cy] = [(2 * (x - left)) / width - 1, (2 * (up - bottom)) / height - 1];
    return { pane, ray: sightRay(this.camera(pane, width / height), width / height, cx, cy) };
  }

  // Whether the nearest surface at a point is cloth that can be grabbed.
  hitsCloth(x, y) {
    const found = this.rayAt(x, y);
    if (!found || !this.drawing.scene.header.grip.length) return false;
    this.pane = found.pane;
    return meetsCloth(this.drawing.scene, found.pane, found.ray);
  }

  azimuth() {
    return this.cameras.length ? azimuth(this.camera(0, 1)) : 0;
  }
}
