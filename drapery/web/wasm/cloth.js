// Plays cloth with the kernels of the simulation; the Python package drapery.web.wasm documents it.

const ARRAYS = { float32: Float32Array, float64: Float64Array, int32: Int32Array, int64: BigInt64Array, uint32: Uint32Array };
const GOLDEN = (Math.sqrt(5) - 1) / 2; // multiples of it, without their whole parts, are far from each other
const loaded = new WeakMap();

// The kernels of a module in memory of their own, which all cloths of a page share.
async function start(module) {
  if (typeof WebAssembly !== "object") throw new Error("this browser has no WebAssembly");
  const compiled = module instanceof WebAssembly.Module ? module : await WebAssembly.compile(module);
  const [section] = WebAssembly.Module.customSections(compiled, "drapery");
  if (!section) throw new Error("the module has not been built by drapery.web.wasm.build");
  const { sources } = JSON.parse(new TextDecoder().decode(section));
  const { exports } = await WebAssembly.instantiate(compiled, {});
  return { exports, sources, spare: {} };
}

// The header of a plan, and its image without the zeros at the end.
function read(plan) {
  try {
    const start = 4 + new DataView(plan.buffer, plan.byteOffset).getUint32(0, true);
    return { info: JSON.parse(new TextDecoder().decode(plan.subarray(4, start))), image: plan.subarray(start) };
  } catch {
    throw new Error("the plan of the cloth is damaged");
  }
}

export class Cloth {
  static async load(module, plan) {
    if (!loaded.has(module)) loaded.set(module, start(module));
    return new Cloth(await loaded.get(module), plan instanceof Uint8Array ? plan : new Uint8Array(plan));
  }

  constructor(kernels, plan) {
    Object.assign(this, { kernels, ...read(plan) });
    const { module, image } = this.info;
    if (module !== kernels.sources) throw new Error(`the plan needs the module ${module}, not ${kernels.sources}`);
    this.spare = kernels.spare[image] ??= []; // places that other cloths have left
    this.place = this.spare.pop() ?? kernels.exports.reserve(image);
    if (!this.place) throw new Error("there is no memory for another cloth");
    this.reset();
  }

  // Leave the memory to the next cloth; this one cannot be used any more.
  free() {
    if (this.kernels) this.spare.push(this.place);
    this.kernels = null;
  }

  reset() {
    const { place, kernels: { exports }, info } = this;
    const memory = new Uint8Array(exports.memory.buffer, place, info.image);
    memory.fill(0).set(this.image);
    const view = new DataView(memory.buffer, place, info.image);
    for (const at of info.pointers) view.setUint32(at, place + view.getUint32(at, true), true);
    for (const [at, name] of info.functions) view.setBigInt64(at, BigInt(exports[name]()), true);
    this.written = new Set(); // the calls that have written what the cloth now looks like
    Object.assign(this, { seed: this.array("seeds")[0], phase: 0 });
    this.call("aim");
  }

  // One step a call: a call keeps the memory of all arrays that its steps make.
  step(steps = 1) {
    this.written.clear();
    this.array("clock")[1] = 1n;
    for (let n = 0; n < steps; n++) this.call("play");
  }

  // Go on with the motion of another cloth of as many particles.
  goOn(other) {
    for (const name of ["x", "v", "clock", "positions", "velocities"]) this.array(name).set(other.array(name));
    this.written.clear();
  }

  get time() {
    return Number(this.array("clock")[0]) * this.info.step;
  }

  // A part of the memory. The thick cloth is made where it is wanted: a page may make several steps
  // a frame.
  array(name) {
    const [at, type, length, writer] = this.info.fields[name];
    if (writer && !this.written.has(writer)) this.written.add(writer) && this.call(writer);
    return new ARRAYS[type](this.kernels.exports.memory.buffer, this.place + at, length);
  }

  setWind(...wind) {
    this.array("wind").set(wind);
    this.call("aim");
  }

  // The gusts of a seed, by default the planned one, so many seconds ahead. A seed also has waves of its own.
  setGusts(seed = this.seed, phase = 0) {
    const [seeds, phases, turns] = ["seeds", "phases", "turns"].map((name) => this.array(name));
    const other = seed - seeds[0];
    seeds[0] = seed;
    turns.forEach((turn, wave) => (turns[wave] = (turn + other * GOLDEN * (wave + 1)) % 1));
    phases.forEach((before, lane) => (phases[lane] = before + phase - this.phase));
    this.phase = phase;
  }

  pull(index, ...target) {
    this.array("grab")[0] = BigInt(index);
    this.array("target").set(target);
  }

  release() {
    this.array("grab")[0] = -1n;
  }

  // The picture of the plan's settings with the cloth as it is: what ImageData takes. tables: values
  // for the beginnings of `materials`, `layers` and `atlas`, if the plan's own are not to be used.
  picture(tables = {}) {
    if (!this.info.picture) throw new Error("the plan was written without a picture");
    for (const [name, values] of Object.entries(tables)) this.array(name).set(values);
    this.array("vertices");
    this.call("draw");
    const [width, height] = this.info.picture;
    return { data: new Uint8ClampedArray(this.array("picture").slice().buffer), width, height };
  }

  call(purpose) {
    const [name, at, fault] = this.info.calls[purpose];
    const { exports } = this.kernels;
    const status = exports[name](this.place + at);
    if (status || new DataView(exports.memory.buffer).getInt32(this.place + at, true)) throw new Error(fault);
  }
}

for (const name of ["positions", "velocities", "vertices", "normals", "light"])
  Object.defineProperty(Cloth.prototype, name, { get() { return this.array(name); } });
