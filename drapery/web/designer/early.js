// What is dropped or pasted before the module of the designer has come: the page gives it to the designer then. A
// browser leaves the page for a dropped file that nobody takes. It runs before the page is shown, so it is no module.
(() => {
  const name = "drapery-designer";
  /** @type {(() => Event)[]} */
  const kept = [];
  const stop = new AbortController();

  /** @type {(data: DataTransfer | null) => DataTransfer} */
  const copied = (data) => {
    const copy = new DataTransfer(); // an event loses its own with its end
    for (const file of data?.files ?? []) copy.items.add(file);
    copy.setData("text/plain", data?.getData("text/plain") ?? "");
    return copy;
  };
  const more = { bubbles: true, cancelable: true };
  const listen = (/** @type {"dragover" | "drop" | "paste"} */ type, /** @type {(event: any) => unknown} */ act) => addEventListener(type, act, { signal: stop.signal });

  listen("dragover", (event) => event.preventDefault());
  listen("drop", (event) => {
    event.preventDefault();
    const dataTransfer = copied(event.dataTransfer);
    kept.push(() => new DragEvent("drop", { dataTransfer, ...more }));
  });
  listen("paste", (event) => {
    const clipboardData = copied(event.clipboardData);
    kept.push(() => new ClipboardEvent("paste", { clipboardData, ...more }));
  });
  customElements.whenDefined(name).then(() => {
    stop.abort();
    kept.forEach((make) => document.querySelector(name)?.dispatchEvent(make()));
  });
})();
