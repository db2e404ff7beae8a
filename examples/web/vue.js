import { createApp, ref } from "vue/dist/vue.esm-bundler.js";
import "drapery-banner";

const app = createApp({
  setup: () => ({ design: ref("white creeper:lime"), status: ref("Loading") }),
  template: `
    <main>
      <h1>A banner of live cloth</h1>
      <label>Design <input v-model="design"></label>
      <p role="status">{{ status }}</p>
      <drapery-banner :design="design" wind="4"
        @drapery-ready="status = 'Ready'" @drapery-error="status = $event.detail"></drapery-banner>
    </main>`,
});
app.config.compilerOptions.isCustomElement = (tag) => tag.startsWith("drapery-");
app.mount(document.body.appendChild(document.createElement("div")));
