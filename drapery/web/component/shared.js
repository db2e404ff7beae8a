// What all elements of a page share: one WebGL context, one clock, and each file only once.

export const players = new Set();
const awake = new Set(); // the players that want the next frame
const files = new Map();
let gl = null;
let before = 0;

// The context that draws for all elements. Throws an Error where there is no WebGL 2.
export function sharedContext() {
  if (gl) return gl;
  const canvas = document.createElement("canvas");
  gl = canvas.getContext("webgl2", { alpha: true, antialias: false, premultipliedAlpha: true });
  if (!gl) throw new Error("WebGL 2 is missing");
  canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
  canvas.addEventListener("webglcontextrestored", () => players.forEach((player) => player.restore()));
  return gl;
}

// Call `player.moment(seconds)` in the next frame, and in those after it while it returns true.
export function wake(player) {
  if (!awake.size) requestAnimationFrame(tick);
  awake.add(player);
}

function tick(now) {
  const seconds = Math.min(0.1, (now - before) / 1000);
  before = now;
  for (const player of awake) {
    let goesOn = false;
    try {
      goesOn = players.has(player) && player.moment(seconds);
    } catch (error) {
      console.warn(`drapery: ${error.message}`); // the other players go on
    }
    if (!goesOn) awake.delete(player);
  }
  if (awake.size) requestAnimationFrame(tick);
}

// The bytes of a script of the page with this name, or of a file beside this module, which are
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
  const answer = inPage
    ? new Response(Uint8Array.from(atob(inPage.textContent.trim()), (each) => each.charCodeAt(0)))
    : await fetch(new URL(name, import.meta.url));
  if (!answer.ok) throw new Error(`${name}: the server answers ${answer.status}`);
  const plain = answer.body.pipeThrough(new DecompressionStream("gzip"));
  return new Uint8Array(await new Response(plain).arrayBuffer());
}
