// A scene before the user's camera, and what a pointer meets.

import { clipMatrix, sightRay } from "./matrices.js";
import { azimuth, Orbit } from "./orbit.js";
import { meetsCloth } from "./picking.js";

export class View {
  // canvas: what the pointer moves over. `drawing` and `base`, the camera before the user's moves, come later.
  constructor(canvas) {
    this.canvas = canvas;
    this.orbit = new Orbit();
    this.base = null;
    this.drawing = null;
  }

  // Draw into a rectangle of this size [pixels], whose lower left corner is at [x, y].
  drawInto(width, height, [x, y] = [0, 0]) {
    const aspect = width / height;
    this.drawing.draw([x, y, width, height], clipMatrix(this.camera(aspect), aspect), this.tint);
  }

  // The camera, changed by the user's moves. aspect: width / height of the picture.
  camera(aspect) {
    return this.orbit.camera(this.baseCamera(aspect));
  }

  baseCamera() {
    return this.base;
  }

  // The line of sight through a point of the canvas [CSS pixels], or beside it.
  rayAt(x, y) {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    return sightRay(this.camera(width / height), width / height, (2 * x) / width - 1, 1 - (2 * y) / height);
  }

  // Whether the nearest surface at a point is cloth that can be grabbed.
  hitsCloth(x, y) {
    return this.drawing.scene.header.grip.length > 0 && meetsCloth(this.drawing.scene, this.rayAt(x, y));
  }

  azimuth() {
    return azimuth(this.camera(1));
  }
}
