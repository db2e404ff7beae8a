// The report of failed pictures: how they are shown, and what is decided about each.
"use strict";

const sections = [...document.querySelectorAll("section")];
const modes = [...document.querySelectorAll("[name=mode]")];
const still = matchMedia("(prefers-reduced-motion: reduce)");
const PERIOD = 700; // of blinking [ms]
const WIDTH = 256; // of small pictures on the page, about [CSS pixels]
let current = -1;

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
  section.querySelector("[type=range]")?.addEventListener("input", (event) => {
    section.style.setProperty("--split", `${event.target.value}%`);
  });
});
for (const image of document.images) {
  image.decode().then(() => {
    image.width = image.naturalWidth * Math.max(1, Math.round(WIDTH / image.naturalWidth));
  });
}
for (const each of modes) each.addEventListener("change", () => show(each.value));
document.getElementById("save").addEventListener("click", save);
setInterval(() => {
  if (!still.matches) document.body.classList.toggle("before");
}, PERIOD);
show("all");
