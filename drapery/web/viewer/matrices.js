// Cameras as the server sends them: [position, target, up, fov, height, near, far], and the
// matrices of drapery.render.camera. Vectors are arrays of three; matrices are stored by columns.

export const add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const subtract = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const scale = (a, s) => [a[0] * s, a[1] * s, a[2] * s];
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a, b) => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
export const length = (a) => Math.hypot(a[0], a[1], a[2]);
export const unit = (a) => scale(a, 1 / length(a));

export function readCamera([position, target, up, fov, height, near, far]) {
  return { position, target, up, fov, height, near, far };
}

// The right, up and back directions of a camera, in world coordinates.
export function axes(camera) {
  const back = unit(subtract(camera.position, camera.target));
  const right = unit(cross(camera.up, back));
  return { right, up: cross(back, right), back };
}

// The matrix from world to clip space for a picture with this aspect ratio, width / height.
export function clipMatrix(camera, aspect) {
  const { right, up, back } = axes(camera);
  const rows = [right, up, back].map((axis) => [...axis, -dot(axis, camera.position)]);
  const { near, far } = camera;
  const high = camera.height === null ? 1 / Math.tan((camera.fov * Math.PI) / 360) : 2 / camera.height;
  const wide = high / aspect;
  const matrix = new Float32Array(16);
  for (let k = 0; k < 4; k++) {
    const one = k === 3 ? 1 : 0;
    const depth = rows[2][k];
    matrix[4 * k] = wide * rows[0][k];
    matrix[4 * k + 1] = high * rows[1][k];
    if (camera.height === null) {
      matrix[4 * k + 2] = ((far + near) / (near - far)) * depth + ((2 * far * near) / (near - far)) * one;
      matrix[4 * k + 3] = -depth;
    } else {
      matrix[4 * k + 2] = (2 / (near - far)) * depth + ((far + near) / (near - far)) * one;
      matrix[4 * k + 3] = one;
    }
  }
  return matrix;
}

// The line of sight through a point of the picture, x and y in -1..1.
export function sightRay(camera, aspect, x, y) {
  const { right, up, back } = axes(camera);
  const facing = scale(back, -1);
  const half = camera.height === null ? Math.tan((camera.fov * Math.PI) / 360) : camera.height / 2;
  const aside = add(scale(right, x * half * aspect), scale(up, y * half));
  if (camera.height === null) return { origin: camera.position, along: add(facing, aside), facing };
  return { origin: add(camera.position, aside), along: facing, facing };
}
