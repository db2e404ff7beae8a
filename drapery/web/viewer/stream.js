// The socket to the live cloth: it reports what has been drawn, and reconnects when it is lost.

import { unpack } from "./messages.js";

const WAITS = [250, 500, 1000, 2000, 4000];
const UNKNOWN = 4404;
const ENOUGH = 4429;

export class Stream {
  // onMessage: gets each message; onStatus: gets a line for the user, or "" when all works again.
  constructor(address, onMessage, onStatus) {
    this.address = address;
    this.onMessage = onMessage;
    this.onStatus = onStatus;
    this.initial = {};
    this.lost = 0;
    this.open();
  }

  open() {
    this.socket = new WebSocket(this.address);
    this.socket.binaryType = "arraybuffer";
    this.socket.onopen = () => {
      this.lost = 0;
      this.onStatus("");
      if (Object.keys(this.initial).length) this.socket.send(JSON.stringify(this.initial));
    };
    this.socket.onmessage = ({ data }) => {
      if (typeof data === "string") this.onStatus(JSON.parse(data).line ?? "");
      else this.onMessage(unpack(data));
    };
    this.socket.onclose = (event) => this.closed(event);
  }

  closed(event) {
    if (this.ended) return;
    if (event.code === UNKNOWN) this.onStatus("This tab's session has ended: reload the page.");
    else if (event.code === ENOUGH) this.onStatus("This tab shows too many live cloths: close one.");
    else {
      this.onStatus(this.lost > 1 ? "The studio does not answer; waiting for it." : "");
      this.timer = setTimeout(() => this.open(), WAITS[Math.min(this.lost++, WAITS.length - 1)]);
    }
  }

  // Send a message now; `repeat` sends it again after a reconnection.
  send(message, repeat = false) {
    if (repeat) Object.assign(this.initial, message);
    if (this.socket.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(message));
  }

  end() {
    this.ended = true;
    clearTimeout(this.timer);
    this.socket.close();
  }
}
