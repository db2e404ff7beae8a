// The user's turns, zoom and shifts, applied to the server's camera.

import { add, axes, cross, dot, length, scale, subtract, unit } from "./matrices.js";

const STEEPEST = (88 * Math.PI) / 180;
const UPRIGHT = [0, 1, 0];
const TURN = 0.0075; // radians a pixel
const STEP = Math.PI / 24;
const KEYS = {
  ArrowLeft: (orbit) => orbit.turn(-STEP, 0),
  ArrowRight: (orbit) => orbit.turn(STEP, 0),
  ArrowUp: (orbit) => orbit.turn(0, STEP),
  ArrowDown: (orbit) => orbit.turn(0, -STEP),
  "+": (orbit) => orbit.dolly(0.9),
  "=": (orbit) => orbit.dolly(0.9),
  "-": (orbit) => orbit.dolly(1 / 0.9),
  Home: (orbit) => orbit.reset(),
};

export class Orbit {
  constructor() {
    this.reset();
  }

  reset() {
    Object.assign(this, { azimuth: 0, elevation: 0, zoom: 1, offset: [0, 0] });
  }

  turn(azimuth, elevation) {
    this.azimuth += azimuth;
    this.elevation += elevation;
  }

  // Turn with a pointer that moves by this many pixels.
  drag(dx, dy) {
    this.turn(-TURN * dx, TURN * dy);
  }

  // Do what a key means: arrows turn, + and - zoom, Home resets. Returns whether it means anything.
  press(key) {
    if (!Object.hasOwn(KEYS, key)) return false;
    KEYS[key](this);
    return true;
  }

  dolly(factor) {
    this.zoom = Math.min(8, Math.max(0.05, this.zoom * factor));
  }

  // Distances are fractions of the picture's height.
  shift(right, up) {
    const near = (value) => Math.min(2, Math.max(-2, value));
    this.offset = [near(this.offset[0] + right), near(this.offset[1] + up)];
  }

  // The server's camera, changed by the user's moves.
  camera(base) {
    const away = subtract(base.position, base.target);
    const distance = length(away);
    const lifted = Math.asin(away[1] / distance);
    const over = Math.min(STEEPEST, Math.max(-STEEPEST, lifted + this.elevation));
    if (Math.abs(lifted) <= STEEPEST) this.elevation = over - lifted;
    const still = this.azimuth === 0 && this.elevation === 0;
    const heading = Math.atan2(away[0], away[2]) + this.azimuth;
    const back = still
      ? scale(away, 1 / distance)
      : [Math.sin(heading) * Math.cos(over), Math.sin(over), Math.cos(heading) * Math.cos(over)];
    const up = still ? base.up : UPRIGHT;
    const far = base.height === null ? distance * this.zoom : distance;
    const height = base.height === null ? null : base.height * this.zoom;
    const tall = height ?? 2 * far * Math.tan((base.fov * Math.PI) / 360);
    const right = unit(cross(up, back));
    const shift = add(scale(right, -this.offset[0] * tall), scale(cross(back, right), -this.offset[1] * tall));
    const target = add(base.target, shift);
    const camera = { ...base, target, position: add(target, scale(back, far)), up, height };
    return still && this.zoom === 1 ? camera : { ...camera, ...planes(base, distance, far) };
  }
}

// Near and far planes for a moved camera; they must not clip anything that was visible before.
function planes(base, distance, far) {
  const deep = 2 * Math.max(distance, base.far - distance);
  if (base.height !== null) return { near: base.near - deep, far: base.far + deep };
  return { near: Math.min(base.near, 0.02 * far), far: far + deep };
}

// The direction from a camera's target to the camera [degrees from +z towards +x].
export function azimuth(camera) {
  const { back, up } = axes(camera);
  // From straight above, use the picture's up direction, which points away from the viewer.
  const level = Math.hypot(back[0], back[2]) > 1e-3 ? back : scale(up, -Math.sign(dot(back, UPRIGHT)));
  return (Math.atan2(level[0], level[2]) * 180) / Math.PI;
}
