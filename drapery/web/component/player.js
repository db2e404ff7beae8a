// A scene whose cloth moves, on a canvas: the shared context draws it, and its picture is copied.

import { Cloth } from "../wasm/cloth.js";
import { Drawing } from "../viewer/drawing.js";
import { add, clipMatrix, dot, length, readCamera, scale, subtract, unit } from "../viewer/matrices.js";
import { unpack } from "../viewer/messages.js";
import { View } from "../viewer/view.js";
import { nameOf } from "./attributes.js";
import { DesignError, readDesign } from "./design.js";
import { draw, fileBytes, players, sharedContext, wake, wholeContext } from "./shared.js";
import { TABLES } from "./tables.js";
import { retextured } from "./textures.js";

const MODULE = "cloth.bin";
const LONGEST = 1 / 15; // time that passes in one frame [s]; slower pages show slower motion
const NEARER = 0.03; // so fast a camera comes back that has stepped back [of the picture a second]
const FURTHEST = 2; // so much more than planned it sees
const MARGIN = 1.02;
const SETTLED = 3; // time before cloth is shown that does not move [s]

// The plan of another fabric: a file has where the plans of all differ.
function woven(plan, file, fabric) {
  const { arrays } = unpack(file.buffer);
  return arrays[nameOf("fabric", fabric, Object.keys(arrays))].map((byte, at) => byte ^ plan[at]);
}

export class Player extends View {
  // canvas: its picture goes there. name: of a file that `drapery.web.scene_file` wrote. text: the
  // design, or null. textures: pixels in place of the scene's own, by name. fabric: another one, or null.
  // isWanted: asked when the files are there; without it there is no player, and no memory is taken.
  static async open(canvas, name, text, { textures = {}, fabric = null }, isWanted) {
    await wholeContext();
    const fabrics = fabric === null ? [] : [name.replace(".", "-fabrics.")];
    const [scene, module, others] = await Promise.all([name, MODULE, ...fabrics].map(fileBytes));
    if (!isWanted()) return null;
    const player = await this.made(canvas, unpack(scene.buffer), module, text, (plan) => (others ? woven(plan, others, fabric) : plan));
    Object.assign(player, { name, fabric });
    if (Object.keys(textures).length) player.retexture(textures);
    return player;
  }

  // The player of an unpacked scene. planOf: what a plan of the scene is replaced by.
  static async made(canvas, { header, arrays }, module, text, planOf = (plan) => plan) {
    const player = new this(canvas, header, arrays);
    player.setDesign(text);
    player.plans = header.grip.map((_, number) => planOf(arrays[`plan${number}`]));
    player.cloths = await Promise.all(player.plans.map((plan) => Cloth.load(module, plan)));
    player.restore();
    players.add(player);
    return player;
  }

  constructor(canvas, header, arrays) {
    super(canvas);
    Object.assign(this, { header, arrays, scene: { header, arrays }, given: {}, playing: false, owed: 0, moved: false, reach: 1, grab: null });
    this.tint = header.tint;
    this.base = readCamera(header.camera);
  }

  // Show other textures in place of the scene's own; the cloth goes on.
  retexture(textures) {
    Object.assign(this, retextured(this.scene, textures), { isRetextured: Object.keys(textures).length > 0 });
    this.tables = this.tablesOf(this.design);
    if (!sharedContext().isContextLost()) this.restore(); // else when it comes back
  }

  // Draw with a new context, or a new scene.
  restore() {
    this.drawing?.free();
    this.drawing = new Drawing(sharedContext());
    const [materials, layers] = this.tables;
    this.drawing.setScene(this.header, { ...this.arrays, materials, layers });
    this.drawing.setMoment(this.header.runs, this.arrays);
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
    this.tables = this.tablesOf(design);
    Object.assign(this, { text, design });
    this.drawing?.setMaterials(...this.tables);
    wake(this);
  }

  // The tables of materials and layers with a design on the flag. Its layers are those of the
  // scene, one for each sheet, copied to the end of the table in the order of the design.
  tablesOf({ base, layers: patterns }) {
    const { materials, layers, vertexMaterials } = this.arrays;
    if (!this.header.sheets) return [materials, layers];
    const flag = 4 * vertexMaterials[this.header.flag];
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

  // Look from the camera of a view, by default that of the scene. Throws an Error for a name that is not known.
  setView(name) {
    const { views = {}, camera } = this.header;
    this.base = readCamera(name === null ? camera : views[nameOf("view", name, Object.keys(views))]);
    this.reach = 1;
    this.orbit.reset();
  }

  // The light of a day: 1 at noon, 0 at night; undefined as planned.
  setDaylight(daylight) {
    const { daylights, tint: planned } = this.header;
    const at = (daylight ?? 0) * (daylights.length - 1);
    const [before, after] = [daylights[Math.floor(at)], daylights[Math.ceil(at)]];
    this.tint = daylight === undefined ? planned : before.map((tint, part) => tint + (after[part] - tint) * (at % 1));
    wake(this);
  }

  // given: wind, its speed [m/s]; direction, to which it blows [degrees from +z towards +x]; seed and
  // phase, as `Cloth.setGusts` has them. What is undefined is as planned.
  setWind(given) {
    this.given = given;
    this.cloths.forEach((cloth) => this.blow(cloth));
  }

  blow(cloth) {
    const { wind: speed, direction, seed, phase } = this.given;
    const { wind, heading } = cloth.info;
    const angle = ((direction ?? heading) * Math.PI) / 180;
    const rate = speed ?? Math.hypot(wind[0], wind[2]);
    const isPlanned = speed === undefined && direction === undefined;
    cloth.setGusts(seed, phase);
    cloth.setWind(...(isPlanned ? wind : [rate * Math.sin(angle), 0, rate * Math.cos(angle)]));
  }

  // Move the cloth for one frame; whether there will be another one.
  moment(seconds) {
    if (!this.cloths.length) return false;
    const moves = Boolean(this.playing || this.grab);
    const { step } = this.cloths[0].info;
    this.owed = Math.min(this.owed + (moves ? seconds / step : 0), Math.round(LONGEST / step));
    const steps = moves || this.moved ? Math.floor(this.owed) : Math.round(SETTLED / step);
    this.owed %= 1;
    if (steps) this.step(steps);
    return moves;
  }

  // Begin again, in the same wind.
  reset() {
    this.drop();
    this.moved = false;
    for (const cloth of this.cloths) {
      cloth.reset();
      this.blow(cloth);
    }
    this.upload();
    wake(this);
  }

  // Go on with the motion of another player, if its cloth is like this one; whether it is.
  follow({ cloths, plans, moved, owed }) {
    const isLike = (cloth, before) => before && cloth.array("x").length === before.array("x").length && String(cloth.info.pins) === String(before.info.pins);
    // The cloth of a wearer goes with the wearer's own motion, of which a plan has all.
    const isSame = (plan, number) => plan.length === plans[number]?.length && plan.every((byte, at) => byte === plans[number][at]);
    const goesOn = this.header.textures ? this.plans.every(isSame) : this.cloths.every((cloth, number) => isLike(cloth, cloths[number]));
    if (!moved || !this.cloths.length || !goesOn) return false;
    this.cloths.forEach((cloth, number) => cloth.goOn(cloths[number]));
    Object.assign(this, { moved, owed });
    this.upload();
    return true;
  }

  step(steps) {
    this.moved = true;
    for (const cloth of this.cloths) {
      try {
        cloth.step(steps);
      } catch {
        cloth.reset(); // it has blown up
        this.blow(cloth);
      }
    }
    this.upload();
    if (!this.grab) this.hold(steps * this.cloths[0].info.step);
  }

  // Step back as far as cloth blows out of the picture, and slowly come nearer again.
  hold(seconds) {
    const matrix = clipMatrix(this.base, this.header.aspect);
    let reach = Math.max(1, this.reach - NEARER * seconds);
    for (const [number, , , name] of this.header.moving) {
      const places = this.cloths[number].array(name);
      for (let at = 0; at < places.length; at += 3) {
        const row = (part) => matrix[part] * places[at] + matrix[part + 4] * places[at + 1] + matrix[part + 8] * places[at + 2] + matrix[part + 12];
        reach = Math.max(reach, (MARGIN * Math.max(Math.abs(row(0)), Math.abs(row(1)))) / row(3));
      }
    }
    this.reach = Math.min(FURTHEST, reach);
  }

  // Give the vertices of the cloth, and of a wearer, to the drawing.
  upload() {
    for (const [number, start, count, positions, light] of this.header.moving) {
      const cloth = this.cloths[number];
      const now = { positions: cloth.array(positions), light: cloth.array(light) };
      this.drawing.setMoment([[start, count]], now);
    }
  }

  draw() {
    draw([this]);
  }

  // Give the canvas as many pixels as it covers on the screen, at most so many on a side; whether it
  // covers any.
  fit(longest) {
    const { canvas } = this;
    const sides = [canvas.clientWidth, canvas.clientHeight];
    const ratio = Math.min(devicePixelRatio, longest / Math.max(...sides));
    const [width, height] = sides.map((side) => Math.round(side * ratio));
    if (!width || !height) return false;
    if (canvas.width !== width) canvas.width = width;
    if (canvas.height !== height) canvas.height = height;
    return true;
  }

  // The still that `drapery render` draws of the design with the options of the scene: a cloth of
  // its own moves for the time of these options.
  async picture() {
    const { atlas } = this.arrays;
    if (this.isRetextured) throw new Error("drapery: pictures with other textures need Python; use snapshot()");
    if (!this.header.still) throw new Error(`drapery: ${this.header.noPicture}`);
    const [materials, layers] = this.tables;
    const cloth = await Cloth.load(...(await Promise.all([MODULE, this.header.still].map(fileBytes))));
    try {
      cloth.step(cloth.info.steps);
      const texels = new Uint32Array(atlas.buffer, atlas.byteOffset, atlas.length / 4);
      const { data, width, height } = cloth.picture({ materials, layers, atlas: texels });
      return new ImageData(data, width, height);
    } finally {
      cloth.free();
    }
  }

  // The scene's camera, further away where the canvas is narrower than what the camera frames, or the cloth wider.
  baseCamera(aspect) {
    const camera = this.base;
    const wider = this.reach * Math.max(1, this.header.aspect / aspect);
    const fov = (Math.atan(wider * Math.tan((camera.fov * Math.PI) / 360)) * 360) / Math.PI;
    return { ...camera, fov, height: camera.height && camera.height * wider };
  }

  // Grab the particle nearest to the line of sight, if cloth is what is seen there.
  grabAt(x, y) {
    this.drop();
    if (!this.hitsCloth(x, y)) return;
    const found = this.cloths.flatMap((cloth) => {
      const places = Array.from({ length: cloth.positions.length / 3 }, (_, n) => cloth.positions.slice(3 * n, 3 * n + 3));
      return places.map((place, index) => ({ cloth, index, place, miss: length(subtract(this.inSight(x, y, cloth, place), place)) }));
    });
    const loose = found.filter(({ cloth, index }) => !cloth.info.pins.includes(index));
    this.grab = loose.reduce((best, each) => (each.miss < best.miss ? each : best));
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
    const { origin, along } = this.rayAt(x, y);
    const [from, to] = [origin, add(origin, along)].map((point) => info.frame.map((row) => dot(row, point) + row[3]));
    const ahead = unit(subtract(to, from));
    return add(from, scale(ahead, dot(subtract(place, from), ahead)));
  }
}
