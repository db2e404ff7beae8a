// Plays cloth with the kernels of the simulation; the Python package drapery.web.wasm documents it.

const ARRAYS = {
  float32: Float32Array, float64: Float64Array, int32: Int32Array, int64: BigInt64Array, uint32: Uint32Array,
};
const FAULTS = {
  play: "the cloth has blown up; use a weaker wind",
  draw: "the cloth is outside the picture",
};
const loaded = new WeakMap();

// The kernels of a module in memory of their own, which all cloths of a page share.
class Kernels {
  static load(module) {
    if (!loaded.has(module)) loaded.set(module, Kernels.start(module));
    return loaded.get(module);
  }

  static async start(module) {
    if (typeof WebAssembly !== "object") throw new Error("this browser has no WebAssembly");
    const compiled = module instanceof WebAssembly.Module ? module : await WebAssembly.compile(module);
    const [section] = WebAssembly.Module.customSections(compiled, "drapery");
    if (!section) throw new Error("the module has not been built by drapery.web.wasm.build");
    const { exports } = await WebAssembly.instantiate(compiled, {});
    return new Kernels(exports, JSON.parse(new TextDecoder().decode(section)));
  }

  constructor(exports, info) {
    Object.assign(this, { exports, info, free: new Map() });
  }

  get buffer() {
    return this.exports.memory.buffer;
  }

  reserve(size) {
    const place = this.free.get(size)?.pop() ?? this.exports.reserve(size);
    if (!place) throw new Error("there is no memory for another cloth");
    return place;
  }

  release(size, place) {
    this.free.set(size, [...(this.free.get(size) ?? []), place]);
  }
}

export class Cloth {
  static async load(module, plan) {
    return new Cloth(await Kernels.load(module), bytes(plan));
  }

  constructor(kernels, plan) {
    const { info, image } = read(plan);
    if (info.module !== kernels.info.sources) {
      throw new Error(`the plan needs the module ${info.module}, not ${kernels.info.sources}`);
    }
    Object.assign(this, { kernels, info, image });
    this.place = kernels.reserve(info.image);
    this.reset();
  }

  reset() {
    const memory = new Uint8Array(this.kernels.buffer, this.place, this.info.image);
    memory.set(this.image);
    memory.fill(0, this.image.length);
    const view = new DataView(this.kernels.buffer, this.place, this.info.image);
    for (const at of this.info.pointers) view.setUint32(at, this.place + view.getUint32(at, true), true);
    for (const [at, name] of this.info.functions) {
      view.setBigInt64(at, BigInt(this.kernels.exports[name]()), true);
    }
    this.covered = false;
    this.call("aim");
  }

  step(steps = 1) {
    this.array("clock")[1] = BigInt(steps);
    this.covered = false;
    this.call("play");
  }

  // The thick cloth, which is made where it is wanted: a page may make several steps a frame.
  cover() {
    if (!this.covered) ["cover", "pose"].filter((name) => this.info.calls[name]).forEach((name) => this.call(name));
    this.covered = true;
  }

  get time() {
    return Number(this.array("clock")[0]) * this.info.step;
  }

  get positions() {
    return this.array("positions");
  }

  get velocities() {
    return this.array("velocities");
  }

  get vertices() {
    this.cover();
    return this.array("vertices");
  }

  get normals() {
    this.cover();
    return this.array("normals");
  }

  get light() {
    this.cover();
    return this.array("light");
  }

  setWind(x, y, z) {
    this.array("wind").set([x, y, z]);
    this.call("aim");
  }

  pull(index, x, y, z) {
    this.array("grab")[0] = BigInt(index);
    this.array("target").set([x, y, z]);
  }

  release() {
    this.array("grab")[0] = -1n;
  }

  // The picture of the plan's settings with the cloth as it is: what ImageData takes. tables: values
  // for the beginnings of `materials`, `layers` and `atlas`, if the plan's own are not to be used.
  picture(tables = {}) {
    if (!this.info.picture) throw new Error("the plan was written without a picture");
    for (const [name, values] of Object.entries(tables)) this.array(name).set(values);
    this.cover();
    this.call("draw");
    const [width, height] = this.info.picture;
    const pixels = this.array("picture");
    const data = new Uint8ClampedArray(pixels.buffer, pixels.byteOffset, pixels.byteLength).slice();
    return { data, width, height };
  }

  free() {
    this.kernels.release(this.info.image, this.place);
    this.kernels = null;
  }

  array(name) {
    const [at, type, length] = this.info.fields[name];
    return new ARRAYS[type](this.kernels.buffer, this.place + at, length);
  }

  call(purpose) {
    const [name, at] = this.info.calls[purpose];
    const status = this.kernels.exports[name](this.place + at);
    const result = new DataView(this.kernels.buffer).getInt32(this.place + at, true);
    if (status || result) throw new Error(FAULTS[purpose] ?? `the kernel ${name} has failed`);
  }
}

function bytes(data) {
  return data instanceof Uint8Array ? data : new Uint8Array(data);
}

// The header of a plan, and its image without the zeros at the end.
function read(plan) {
  const view = new DataView(plan.buffer, plan.byteOffset, plan.byteLength);
  try {
    const start = 4 + view.getUint32(0, true);
    return { info: JSON.parse(new TextDecoder().decode(plan.subarray(4, start))), image: plan.subarray(start) };
  } catch {
    throw new Error("the plan of the cloth is damaged");
  }
}
