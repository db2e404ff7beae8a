// One picture of all players that move, drawn in one go and then copied to the canvas of each.

import { clear } from "../viewer/drawing.js";
import { packed } from "../viewer/packing.js";

const WIDEST = 4096; // side of the picture [samples]

export class Sheet {
  // gl: a context without antialiasing. fail: called with a player that cannot be drawn, and its error.
  constructor(gl, fail) {
    Object.assign(this, { gl, fail });
    this.samples = gl.createFramebuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.samples);
    this.buffers = [gl.COLOR_ATTACHMENT0, gl.DEPTH_ATTACHMENT].map((attachment) => {
      const buffer = gl.createRenderbuffer();
      gl.bindRenderbuffer(gl.RENDERBUFFER, buffer);
      gl.framebufferRenderbuffer(gl.FRAMEBUFFER, attachment, gl.RENDERBUFFER, buffer);
      return buffer;
    });
  }

  draw(players) {
    const fine = devicePixelRatio < 1.5 ? 2 : 1; // samples along each side of a pixel, to smooth edges
    const shown = players.filter((player) => player.fit(WIDEST / fine));
    if (shown.length && !this.gl.isContextLost()) this.drawAll(shown, fine);
  }

  drawAll(shown, fine) {
    const { places, size } = packed(shown.map(({ canvas }) => [canvas.width, canvas.height]), WIDEST / fine);
    if (size[1] > WIDEST / fine && shown.length > 1) {
      const half = shown.length >> 1;
      this.drawAll(shown.slice(0, half), fine);
      this.drawAll(shown.slice(half), fine);
      return;
    }
    const { gl } = this;
    this.resize(size, fine);
    const whole = [0, 0, fine * size[0], fine * size[1]];
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.samples);
    clear(gl, whole);
    const isDrawn = shown.map((player, number) => {
      const { width, height } = player.canvas;
      try {
        player.drawInto(fine * width, fine * height, places[number].map((side) => fine * side));
        return true;
      } catch (error) {
        this.fail(player, error);
        return false;
      }
    });
    gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, null);
    gl.scissor(...whole);
    gl.blitFramebuffer(...whole, 0, 0, ...size, gl.COLOR_BUFFER_BIT, gl.LINEAR);
    shown.forEach(({ canvas }, number) => {
      if (!isDrawn[number]) return; // what was seen before stays
      const { width, height } = canvas;
      const [x, y] = [places[number][0], size[1] - places[number][1] - height];
      const context = canvas.getContext("2d");
      context.globalCompositeOperation = "copy";
      context.drawImage(gl.canvas, x, y, width, height, 0, 0, width, height);
    });
  }

  resize(size, fine) {
    const { gl } = this;
    if (String([size, fine]) === this.last) return;
    this.last = String([size, fine]);
    [gl.canvas.width, gl.canvas.height] = size;
    [gl.RGBA8, gl.DEPTH_COMPONENT24].forEach((format, number) => {
      gl.bindRenderbuffer(gl.RENDERBUFFER, this.buffers[number]);
      gl.renderbufferStorage(gl.RENDERBUFFER, format, ...size.map((side) => fine * side));
    });
  }
}
