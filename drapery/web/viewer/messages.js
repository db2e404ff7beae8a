// A message of the live cloth: a header of JSON, and arrays behind it. See messages.py.

const TYPES = { float32: Float32Array, uint32: Uint32Array, int32: Int32Array, uint8: Uint8Array };

export function unpack(buffer) {
  const start = 4 + new DataView(buffer).getUint32(0, true);
  const header = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, start - 4)));
  const arrays = {};
  for (const [name, kind, count, at] of header.arrays)
    arrays[name] = new TYPES[kind](buffer, start + at, count);
  return { header, arrays };
}
