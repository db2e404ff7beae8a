// The socket to the live cloth: it says what has been drawn, and comes back when it has been lost.

import { unpack } from "./messages.js";

const WAITS = [250, 500, 1000, 2000, 4000];
const UNKNOWN = 4404;
const ENOUGH = 4429;

export class Stream {
  // hear: takes each message; tell: takes a line for the user, "" when all is well again.
  constructor(address, hear, tell) {
    this.address = address;
    this.hear = hear;
    this.tell = tell;
    this.first = {};
    this.lost = 0;
    this.open();
  }

  open() {
    this.socket = new WebSocket(this.address);
    this.socket.binaryType = "arraybuffer";
    this.socket.onopen = () => {
      this.lost = 0;
      this.tell("");
      if (Object.keys(this.first).length) this.socket.send(JSON.stringify(this.first));
    };
    this.socket.onmessage = ({ data }) => {
      if (typeof data === "string") this.tell(JSON.parse(data).line ?? "");
      else this.hear(unpack(data));
    };
    this.socket.onclose = (event) => this.closed(event);
  }

  closed(event) {
    if (this.ended) return;
    if (event.code === UNKNOWN) this.tell("This tab's work has ended: reload the page.");
    else if (event.code === ENOUGH) this.tell("This tab shows too many live cloths: close one.");
    else {
      this.tell(this.lost > 1 ? "The studio does not answer; waiting for it." : "");
      this.timer = setTimeout(() => this.open(), WAITS[Math.min(this.lost++, WAITS.length - 1)]);
    }
  }

  // Say something now; `keep` says it again after a reconnection.
  say(words, keep = false) {
    if (keep) Object.assign(this.first, words);
    if (this.socket.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(words));
  }

  end() {
    this.ended = true;
    clearTimeout(this.timer);
    this.socket.close();
  }
}
