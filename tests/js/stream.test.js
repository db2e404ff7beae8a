import assert from "node:assert/strict";
import { beforeEach, mock, test } from "node:test";

import { Stream } from "../../drapery/web/viewer/stream.js";

// Node 20 has no WebSocket; this one is opened, closed and fed by the tests.
class Socket {
  static OPEN = 1;
  static all = [];

  constructor(address) {
    Object.assign(this, { address, readyState: 0, sent: [] });
    Socket.all.push(this);
  }

  send(text) {
    this.sent.push(JSON.parse(text));
  }

  close() {
    this.closed = true;
  }

  open() {
    this.readyState = Socket.OPEN;
    this.onopen();
  }

  lose(code = 1006) {
    this.readyState = 3;
    this.onclose({ code });
  }
}
globalThis.WebSocket = Socket;

let lines, messages, stream;
beforeEach(() => {
  mock.timers.reset();
  mock.timers.enable({ apis: ["setTimeout"] });
  Socket.all = [];
  [lines, messages] = [[], []];
  stream = new Stream("ws://x/live", (message) => messages.push(message), (line) => lines.push(line));
});
const last = () => Socket.all.at(-1);

test("only what is to be repeated is sent after the connection opens", () => {
  stream.send({ shape: [3, 4] }, true);
  stream.send({ drawn: 1 });
  stream.send({ hidden: true }, true);
  last().open();
  assert.deepEqual(last().sent, [{ shape: [3, 4], hidden: true }]);
  stream.send({ drawn: 2 });
  assert.deepEqual(last().sent.at(-1), { drawn: 2 });
});

test("a lost connection comes back, with longer and longer pauses", () => {
  stream.send({ shape: [3, 4] }, true);
  for (const pause of [250, 500, 1000, 2000, 4000, 4000]) {
    const count = Socket.all.length;
    last().lose();
    mock.timers.tick(pause - 1);
    assert.equal(Socket.all.length, count);
    mock.timers.tick(1);
    assert.equal(Socket.all.length, count + 1);
  }
  assert.match(lines.at(-1), /does not answer/);
  last().open();
  assert.equal(lines.at(-1), "");
  assert.deepEqual(last().sent, [{ shape: [3, 4] }]);
  last().lose();
  mock.timers.tick(250);
  assert.equal(Socket.all.length, 8, "the pauses start again");
});

test("a session that has ended is not asked again", () => {
  for (const [code, line] of [[4404, /reload the page/], [4429, /too many/]]) {
    const count = Socket.all.length;
    last().lose(code);
    mock.timers.tick(60_000);
    assert.match(lines.at(-1), line);
    assert.equal(Socket.all.length, count);
  }
});

test("texts are lines for the user, all else is unpacked", () => {
  last().open();
  last().onmessage({ data: '{"line": "wait"}' });
  assert.equal(lines.at(-1), "wait");
  const header = new TextEncoder().encode('{"arrays":[]}   ');
  const data = Uint8Array.from([16, 0, 0, 0, ...header]).buffer;
  last().onmessage({ data });
  assert.deepEqual(messages, [{ header: { arrays: [] }, arrays: {} }]);
});

test("a stream that was ended stays closed", () => {
  stream.end();
  assert.ok(last().closed);
  last().lose();
  mock.timers.tick(60_000);
  assert.equal(Socket.all.length, 1);
});
