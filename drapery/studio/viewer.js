import { Viewer } from "drapery-viewer";

export default {
  template: `
    <div class="viewer" :data-rate="rate" :data-ready="ready">
      <canvas ref="canvas" class="viewer-canvas" tabindex="0" role="application" :aria-label="label"></canvas>
      <div ref="labels" class="viewer-labels" aria-hidden="true"></div>
      <div v-show="wind" class="viewer-wind" role="img" :aria-label="windText">
        <svg viewBox="-10 -10 20 20" :style="arrow" aria-hidden="true"><path d="M0 -8 L5 3 L0 0.5 L-5 3 Z" /></svg>
        <span>{{ windText }}</span>
      </div>
      <div v-show="rate" class="viewer-rate" aria-hidden="true">{{ rate }} {{ words[1] }}</div>
      <p v-show="line" class="viewer-line" role="alert">{{ line }}</p>
    </div>`,
  props: { address: String, label: String, words: Array },
  data() {
    return { line: "", rate: null, wind: null, azimuth: 0, ready: false };
  },
  computed: {
    windText() {
      if (!this.wind) return "";
      return this.wind[2] ? `${this.wind[0].toFixed(1)} m/s` : this.words[0];
    },
    arrow() {
      if (!this.wind) return {};
      return { transform: `rotate(${this.azimuth + 180 - this.wind[1]}deg)`, opacity: this.wind[2] ? 1 : 0.25 };
    },
  },
  mounted() {
    const address = new URL(this.address, location.href).href.replace("http", "ws");
    const onStatus = (line) => (this.line = line);
    const onState = (state) => this.update(state);
    try {
      // Not in Vue's data, because Vue would wrap everything in the viewer in proxies.
      this.$el.viewer = new Viewer(this.$refs.canvas, this.$refs.labels, address, onStatus, onState);
    } catch (error) {
      onStatus(`The live cloth cannot be drawn: ${error.message}`);
    }
  },
  beforeUnmount() {
    this.$el.viewer?.end();
  },
  methods: {
    update({ wind, azimuth, rate }) {
      if (rate !== undefined) this.rate = rate;
      else if (!this.ready) this.ready = true;
      if (wind === undefined) return;
      if (String(wind) !== String(this.wind)) this.wind = wind;
      if (azimuth !== undefined && Math.abs(azimuth - this.azimuth) > 0.5) this.azimuth = azimuth;
    },
    snapshot() {
      return this.$el.viewer.snapshot();
    },
  },
};
