import assert from "node:assert/strict";
import { test } from "node:test";

import { unpack } from "../../drapery/web/viewer/messages.js";

function message(header, parts) {
  const text = new TextEncoder().encode(JSON.stringify(header));
  const padded = new Uint8Array(Math.ceil(text.length / 4) * 4).fill(32);
  padded.set(text);
  const size = new Uint8Array(Uint32Array.of(padded.length).buffer);
  return Uint8Array.from([size, padded, ...parts].flatMap((part) => [...part])).buffer;
}

test("arrays keep their types and values", () => {
  const floats = new Uint8Array(Float32Array.of(1.5, -2).buffer);
  const bytes = Uint8Array.of(7, 8, 9, 0);
  const arrays = [["positions", "float32", 2, 0], ["atlas", "uint8", 3, 8]];
  const found = unpack(message({ kind: "é", arrays }, [floats, bytes]));
  assert.equal(found.header.kind, "é");
  assert.deepEqual(found.arrays.positions, Float32Array.of(1.5, -2));
  assert.deepEqual(found.arrays.atlas, Uint8Array.of(7, 8, 9));
});

test("a message may have no arrays", () => {
  assert.deepEqual(unpack(message({ arrays: [] }, [])).arrays, {});
});

test("a message that is cut short throws", () => {
  const whole = message({ arrays: [["a", "int32", 4, 0]] }, [new Uint8Array(16)]);
  assert.throws(() => unpack(whole.slice(0, -4)), RangeError);
});
