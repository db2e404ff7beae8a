// What the page does without the server: tabs, theme, shortcuts, copying, dropped files.

import { kept } from "../web/designer/storage.js";

const WIDE = window.matchMedia("(min-width: 1000px)");
const FIELDS = "input:not([type=range], [type=checkbox], [type=radio]), textarea, select, [contenteditable=true], [role=combobox], [role=listbox]";
const root = () => document.querySelector(".studio");

const studio = (window.studio = {
  get ready() {
    return !!(root()?.dataset.whole && window.socket?.connected && document.querySelector(".part-dyes .dye"));
  },
  copy,
  tab,
  writeAddress,
  isTaken,
  earlier: earlierSession(),
  whole: () => whole,
});

// Of the page that was loaded before at this place of the history. An address that is written while the page is
// loaded again costs the place its state: then the work that the tab has kept says it.
function earlierSession() {
  const [{ type }] = performance.getEntriesByType("navigation");
  return kept(() => history.state?.session ?? (type === "reload" && JSON.parse(sessionStorage.getItem("drapery-history"))?.token));
}

// Tell the server, in order, once the whole page is there.
const whole = new Promise((resolve) => {
  const waiting = setInterval(() => {
    if (!studio.ready) return;
    clearInterval(waiting);
    resolve();
  }, 30);
});

async function tell(name, detail) {
  await whole;
  root().dispatchEvent(new CustomEvent(name, { detail }));
}

// What this browser remembers. Without storage, it lasts as long as the page.
const store = {
  get: (name) => kept(() => JSON.parse(localStorage.getItem(`drapery-${name}`))),
  set: (name, value) => kept(() => localStorage.setItem(`drapery-${name}`, JSON.stringify(value))),
};

// The latest designs of this browser, so that a closed tab loses none. name: one for each design.
const recent = () => [store.get("recent") ?? []].flat();

function remember(name, link) {
  const others = recent().filter((each) => each.name !== name && each.link !== link);
  store.set("recent", [{ name, link }, ...others].slice(0, root().dataset.recent));
}

// The design in the address. Browsers limit the changes per second, so repeat the last one later.
// name: "" for a design that is not worth remembering.
let addressTimer;
function writeAddress(link, name) {
  if (name) remember(name, link);
  const write = () => history.replaceState({ session: root().dataset.token }, "", `?d=${link}`);
  clearTimeout(addressTimer);
  addressTimer = setTimeout(write, 500);
  kept(write); // after too many changes, the timer writes the last one
}

// Tabs, in groups. On a wide window the panels at the left and below the viewport are always visible.
function tab(name) {
  const chosen = document.getElementById(`tab-${name}`);
  const list = chosen.parentElement;
  for (const each of document.querySelectorAll(".groups > *, .tabs-of > *")) {
    const target = document.getElementById(each.getAttribute("aria-controls"));
    const isChosen = each === chosen || target === list;
    const isGroup = each.matches(".group");
    each.setAttribute("aria-selected", isChosen);
    if (isGroup || each.parentElement === list) each.tabIndex = isChosen ? 0 : -1;
    if (isGroup) target.hidden = !isChosen;
    else target.toggleAttribute("data-active", isChosen);
  }
}

// Open what was chosen last of a list of tabs, if it is there at this width.
function openTabs(list) {
  list.hidden = false;
  const seen = [...list.children].filter((each) => each.offsetParent);
  tab((seen.find((each) => !each.tabIndex) ?? seen[0]).dataset.panel);
}

WIDE.addEventListener("change", () => openTabs(document.querySelector(".tabs-of:not([hidden])")));

// The theme follows the system until the user chooses one.
function toggleTheme() {
  const isDark = !document.body.classList.contains("body--dark");
  store.set("dark", isDark);
  window.Quasar.Dark.set(isDark);
}

// Copying. Browsers provide the clipboard only over https or on localhost.
async function copy(text, from) {
  try {
    await navigator.clipboard.writeText(text);
  } catch {
    const area = Object.assign(document.createElement("textarea"), { value: text });
    document.body.append(area);
    area.select();
    document.execCommand("copy");
    area.remove();
  }
  if (!from) return;
  const label = from.querySelector(".copy-label") ?? from;
  const before = (label.dataset.before ??= label.textContent);
  label.textContent = root().dataset.copied;
  setTimeout(() => (label.textContent = before), 1500);
}

// Shortcuts. They work while no field has the focus.
const KEYS = {
  "ctrl+z": "undo", "ctrl+shift+z": "redo", "ctrl+y": "redo", "ctrl+d": "duplicate",
  n: "new", r: "random", b: "kind", h: "hide", delete: "remove", backspace: "remove",
  "alt+arrowup": "up", "alt+arrowdown": "down", escape: "none",
};

// Whether keys are for a field, or for the dialog that is open.
function isTaken(target) {
  return Boolean(target.closest?.(FIELDS) || document.querySelector("dialog[open], .q-dialog"));
}

function act(what) {
  root()?.dispatchEvent(new CustomEvent("act", { detail: what }));
}

window.addEventListener("keydown", (event) => {
  if (event.defaultPrevented || event.isComposing || !root()) return;
  const dialog = document.getElementById("shortcuts");
  if (dialog.open) {
    if (event.key === "Escape" || event.key === "?") {
      dialog.close();
      event.preventDefault();
    }
    return;
  }
  if (isTaken(event.target)) return;
  const name =
    (event.ctrlKey || event.metaKey ? "ctrl+" : "") + (event.altKey ? "alt+" : "") +
    (event.shiftKey && event.ctrlKey ? "shift+" : "") + event.key.toLowerCase();
  if (event.key === "?") dialog.showModal();
  else if (event.key === "/") {
    tab("patterns");
    document.querySelector(".panel-patterns input")?.focus();
  } else if (KEYS[name]) act(KEYS[name]);
  else return;
  event.preventDefault();
});

// Arrow keys walk among tabs and choose them.
document.addEventListener("keydown", (event) => {
  const here = event.target.closest?.("[role=tab]");
  if (!here || event.altKey || event.ctrlKey || event.metaKey) return;
  const all = [...here.parentElement.children].filter((each) => each.offsetParent);
  const at = all.indexOf(here);
  const next = {
    ArrowRight: at + 1, ArrowLeft: at - 1, ArrowDown: at + 1, ArrowUp: at - 1, Home: 0, End: all.length - 1,
  }[event.key];
  if (next === undefined) return;
  const found = all[(next + all.length) % all.length];
  found.focus();
  found.click();
  event.preventDefault();
  event.stopPropagation();
});

document.addEventListener("click", (event) => {
  const pressed = (kind) => event.target.closest?.(kind);
  const copying = pressed("[data-copy]");
  if (copying) copy(document.getElementById(copying.dataset.copy).value, copying);
  else if (pressed("[data-act]")) act(pressed("[data-act]").dataset.act);
  else if (pressed(".tab")) tab(pressed(".tab").dataset.panel);
  else if (pressed(".group")) openTabs(document.getElementById(pressed(".group").getAttribute("aria-controls")));
  else if (pressed(".theme")) toggleTheme();
  else if (pressed(".help")) document.getElementById("shortcuts").showModal();
  else if (pressed("#shortcuts .button") || event.target.id === "shortcuts") document.getElementById("shortcuts").close();
});

// A design pasted anywhere.
document.addEventListener("paste", (event) => {
  if (isTaken(event.target)) return;
  const text = event.clipboardData.getData("text/plain");
  if (text.trim()) tell("pasted", text);
});

// Files may be dropped anywhere: their fields take them.
const hasOwnField = (event) => event.target.closest?.(".file-field");
const holdsFiles = (event) => event.dataTransfer?.types.includes("Files");

document.addEventListener("dragover", (event) => {
  if (!holdsFiles(event)) return;
  event.preventDefault();
  document.body.classList.toggle("dropping", !hasOwnField(event));
});
document.addEventListener("dragleave", (event) => {
  if (!event.relatedTarget) document.body.classList.remove("dropping");
});
window.addEventListener("drop", (event) => {
  document.body.classList.remove("dropping");
  if (!holdsFiles(event)) return;
  event.preventDefault();
  if (!studio.ready) dropAgain(event);
}, true);

// Files that are dropped early are dropped once more when all fields are there; an event loses its own with its end.
async function dropAgain(event) {
  event.stopImmediatePropagation();
  const dataTransfer = new DataTransfer();
  for (const file of event.dataTransfer.files) dataTransfer.items.add(file);
  await whole;
  const target = document.elementFromPoint(event.clientX, event.clientY) ?? document.body;
  target.dispatchEvent(new DragEvent("drop", { dataTransfer, bubbles: true, cancelable: true }));
}

// Wait for the page's elements: they are created shortly after this script runs.
new MutationObserver((_, observer) => {
  if (!root() || !window.Quasar) return;
  observer.disconnect();
  if (root().dataset.language !== "en") document.documentElement.lang = root().dataset.language;
  const isDark = store.get("dark");
  if (isDark !== null) setTimeout(() => window.Quasar.Dark.set(isDark));
  resume();
}).observe(document.documentElement, { childList: true, subtree: true });

// A page that is loaded again goes on from its earlier session, which the browser's history names.
function resume() {
  history.replaceState({ session: root().dataset.token }, "");
  whole.then(followConnection);
  if (studio.earlier) tell("resume", studio.earlier);
  tell("recent", recent().map((each) => each.link));
}

// Without the connection only the design can be edited: of all else the server would not hear.
function followConnection() {
  const [line, more] = document.querySelectorAll("#popup span");
  [line.textContent, more.textContent] = [root().dataset.lost, ""];
  const setInert = (inert) => document.querySelectorAll(".panel:not(:has(.editor))").forEach((each) => (each.inert = inert));
  for (const event of ["connect", "disconnect"]) window.socket.on(event, () => setInert(event === "disconnect"));
}

// A text pasted into the text field is read at once; Ctrl+Enter reads it too.
function readText() {
  const area = document.getElementById("design-text");
  if (area.value.trim()) area.dispatchEvent(new CustomEvent("read", { detail: area.value }));
}
document.addEventListener("paste", (event) => event.target.id === "design-text" && setTimeout(readText));
document.addEventListener("click", (event) => event.target.closest?.("#read-text") && readText());
document.addEventListener("keydown", (event) => {
  if (event.target.id === "design-text" && event.key === "Enter" && (event.ctrlKey || event.metaKey)) readText();
});
