import assert from "node:assert/strict";
import { test } from "node:test";

import { length, subtract } from "../../drapery/web/viewer/matrices.js";
import { azimuth, Orbit } from "../../drapery/web/viewer/orbit.js";
import { near, orthographic, perspective } from "./vectors.js";

const CAMERA = perspective([0, 1, 4], [0, 1, 0]);
const distance = (camera) => length(subtract(camera.position, camera.target));

test("an orbit that has not been moved gives the server's camera", () => {
  assert.deepEqual(new Orbit().camera(CAMERA), CAMERA);
});

test("a turn keeps the target and the distance and adds to the azimuth", () => {
  const orbit = new Orbit();
  orbit.turn(Math.PI / 3, 0.2);
  const camera = orbit.camera(CAMERA);
  near(camera.target, CAMERA.target);
  near([distance(camera), azimuth(camera)], [4, 60]);
});

test("nobody turns past the poles, and the excess is not stored", () => {
  const orbit = new Orbit();
  orbit.turn(0, 10);
  const steepest = (88 * Math.PI) / 180;
  near([orbit.camera(CAMERA).position[1] - 1], [4 * Math.sin(steepest)]);
  orbit.turn(0, -steepest);
  near([orbit.camera(CAMERA).position[1] - 1], [0]);
});

test("zoom moves a perspective camera and scales an orthographic one, within bounds", () => {
  const orbit = new Orbit();
  orbit.dolly(0.5);
  near([distance(orbit.camera(CAMERA))], [2]);
  const flat = orbit.camera(orthographic([0, 0, 4], 2));
  near([distance(flat), flat.height], [4, 1]);
  for (let time = 0; time < 20; time++) orbit.dolly(0.5);
  assert.equal(orbit.zoom, 0.05);
  for (let time = 0; time < 20; time++) orbit.dolly(2);
  assert.equal(orbit.zoom, 8);
});

test("a shift by half the height moves the target to the lower edge", () => {
  const orbit = new Orbit();
  orbit.shift(0, 0.5);
  const camera = orbit.camera(orthographic([0, 1, 4], 2, [0, 1, 0]));
  near(camera.target, [0, 0, 0]);
  near(camera.position, [0, 0, 4]);
});

test("a moved camera cuts nothing off that was visible", () => {
  const orbit = new Orbit();
  orbit.turn(1, 0);
  orbit.dolly(8);
  const camera = orbit.camera(CAMERA);
  assert.ok(camera.far >= distance(camera) + (CAMERA.far - 4));
  assert.ok(camera.near <= CAMERA.near);
});

test("reset undoes all moves", () => {
  const orbit = new Orbit();
  orbit.turn(1, 1);
  orbit.shift(1, 1);
  orbit.dolly(2);
  orbit.reset();
  assert.deepEqual(orbit.camera(CAMERA), CAMERA);
});

test("the azimuth is measured from +z towards +x, also from straight above", () => {
  near([azimuth(perspective([4, 0, 0]))], [90]);
  near([Math.abs(azimuth(perspective([0, 0, -4])))], [180]);
  const above = { ...perspective([0, 4, 0]), up: [0, 0, -1] };
  near([azimuth(above)], [0], 1e-6);
});
