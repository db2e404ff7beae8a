// A field for files: choose them, or drop them on it. Each is sent as the plain body of a POST.
export default {
  template: `
    <div :class="['file-field', { 'file-field-over': over }]"
         @dragover.prevent="over = true" @dragleave="over = false" @drop.prevent="drop">
      <label class="file-field-label">
        <input type="file" class="file-field-input unseen" :accept="accept" :multiple="multiple"
               :disabled="busy" @change="choose" />
        <span>{{ busy ? sending : label }}</span>
      </label>
      <progress v-if="busy" class="file-field-progress" max="1" :value="share"
                :aria-label="sending"></progress>
      <button v-if="busy" type="button" class="button" @click="request?.abort()">{{ stop }}</button>
    </div>`,
  props: {
    address: String, label: String, sends: String, stop: String, accept: String, multiple: Boolean, maxBytes: Number,
    // The tab that opens when a file with such an ending is dropped elsewhere on the page. A field
    // for all endings gets what no other one takes.
    tab: String,
    // A selector: files with such an ending that are dropped there are for this field alone.
    zone: String,
  },
  data() {
    return { over: false, busy: false, share: 0, sending: "" };
  },
  mounted() {
    if (!this.tab && !this.zone) return;
    this.catch = (event) => this.catches(event);
    document.addEventListener("drop", this.catch, !!this.accept);
  },
  beforeUnmount() {
    if (this.catch) document.removeEventListener("drop", this.catch, !!this.accept);
  },
  methods: {
    catches(event) {
      const files = [...(event.dataTransfer?.files ?? [])];
      const endings = this.accept.split(",").filter((each) => each.startsWith("."));
      const fits = (file) => !this.accept || endings.some((each) => file.name.toLowerCase().endsWith(each));
      const wanted = files.filter(fits);
      if (!wanted.length || event.target.closest?.(".file-field")) return;
      if (this.zone && !event.target.closest?.(this.zone)) return;
      event.preventDefault();
      event.stopImmediatePropagation();
      if (this.tab) window.studio?.tab(this.tab);
      this.send(wanted);
    },
    choose(event) {
      const files = [...event.target.files];
      event.target.value = "";
      this.send(files);
    },
    drop(event) {
      this.over = false;
      this.send([...event.dataTransfer.files]);
    },
    send(files) {
      this.last = (this.last ?? Promise.resolve()).then(() => this.sendAll(files));
    },
    async sendAll(files) {
      this.busy = true;
      for (const file of this.multiple ? files : files.slice(0, 1)) this.$emit("sent", await this.post(file));
      this.busy = false;
    },
    post(file) {
      const name = file.name.slice(0, 200);
      if (file.size > this.maxBytes) {
        return { line: `${name} is over ${Math.floor(this.maxBytes / 1048576)} MiB; send a smaller one` };
      }
      this.sending = this.sends.replace("{name}", () => name);
      this.share = 0;
      return new Promise((resolve) => {
        const request = (this.request = new XMLHttpRequest());
        request.open("POST", `${this.address}?name=${encodeURIComponent(name)}`);
        request.upload.onprogress = (event) => (this.share = event.loaded / (event.total || 1));
        request.onload = () => resolve(answer(request.responseText, name));
        request.onabort = () => resolve({ line: `${name} was not sent` });
        request.onerror = () => resolve({ line: `${name} could not be sent; send it again` });
        request.send(file);
      });
    },
  },
};

function answer(text, name) {
  try {
    return JSON.parse(text);
  } catch {
    return { line: `${name} could not be sent; reload the page` };
  }
}
