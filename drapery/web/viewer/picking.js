// Whether the first surface that a ray hits is a cloth that can be grabbed.

import { cross, dot, subtract } from "./matrices.js";

export function meetsCloth(scene, ray) {
  const canGrab = (vertex) => scene.header.grip.some(([start, size]) => vertex >= start && vertex < start + size);
  const at = (vertex) => scene.positions.subarray(3 * vertex, 3 * vertex + 3);
  let nearest = Infinity;
  let cloth = false;
  for (let t = 0; 3 * t < scene.triangles.length; t++) {
    const corners = scene.triangles.subarray(3 * t, 3 * t + 3);
    const distance = meets(ray, at(corners[0]), at(corners[1]), at(corners[2]));
    if (distance < nearest) {
      nearest = distance;
      cloth = canGrab(corners[0]);
    }
  }
  return cloth;
}

// Möller and Trumbore, "Fast, minimum storage ray/triangle intersection" (1997).
function meets({ origin, along }, a, b, c) {
  const ab = subtract(b, a);
  const ac = subtract(c, a);
  const p = cross(along, ac);
  const area = dot(ab, p);
  if (Math.abs(area) < 1e-12) return Infinity;
  const from = subtract(origin, a);
  const u = dot(from, p) / area;
  const q = cross(from, ab);
  const v = dot(along, q) / area;
  const distance = dot(ac, q) / area;
  return u >= 0 && v >= 0 && u + v <= 1 && distance > 0 ? distance : Infinity;
}
