// A scene whose cloth moves, on a canvas: the shared context draws it, and its picture is copied.

import { Cloth } from "../wasm/cloth.js";
import { Drawing } from "../viewer/drawing.js";
import { add, cross, dot, length, readCamera, scale, subtract, unit } from "../viewer/matrices.js";
import { unpack } from "../viewer/messages.js";
import { View } from "../viewer/view.js";
import { DesignError } from "./design.js";
import { fileBytes, players, sharedContext, wake } from "./shared.js";
import { TABLES } from "./tables.js";
import { retextured } from "./textures.js";

const LONGEST = 1 / 15; // time that passes in one frame [s]; slower pages show slower motion
const SETTLED = 3; // time before cloth is shown that does not move [s]

export class Player extends View {
  // canvas: its picture goes there. name: of a file that `drapery.web.scene_file` wrote.
  // textures: pixels in place of the scene's own, by name.
  static async open(canvas, name, textures = {}) {
    sharedContext();
    const [scene, module] = await Promise.all([fileBytes(name), fileBytes("cloth.bin")]);
    const own = unpack(scene.buffer);
    const [header, arrays] = retextured(own.header, own.arrays, textures);
    const cloths = await Promise.all(header.grip.map((_, number) => Cloth.load(module, arrays[`plan${number}`])));
    return new Player(canvas, header, arrays, cloths);
  }

  constructor(canvas, header, arrays, cloths) {
    super(canvas);
    Object.assign(this, { header, arrays, cloths, playing: false, owed: 0, moved: false, grab: null });
    this.cameras = header.cameras.list.map(readCamera);
    this.restore();
    players.add(this);
  }

  // Draw with a new context.
  restore() {
    this.drawing = new Drawing(sharedContext());
    this.drawing.setScene(this.header, this.arrays);
    this.drawing.setMoment(this.header, this.arrays);
    if (this.design) this.setDesign(this.design);
    if (this.moved) this.upload();
    wake(this);
  }

  end() {
    players.delete(this);
    this.drawing.free();
    this.cloths.forEach((cloth) => cloth.free());
  }

  // Throws DesignError for a pattern without a texture here. The flag's layers are those of the
  // scene, one for each sheet, copied to the end of the table in the order of the design.
  setDesign(design) {
    const { sheets, grip } = this.header;
    if (!sheets) return;
    const { materials, layers, vertexMaterials } = this.arrays;
    const flag = 4 * vertexMaterials[grip[0][0]];
    const dyed = [{ pattern: "base", dye: design.base }, ...design.layers];
    const rows = [{ pattern: "" }, ...dyed].flatMap(({ pattern, dye }) => {
      const sheet = sheets.indexOf(pattern);
      if (sheet < 0) throw new DesignError(`there is no texture of the pattern '${pattern}' here`);
      const start = 7 * (materials[flag] + sheet);
      return [...layers.subarray(start, start + 4), ...(TABLES.rgb[dye] ?? [255, 255, 255])];
    });
    const changed = materials.slice();
    changed.set([layers.length / 7, rows.length / 7], flag);
    this.drawing.setMaterials(changed, Int32Array.from([...layers, ...rows]));
    this.design = design;
    wake(this);
  }

  // speed: [m/s]. heading: to which it blows [degrees from +z towards +x]. Undefined: as planned.
  setWind(speed, heading) {
    for (const cloth of this.cloths) {
      const [x, y, z] = cloth.info.wind;
      if (speed === undefined && heading === undefined) {
        cloth.setWind(x, y, z);
        continue;
      }
      const angle = heading === undefined ? Math.atan2(x, z) : (heading * Math.PI) / 180;
      const rate = speed ?? Math.hypot(x, z);
      cloth.setWind(rate * Math.sin(angle), 0, rate * Math.cos(angle));
    }
  }

  // One frame; whether there will be another one.
  moment(seconds) {
    const moves = Boolean(this.playing || this.grab);
    const { step } = this.cloths[0].info;
    this.owed = Math.min(this.owed + (moves ? seconds / step : 0), Math.round(LONGEST / step));
    const steps = moves || this.moved ? Math.floor(this.owed) : Math.round(SETTLED / step);
    this.owed %= 1;
    if (steps) this.step(steps);
    if (this.canvas.width && !this.drawing.gl.isContextLost()) this.draw();
    return moves;
  }

  step(steps) {
    this.moved = true;
    for (const cloth of this.cloths) {
      try {
        cloth.step(steps);
      } catch {
        cloth.reset(); // it has blown up
      }
    }
    this.upload();
  }

  // Give the vertices of the cloth to the drawing.
  upload() {
    for (const [number, cloth] of this.cloths.entries()) {
      this.move(this.header.grip[number], cloth.vertices, cloth.light);
    }
    const { figure } = this.header;
    if (figure) this.move(figure, this.cloths[0].array("figure"), this.cloths[0].array("figureLight"));
  }

  move(run, positions, light) {
    this.drawing.setMoment({ runs: [run], tints: this.header.tints }, { positions, light });
  }

  // To where the wind of a wearer blows [degrees]; that of a banner blows to the viewer.
  get heading() {
    const [x, , z] = this.cloths[0].info.wind;
    return this.header.figure && (Math.atan2(x, z) * 180) / Math.PI;
  }

  draw() {
    const { width, height } = this.canvas;
    const { canvas } = this.drawing.gl;
    if (canvas.width < width) canvas.width = width;
    if (canvas.height < height) canvas.height = height;
    this.drawPanes(width, height);
    const context = this.canvas.getContext("2d");
    context.clearRect(0, 0, width, height);
    context.drawImage(canvas, 0, canvas.height - height, width, height, 0, 0, width, height);
  }

  // The scene's camera, further away where the canvas is narrower than what the camera frames.
  baseCamera(number, aspect) {
    const camera = super.baseCamera(number);
    const wider = Math.max(1, this.header.aspect / aspect);
    const fov = (Math.atan(wider * Math.tan((camera.fov * Math.PI) / 360)) * 360) / Math.PI;
    return { ...camera, fov, height: camera.height && camera.height * wider };
  }

  // Grab the particle nearest to the line of sight, if cloth is what is seen there.
  grabAt(x, y) {
    this.drop();
    if (!this.hitsCloth(x, y)) return;
    const { origin, along } = this.rayAt(x, y).ray;
    const found = this.cloths.flatMap((cloth) => {
      const places = [...Array(cloth.positions.length / 3).keys()].filter((index) => !cloth.info.pins.includes(index));
      return places.map((index) => {
        const place = this.placeOf(cloth, index);
        return { cloth, index, place, miss: length(cross(subtract(place, origin), unit(along))) };
      });
    });
    this.grab = found.reduce((best, each) => (each.miss < best.miss ? each : best));
  }

  // Pull the grabbed particle to the line of sight; its distance from the camera stays.
  pullTo(x, y) {
    const { origin, along, facing } = this.rayAt(x, y, 0).ray;
    const { cloth, index, place } = this.grab;
    const share = dot(subtract(place, origin), facing) / dot(along, facing);
    cloth.pull(index, ...subtract(this.unturned(add(origin, scale(along, share))), cloth.info.origin));
    wake(this);
  }

  // Where a particle is: between its vertices on the front and on the back.
  placeOf(cloth, index) {
    const vertex = (number) => cloth.vertices.subarray(3 * number, 3 * number + 3);
    return scale(add(vertex(index), vertex(index + cloth.positions.length / 3)), 0.5);
  }

  // A point in the frame of the body, which is turned about the middle of its block.
  unturned([x, y, z]) {
    const angle = (this.header.turned * Math.PI) / 180;
    const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
    return [cos * (x - 0.5) + sin * (z - 0.5) + 0.5, y, cos * (z - 0.5) - sin * (x - 0.5) + 0.5];
  }

  drop() {
    this.grab?.cloth.release();
    this.grab = null;
  }
}
