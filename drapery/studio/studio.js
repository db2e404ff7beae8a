// What the page does without the server: tabs, theme, shortcuts, copying, dropped files.
const WIDE = window.matchMedia("(min-width: 1000px)");
const root = () => document.querySelector(".studio");

const studio = (window.studio = {
  get ready() {
    return !!(root() && window.socket?.connected);
  },
  copy,
  tab,
  writeAddress,
});

// The latest designs of this browser, so that a closed tab loses none. name: one for each design.
const RECENT = "drapery-recent";
const MAX_RECENT = 12;

function recent() {
  try {
    const found = JSON.parse(localStorage.getItem(RECENT));
    return Array.isArray(found) ? found : [];
  } catch {
    return [];
  }
}

function remember(name, link) {
  const others = recent().filter((each) => each.name !== name && each.link !== link);
  try {
    localStorage.setItem(RECENT, JSON.stringify([{ name, link }, ...others].slice(0, MAX_RECENT)));
  } catch {
    // Without storage there are none.
  }
}

// The design in the address. Browsers limit the changes per second, so repeat the last one later.
// name: "" for a design that is not worth remembering.
let addressTimer;
function writeAddress(link, name) {
  if (name) remember(name, link);
  const write = () => history.replaceState({ session: root().dataset.token }, "", `?d=${link}`);
  clearTimeout(addressTimer);
  addressTimer = setTimeout(write, 500);
  try {
    write();
  } catch {
    // Too many changes: the timer writes the last one.
  }
}

// Tabs. On a wide window the panels at the left and below the viewport are always visible.
function tab(name) {
  for (const each of document.querySelectorAll(".tab")) {
    const chosen = each.dataset.panel === name;
    each.setAttribute("aria-selected", chosen);
    each.tabIndex = chosen ? 0 : -1;
    document.getElementById(each.dataset.panel && `panel-${each.dataset.panel}`)?.toggleAttribute("data-active", chosen);
  }
}

function visibleTabs() {
  return [...document.querySelectorAll(".tab")].filter((each) => each.offsetParent);
}

WIDE.addEventListener("change", () => {
  const chosen = document.querySelector('.tab[aria-selected="true"]');
  if (!chosen?.offsetParent && visibleTabs().length) tab(visibleTabs()[0].dataset.panel);
});

// Theme: follows the system until the user chooses one.
function theme(choice) {
  window.Quasar?.Dark.set(choice === "dark" ? true : choice === "light" ? false : "auto");
}

function toggleTheme() {
  const choice = document.body.classList.contains("body--dark") ? "light" : "dark";
  try {
    localStorage.setItem("drapery-theme", choice);
  } catch {
    // Without storage the choice lasts as long as the page.
  }
  theme(choice);
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
  n: "new", r: "random", b: "kind", m: "mode", h: "hide", delete: "remove", backspace: "remove",
  "alt+arrowup": "up", "alt+arrowdown": "down", escape: "none",
};

function typing(target) {
  return target.closest?.("input:not([type=range], [type=checkbox], [type=radio]), textarea, select, [contenteditable=true], [role=combobox], [role=listbox]");
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
  if (typing(event.target) || document.querySelector(".q-dialog, .q-menu")) return;
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

document.addEventListener("keydown", (event) => {
  const here = event.target.closest?.(".tab");
  const step = { ArrowRight: 1, ArrowLeft: -1, ArrowDown: 1, ArrowUp: -1 }[event.key];
  if (!here || !step) return;
  const tabs = visibleTabs();
  const next = tabs[(tabs.indexOf(here) + step + tabs.length) % tabs.length];
  tab(next.dataset.panel);
  next.focus();
  event.preventDefault();
  event.stopPropagation();
});

document.addEventListener("click", (event) => {
  const pressed = (kind) => event.target.closest?.(kind);
  const copying = pressed("[data-copy]");
  if (copying) copy(document.getElementById(copying.dataset.copy).value, copying);
  else if (pressed(".tab")) tab(pressed(".tab").dataset.panel);
  else if (pressed(".theme")) toggleTheme();
  else if (pressed(".help")) document.getElementById("shortcuts").showModal();
  else if (pressed("#shortcuts .button") || event.target.id === "shortcuts") document.getElementById("shortcuts").close();
});

// A design pasted anywhere, or dropped as a file.
document.addEventListener("paste", (event) => {
  if (typing(event.target)) return;
  const text = event.clipboardData.getData("text/plain");
  if (text.trim()) root()?.dispatchEvent(new CustomEvent("pasted", { detail: text }));
});

async function send(file) {
  const response = await fetch(`/designs/${root().dataset.token}?name=${encodeURIComponent(file.name.slice(-80))}`, { method: "POST", body: file });
  if (!response.ok) throw new Error(await response.text());
}

studio.readFile = async (file) => {
  try {
    await send(file);
  } catch {
    window.Quasar?.Notify.create({ type: "negative", position: "bottom", message: `${file.name}: it could not be sent; check that the studio is running` });
  }
};

const hasOwnField = (event) => event.target.closest?.(".file-field, .q-uploader");
const holdsFiles = (event) => event.dataTransfer?.types.includes("Files");

document.addEventListener("dragover", (event) => {
  if (!holdsFiles(event)) return;
  event.preventDefault();
  document.body.classList.toggle("dropping", !hasOwnField(event));
});
document.addEventListener("dragleave", (event) => {
  if (!event.relatedTarget) document.body.classList.remove("dropping");
});
document.addEventListener("drop", (event) => {
  document.body.classList.remove("dropping");
  if (!holdsFiles(event) || hasOwnField(event)) return;
  event.preventDefault();
  const file = event.dataTransfer.files[0];
  if (file) studio.readFile(file);
});
document.addEventListener("change", (event) => {
  if (event.target.id !== "design-file" || !event.target.files[0]) return;
  studio.readFile(event.target.files[0]);
  event.target.value = "";
});

// Wait for the page's elements: they are created shortly after this script runs.
new MutationObserver((_, observer) => {
  if (!root() || !window.Quasar) return;
  observer.disconnect();
  if (root().dataset.language !== "en") document.documentElement.lang = root().dataset.language;
  let stored = null;
  try {
    stored = localStorage.getItem("drapery-theme");
  } catch {
    // Without storage the system's theme is used.
  }
  if (stored) setTimeout(() => theme(stored));
  resume();
}).observe(document.documentElement, { childList: true, subtree: true });

// Two pictures, one over the other: a slider says where one ends and the other begins.
document.addEventListener("input", (event) => {
  const box = event.target.closest?.(".versus-slider");
  box?.style.setProperty("--cut", `${event.target.value}%`);
});

// A page that is loaded again goes on from its earlier session, which the browser's history names.
function resume() {
  const earlier = history.state?.session;
  history.replaceState({ session: root().dataset.token }, "");
  const waiting = setInterval(() => {
    if (!studio.ready) return;
    clearInterval(waiting);
    if (earlier) root().dispatchEvent(new CustomEvent("resume", { detail: earlier }));
    root().dispatchEvent(new CustomEvent("recent", { detail: recent().map((each) => each.link) }));
  }, 30);
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
