// A scene whose cloth moves, on a canvas: the shared context draws it, and its picture is copied.

import { Cloth } from "../wasm/cloth.js";
import { Drawing } from "../viewer/drawing.js";
import { add, dot, length, readCamera, scale, subtract, unit } from "../viewer/matrices.js";
import { unpack } from "../viewer/messages.js";
import { View } from "../viewer/view.js";
import { DesignError, readDesign } from "./design.js";
import { fileBytes, players, sharedContext, wake } from "./shared.js";
import { TABLES } from "./tables.js";
import { retextured } from "./textures.js";

const MODULE = "cloth.bin";
const LONGEST = 1 / 15; // time that passes in one frame [s]; slower pages show slower motion
const SETTLED = 3; // time before cloth is shown that does not move [s]

export class Player extends View {
  // canvas: its picture goes there. name: of a file that `drapery.web.scene_file` wrote. text: the
  // design, or null. textures: pixels in place of the scene's own, by name.
  static async open(canvas, name, text, textures) {
    sharedContext();
    const [scene, module] = await Promise.all([fileBytes(name), fileBytes(MODULE)]);
    const own = unpack(scene.buffer);
    const [header, arrays] = retextured(own.header, own.arrays, textures);
    const player = new Player(canvas, header, arrays);
    player.setDesign(text);
    player.cloths = await Promise.all(header.grip.map((_, number) => Cloth.load(module, arrays[`plan${number}`])));
    player.restore();
    players.add(player);
    return player;
  }

  constructor(canvas, header, arrays) {
    super(canvas);
    Object.assign(this, { header, arrays, playing: false, owed: 0, moved: false, grab: null });
    this.cameras = header.cameras.list.map(readCamera);
  }

  // Draw with a new context.
  restore() {
    this.drawing = new Drawing(sharedContext());
    this.drawing.setScene(this.header, this.arrays);
    this.drawing.setMaterials(...this.tables);
    this.drawing.setMoment(this.header, this.arrays);
    if (this.moved) this.upload();
    wake(this);
  }

  end() {
    players.delete(this);
    this.drawing.free();
    this.cloths.forEach((cloth) => cloth.free());
  }

  // Show a design, if the scene shows any; null is a white banner. Throws DesignError.
  setDesign(text) {
    if (text === this.text) return;
    const design = readDesign(text ?? "white");
    this.tables = this.header.sheets ? this.tablesOf(design) : [this.arrays.materials, this.arrays.layers];
    Object.assign(this, { text, design });
    this.drawing?.setMaterials(...this.tables);
    wake(this);
  }

  // The tables of materials and layers with a design on the flag. Its layers are those of the
  // scene, one for each sheet, copied to the end of the table in the order of the design.
  tablesOf({ base, layers: patterns }) {
    const { materials, layers, vertexMaterials } = this.arrays;
    const flag = 4 * vertexMaterials[this.header.grip[0][0]];
    const rows = [{ pattern: "" }, { pattern: "base", dye: base }, ...patterns].flatMap(({ pattern, dye }) => {
      const sheet = this.header.sheets.indexOf(pattern);
      if (sheet < 0) throw new DesignError(`there is no texture of the pattern '${pattern}' here`);
      const start = 7 * (materials[flag] + sheet);
      return [...layers.subarray(start, start + 4), ...(TABLES.rgb[dye] ?? [255, 255, 255])];
    });
    const changed = materials.slice();
    changed.set([layers.length / 7, rows.length / 7], flag);
    return [changed, Int32Array.from([...layers, ...rows])];
  }

  // speed: [m/s]. heading: to which it blows [degrees from +z towards +x]. Undefined: as planned.
  setWind(speed, heading) {
    for (const cloth of this.cloths) {
      const [x, y, z] = cloth.info.wind;
      const angle = heading === undefined ? Math.atan2(x, z) : (heading * Math.PI) / 180;
      const rate = speed ?? Math.hypot(x, z);
      if (speed === undefined && heading === undefined) cloth.setWind(x, y, z);
      else cloth.setWind(rate * Math.sin(angle), 0, rate * Math.cos(angle));
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
    this.draw();
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
    const ratio = devicePixelRatio < 1.5 ? 2 * devicePixelRatio : devicePixelRatio; // finer, to smooth edges
    const sides = [this.canvas.clientWidth, this.canvas.clientHeight];
    const [width, height] = sides.map((side) => Math.round(side * ratio));
    const { canvas } = this.drawing.gl;
    if (!width || !height || this.drawing.gl.isContextLost()) return;
    if (canvas.width < width) canvas.width = width;
    if (canvas.height < height) canvas.height = height;
    this.drawPanes(width, height);
    if (this.canvas.width !== width) this.canvas.width = width;
    if (this.canvas.height !== height) this.canvas.height = height;
    const context = this.canvas.getContext("2d");
    context.clearRect(0, 0, width, height);
    context.drawImage(canvas, 0, canvas.height - height, width, height, 0, 0, width, height);
  }

  // The still that `drapery render` draws of the design with the options of the scene: a cloth of
  // its own moves for the time of these options.
  async picture() {
    const { still, atlas } = this.arrays;
    if (!still) throw new Error(`drapery: ${this.header.noPicture}`);
    const [materials, layers] = this.tables;
    const cloth = await Cloth.load(await fileBytes(MODULE), still);
    try {
      cloth.step(cloth.info.steps);
      const texels = new Uint32Array(atlas.buffer, atlas.byteOffset, atlas.length / 4);
      const { data, width, height } = cloth.picture({ materials, layers, atlas: texels });
      return new ImageData(data, width, height);
    } finally {
      cloth.free();
    }
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
    let nearest = Infinity;
    for (const cloth of this.cloths) {
      for (let index = 0; index < cloth.positions.length / 3; index++) {
        const place = cloth.positions.slice(3 * index, 3 * index + 3);
        const miss = length(subtract(this.inSight(x, y, cloth, place), place));
        if (miss >= nearest || cloth.info.pins.includes(index)) continue;
        nearest = miss;
        this.grab = { cloth, index, place };
      }
    }
  }

  // Pull the grabbed particle to the line of sight.
  pullTo(x, y) {
    const { cloth, index, place } = this.grab;
    cloth.pull(index, ...this.inSight(x, y, cloth, place));
  }

  drop() {
    this.grab?.cloth.release();
    this.grab = null;
  }

  // The point of a line of sight that is nearest to a place, both in the frame of a panel.
  inSight(x, y, { info }, place) {
    const { origin, along } = this.rayAt(x, y, 0).ray;
    const [from, to] = [origin, add(origin, along)].map((point) => subtract(this.unturned(point), info.origin));
    const ahead = unit(subtract(to, from));
    return add(from, scale(ahead, dot(subtract(place, from), ahead)));
  }

  // A point in the frame of the body, which is turned about the middle of its block.
  unturned([x, y, z]) {
    const angle = (this.header.turned * Math.PI) / 180;
    const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
    return [cos * (x - 0.5) + sin * (z - 0.5) + 0.5, y, cos * (z - 0.5) - sin * (x - 0.5) + 0.5];
  }
}
