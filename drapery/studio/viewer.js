export default {
  template: `
    <div class="viewer" :data-rate="rate" :data-ready="ready">
      <div ref="host" class="viewer-host" tabindex="0" role="application" :aria-label="label"></div>
      <img v-if="picture" class="viewer-picture" :src="picture" alt="">
      <div v-show="wind" class="viewer-wind" role="img" :aria-label="windText">
        <svg viewBox="-10 -10 20 20" :style="arrow" aria-hidden="true"><path d="M0 -8 L5 3 L0 0.5 L-5 3 Z" /></svg>
        <span>{{ windText }}</span>
      </div>
      <div v-show="rate" class="viewer-rate" aria-hidden="true">{{ rate }} {{ words[1] }}</div>
      <p v-show="line" class="viewer-line" role="alert">{{ line }}</p>
    </div>`,
  props: { module: String, shown: Object, label: String, words: Array },
  emits: ["switch", "wind", "stopped", "still"],
  data() {
    return { line: "", rate: null, wind: null, azimuth: 0, picture: null, ready: false };
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
  watch: {
    shown(state) {
      this.$el.viewer?.show(state);
    },
  },
  async mounted() {
    const { LiveViewer } = await import(new URL(this.module, location.href));
    if (!this.$refs.host) return; // the page has gone
    const emit = (name, value) => this.$emit(name, value);
    // Not in Vue's data, because Vue would wrap everything in the viewer in proxies.
    this.$el.viewer = LiveViewer.at(this.$refs.host, (told) => this.update(told), emit);
    this.$el.viewer.show(this.shown);
  },
  beforeUnmount() {
    this.$el.viewer?.end();
  },
  methods: {
    update({ azimuth = this.azimuth, wind = this.wind, ...told }) {
      Object.assign(this, told);
      if (String(wind) !== String(this.wind)) this.wind = wind;
      if (Math.abs(azimuth - this.azimuth) > 0.5) this.azimuth = azimuth;
      this.ready ||= Boolean(wind || this.picture);
    },
  },
};
