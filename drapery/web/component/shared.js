// What all elements of a page share: one WebGL context, one clock, and each file only once.

import { PLACES } from "./places.js";
import { Sheet } from "./sheet.js";

export const players = new Set();
const awake = new Set(); // the players that want the next frame
const files = new Map();
let gl = null;
let sheet = null;
let frame = 0; // the request of the next frame, or 0
let before = 0;

// The context that draws for all elements. Throws an Error where there is no WebGL 2.
export function sharedContext() {
  if (gl) return gl;
  const canvas = document.createElement("canvas");
  gl = canvas.getContext("webgl2", { alpha: true, antialias: false, depth: false });
  if (!gl) throw new Error("WebGL 2 is missing");
  sheet = new Sheet(gl, rest);
  watchPixels();
  canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
  canvas.addEventListener("webglcontextrestored", () => {
    sheet = new Sheet(gl, rest);
    players.forEach((player) => player.restore());
  });
  return gl;
}

// The context when it draws: one that the system has taken away comes back later.
export async function wholeContext() {
  const { canvas } = sharedContext();
  if (gl.isContextLost()) await new Promise((done) => canvas.addEventListener("webglcontextrestored", done, { once: true }));
}

// Draw players into their canvases.
export function draw(some) {
  sheet.draw(some);
}

// Call `player.moment(seconds)` in the next frame, and in those after it while it returns true.
export function wake(player) {
  frame ||= requestAnimationFrame(tick);
  awake.add(player);
}

// A player that fails gets no more frames until something wakes it; the others go on.
function rest(player, error) {
  console.warn(`drapery: ${error.message}`);
  awake.delete(player);
}

function tick(now) {
  const seconds = Math.min(0.1, (now - before) / 1000);
  before = now;
  frame = 0;
  const moved = [...awake];
  for (const player of moved) {
    try {
      if (!players.has(player) || !player.moment(seconds)) awake.delete(player);
    } catch (error) {
      rest(player, error);
    }
  }
  if (awake.size) frame ||= requestAnimationFrame(tick);
  draw(moved.filter((player) => players.has(player)));
}

// Pages are zoomed and move to other screens.
function watchPixels() {
  const watched = matchMedia(`(resolution: ${devicePixelRatio}dppx)`);
  const change = () => {
    players.forEach(wake);
    watchPixels();
  };
  watched.addEventListener("change", change, { once: true });
}

// The names of the scenes that the page holds itself.
export function scenesInPage() {
  const names = [...document.querySelectorAll("script[data-drapery]")].map(({ dataset }) => dataset.drapery);
  return names.map((name) => name.replace(/\.bin$/, ""));
}

// The bytes of a script of the page with this name, or of a file of the package, which are
// compressed there; the same object for the same name.
export function fileBytes(name) {
  if (!files.has(name)) {
    const reading = readFile(name);
    files.set(name, reading);
    reading.catch(() => files.delete(name)); // the next element tries again
  }
  return files.get(name);
}

async function readFile(name) {
  const inPage = document.querySelector(`script[data-drapery="${CSS.escape(name)}"]`);
  const place = inPage?.textContent.trim() ?? PLACES[name];
  if (!place) throw new Error(`${name} is not among the files of this page or module`);
  const answer =
    typeof place === "string" ? new Response(Uint8Array.from(atob(place), (each) => each.charCodeAt(0))) : await fetch(place());
  if (!answer.ok) throw new Error(`${name}: the server answers ${answer.status}; put the files of the package beside the module`);
  const plain = answer.body.pipeThrough(new DecompressionStream("gzip"));
  return new Uint8Array(await new Response(plain).arrayBuffer());
}
