// Search where the site is read from files: browsers start no worker from there, so a hidden frame
// runs the worker's script. The name is what the plugin `offline` looks for; without this file it
// would load such a script from another site.
"use strict";

class FrameWorker extends EventTarget {
  #waiting = [];
  #scope = null;

  constructor(address) {
    super();
    const frame = document.createElement("iframe");
    frame.hidden = true;
    frame.addEventListener("load", () => this.#start(frame.contentWindow, address), { once: true });
    document.body.append(frame);
  }

  postMessage(data) {
    if (this.#scope === null) this.#waiting.push(data);
    else this.#scope.dispatchEvent(new this.#scope.MessageEvent("message", { data }));
  }

  async #start(scope, address) {
    scope.postMessage = (data) => this.dispatchEvent(new MessageEvent("message", { data }));
    scope.importScripts = async (...addresses) => {
      for (const each of addresses) await addScript(scope.document, each);
    };
    await addScript(scope.document, address);
    this.#scope = scope;
    this.#waiting.forEach((data) => this.postMessage(data));
  }
}

function addScript(page, address) {
  return new Promise((resolve, reject) => {
    const script = page.createElement("script");
    script.src = new URL(address, document.baseURI);
    script.addEventListener("load", resolve);
    script.addEventListener("error", reject);
    page.head.append(script);
  });
}

if (location.protocol === "file:") window.Worker = FrameWorker;
