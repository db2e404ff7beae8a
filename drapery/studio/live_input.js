// Mouse, touch and keys on the viewer: turn the view, zoom, pull the cloth, steer the wind.

const STEERING = {
  KeyW: "w", KeyA: "a", KeyS: "s", KeyD: "d", KeyQ: "q", KeyE: "e",
  ArrowUp: "w", ArrowLeft: "a", ArrowDown: "s", ArrowRight: "d",
};

export class InputHandler {
  // viewer: has host, the element with its canvases, and orbit; see `live_viewer.js`.
  constructor(viewer) {
    this.viewer = viewer;
    this.pointers = new Map();
    this.heldKeys = new Set();
    this.pulling = false;
    this.ending = new AbortController();
    const { host } = viewer;
    this.listen(host, "pointerdown", (event) => this.down(event));
    this.listen(host, "pointermove", (event) => this.move(event));
    for (const end of ["pointerup", "pointercancel", "lostpointercapture"])
      this.listen(host, end, (event) => this.up(event));
    this.listen(host, "wheel", (event) => this.wheel(event));
    this.listen(host, "dblclick", () => this.change(() => viewer.orbit.reset()));
    this.listen(host, "contextmenu", (event) => event.preventDefault());
    this.listen(window, "keydown", (event) => this.key(event, true));
    this.listen(window, "keyup", (event) => this.key(event, false));
    this.listen(window, "blur", () => this.release());
  }

  listen(target, name, call) {
    target.addEventListener(name, call, { passive: false, signal: this.ending.signal });
  }

  end() {
    this.release();
    this.ending.abort();
  }

  change(call) {
    call();
    this.viewer.redraw();
  }

  down(event) {
    event.preventDefault();
    this.viewer.host.focus({ preventScroll: true });
    event.target.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, [event.offsetX, event.offsetY]);
    this.shifting = event.shiftKey || event.button === 2;
    if (this.pointers.size > 1) this.drop();
    else if (event.button === 0 && !event.shiftKey) this.pulling = this.viewer.grabAt(event.offsetX, event.offsetY);
    this.cursor(event);
  }

  move(event) {
    const before = this.pointers.get(event.pointerId);
    if (!before) return this.cursor(event);
    const [dx, dy] = [event.offsetX - before[0], event.offsetY - before[1]];
    const spread = this.spread();
    this.pointers.set(event.pointerId, [event.offsetX, event.offsetY]);
    const { orbit, host } = this.viewer;
    if (this.pulling) this.viewer.pullTo(event.offsetX, event.offsetY);
    else if (this.pointers.size === 2)
      this.change(() => {
        if (spread) orbit.dolly(spread / Math.max(1, this.spread()));
        orbit.shift(dx / 2 / host.clientHeight, -dy / 2 / host.clientHeight);
      });
    else if (this.shifting) this.change(() => orbit.shift(dx / host.clientHeight, -dy / host.clientHeight));
    else if (this.pointers.size === 1) this.change(() => orbit.drag(dx, dy));
  }

  up(event) {
    this.pointers.delete(event.pointerId);
    this.drop();
    this.cursor(event);
  }

  drop() {
    if (this.pulling) this.viewer.drop();
    this.pulling = false;
  }

  // The distance between two fingers.
  spread() {
    const [a, b] = [...this.pointers.values()];
    return b ? Math.hypot(a[0] - b[0], a[1] - b[1]) : 0;
  }

  cursor(event) {
    const { host } = this.viewer;
    if (event.pointerType === "touch" || this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      const over = !this.pointers.size && this.viewer.hitsCloth(event.offsetX, event.offsetY);
      host.style.cursor = this.pulling ? "grabbing" : over ? "grab" : "move";
    });
  }

  wheel(event) {
    event.preventDefault();
    const lines = event.deltaMode === 1 ? 30 : 1;
    this.change(() => this.viewer.orbit.dolly(Math.exp(Math.min(120, Math.max(-120, event.deltaY * lines)) * 0.0015)));
  }

  // While the viewer has the focus: Shift + arrows turn the view, + and - zoom, Home resets it.
  key(event, down) {
    const inside = event.target === this.viewer.host;
    if (inside && down && this.moveCamera(event)) return event.preventDefault();
    if (down && (event.ctrlKey || event.altKey || event.metaKey || event.shiftKey)) return;
    const key = STEERING[event.code];
    if (!down) {
      if (key && this.heldKeys.delete(key)) this.viewer.steer(this.heldKeys);
      return;
    }
    if (event.defaultPrevented || window.studio?.isTaken(event.target)) return;
    const elsewhere = !inside && event.target !== document.body;
    if (elsewhere && (event.code === "Space" || event.code.startsWith("Arrow"))) return;
    if (event.code === "Space") {
      event.preventDefault();
      if (!event.repeat) this.viewer.switchWind();
    } else if (key) {
      event.preventDefault();
      if (!this.heldKeys.has(key)) this.viewer.steer(this.heldKeys.add(key));
    }
  }

  moveCamera({ key, shiftKey }) {
    if (key.startsWith("Arrow") && !shiftKey) return false;
    const pressed = this.viewer.orbit.press(key);
    if (pressed) this.viewer.redraw();
    return pressed;
  }

  release() {
    this.drop();
    this.pointers.clear();
    this.heldKeys.clear();
    this.viewer.steer(this.heldKeys);
  }
}
