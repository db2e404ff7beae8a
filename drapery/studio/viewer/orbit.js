// How far the viewer has walked from where the server's camera stands.

import { add, axes, cross, dot, length, scale, subtract, unit } from "./matrices.js";

const STEEPEST = (88 * Math.PI) / 180;
const UPRIGHT = [0, 1, 0];

export class Orbit {
  constructor() {
    this.reset();
  }

  reset() {
    this.around = 0;
    this.over = 0;
    this.zoom = 1;
    this.aside = [0, 0];
  }

  turn(around, over) {
    this.around += around;
    this.over += over;
  }

  approach(factor) {
    this.zoom = Math.min(8, Math.max(0.05, this.zoom * factor));
  }

  // By parts of the picture's height.
  shift(right, up) {
    const near = (value) => Math.min(2, Math.max(-2, value));
    this.aside = [near(this.aside[0] + right), near(this.aside[1] + up)];
  }

  // The camera, walked round its target.
  camera(base) {
    const away = subtract(base.position, base.target);
    const distance = length(away);
    const lifted = Math.asin(away[1] / distance);
    const over = Math.min(STEEPEST, Math.max(-STEEPEST, lifted + this.over));
    if (Math.abs(lifted) <= STEEPEST) this.over = over - lifted;
    const still = this.around === 0 && this.over === 0;
    const heading = Math.atan2(away[0], away[2]) + this.around;
    const back = still
      ? scale(away, 1 / distance)
      : [Math.sin(heading) * Math.cos(over), Math.sin(over), Math.cos(heading) * Math.cos(over)];
    const up = still ? base.up : UPRIGHT;
    const far = base.height === null ? distance * this.zoom : distance;
    const height = base.height === null ? null : base.height * this.zoom;
    const tall = height ?? 2 * far * Math.tan((base.fov * Math.PI) / 360);
    const right = unit(cross(up, back));
    const shift = add(scale(right, -this.aside[0] * tall), scale(cross(back, right), -this.aside[1] * tall));
    const target = add(base.target, shift);
    const camera = { ...base, target, position: add(target, scale(back, far)), up, height };
    return still && this.zoom === 1 ? camera : { ...camera, ...planes(base, distance, far) };
  }
}

// Whoever walks round wants neither the near nor the far plane to cut what is seen.
function planes(base, distance, far) {
  const deep = 2 * Math.max(distance, base.far - distance);
  if (base.height !== null) return { near: base.near - deep, far: base.far + deep };
  return { near: Math.min(base.near, 0.02 * far), far: far + deep };
}

// Where a camera stands about its target [degrees from +z towards +x].
export function azimuth(camera) {
  const { back, up } = axes(camera);
  // From straight above, what is up in the picture is away from the viewer.
  const level = Math.hypot(back[0], back[2]) > 1e-3 ? back : scale(up, -Math.sign(dot(back, UPRIGHT)));
  return (Math.atan2(level[0], level[2]) * 180) / Math.PI;
}
