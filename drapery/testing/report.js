// The report of failed pictures: how they are shown, and what is decided about each.
"use strict";

const sections = [...document.querySelectorAll("section")];
const modes = [...document.querySelectorAll("[name=mode]")];
const still = matchMedia("(prefers-reduced-motion: reduce)");
const PERIOD = 700; // of blinking [ms]
const WIDTH = 256; // of small pictures on the page, about [CSS pixels]
const loops = new Map(); // the loops of each section, each a sheet of frames and its canvas
let current = -1;
let playing = false;

function show(mode) {
  document.body.dataset.mode = mode;
  for (const each of modes) each.checked = each.value === mode;
}

function go(step) {
  current = Math.min(Math.max(current + step, 0), sections.length - 1);
  sections[current].focus();
  sections[current].scrollIntoView({ block: "start" });
}

function decide(section, decision) {
  const same = section.classList.contains(decision);
  section.classList.remove("accepted", "rejected");
  if (!same) section.classList.add(decision);
  for (const button of section.querySelectorAll("[data-decision]")) {
    button.ariaPressed = String(section.classList.contains(button.dataset.decision));
  }
  const { accepted, rejected } = decisions();
  document.getElementById("count").value =
    `${accepted.length} accepted, ${rejected.length} rejected`;
}

function decisions() {
  const of = (name) => sections.filter((s) => s.classList.contains(name)).map((s) => s.id);
  return { accepted: of("accepted"), rejected: of("rejected") };
}

function save() {
  const text = JSON.stringify(decisions(), null, 2);
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([text], { type: "application/json" }));
  link.download = "approvals.json";
  link.click();
  URL.revokeObjectURL(link.href);
}

// Replace the sheet of a loop by a canvas that shows one of its frames.
function addLoop(sheet) {
  const section = sheet.closest("section");
  const columns = Number(sheet.dataset.columns);
  const frames = Number(sheet.dataset.frames);
  const canvas = document.createElement("canvas");
  canvas.width = sheet.naturalWidth / columns;
  canvas.height = sheet.naturalHeight / Math.ceil(frames / columns);
  canvas.style.width = `${shownWidth(canvas.width)}px`;
  canvas.role = "img";
  canvas.ariaLabel = sheet.alt;
  sheet.replaceWith(canvas);
  const loop = { sheet, canvas, columns, frames, fps: Number(sheet.dataset.fps) };
  loops.set(section, [...loops.get(section) ?? [], loop]);
  showFrame(section, Number(section.querySelector(".frame").value));
}

// All loops of a section show the same frame; a shorter one begins again.
function showFrame(section, frame) {
  for (const { sheet, canvas, columns, frames } of loops.get(section) ?? []) {
    const at = frame % frames;
    const { width, height } = canvas;
    const context = canvas.getContext("2d");
    context.clearRect(0, 0, width, height);
    const left = at % columns * width;
    context.drawImage(sheet, left, Math.floor(at / columns) * height, width, height, 0, 0, width, height);
  }
  const range = section.querySelector(".frame");
  range.value = frame;
  range.parentElement.nextElementSibling.value = frame + 1;
}

function play(on) {
  playing = on;
  const button = document.getElementById("play");
  if (button) button.ariaPressed = String(on);
  if (on) requestAnimationFrame(advance);
}

function advance(milliseconds) {
  if (!playing) return;
  for (const [section, [{ frames, fps }]] of loops) {
    const { top, bottom } = section.getBoundingClientRect();
    if (bottom > 0 && top < innerHeight) {
      showFrame(section, Math.floor(milliseconds / 1000 * fps) % frames);
    }
  }
  requestAnimationFrame(advance);
}

function step(by) {
  const section = sections[Math.max(current, 0)];
  const range = section.querySelector(".frame");
  if (!range) return;
  play(false);
  const count = Number(range.max) + 1;
  showFrame(section, (Number(range.value) + by + count) % count);
}

function shownWidth(width) {
  return width * Math.max(1, Math.round(WIDTH / width));
}

const actions = {
  1: () => show("all"),
  2: () => show("slider"),
  3: () => show("blink"),
  b: () => document.body.classList.toggle("before"),
  j: () => go(1),
  k: () => go(-1),
  a: () => current >= 0 && decide(sections[current], "accepted"),
  r: () => current >= 0 && decide(sections[current], "rejected"),
  s: save,
  p: () => play(!playing),
  ",": () => step(-1),
  ".": () => step(1),
};

document.addEventListener("keydown", (event) => {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  const action = actions[event.key.toLowerCase()];
  if (!action) return;
  event.preventDefault();
  action();
});
sections.forEach((section, number) => {
  section.addEventListener("focusin", () => { current = number; });
  section.addEventListener("click", (event) => {
    current = number;
    const { decision } = event.target.dataset;
    if (decision) decide(section, decision);
  });
  section.querySelector(".split input")?.addEventListener("input", (event) => {
    section.style.setProperty("--split", `${event.target.value}%`);
  });
  section.querySelector(".frame")?.addEventListener("input", (event) => {
    play(false);
    showFrame(section, Number(event.target.value));
  });
});
for (const image of [...document.images]) {
  image.decode().then(() => {
    if (image.dataset.frames) addLoop(image);
    else image.width = shownWidth(image.naturalWidth);
  });
}
document.getElementById("play")?.addEventListener("click", () => play(!playing));
for (const each of modes) each.addEventListener("change", () => show(each.value));
document.getElementById("save").addEventListener("click", save);
setInterval(() => {
  if (!still.matches) document.body.classList.toggle("before");
}, PERIOD);
show("all");
play(!still.matches && document.getElementById("play") !== null);
