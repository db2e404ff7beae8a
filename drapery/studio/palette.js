// The sixteen dyes, one of them marked. Arrow keys move from dye to dye.
export default {
  template: `
    <div>
      <h2 class="heading">{{ heading }}</h2>
      <div class="dyes" role="radiogroup" :aria-label="heading" @keydown="key">
        <button v-for="dye in dyes" :key="dye.name" type="button" role="radio" class="dye"
          :data-dye="dye.name" :aria-checked="dye.name === chosen" :aria-label="dye.title"
          :title="dye.title" :tabindex="dye.name === chosen ? 0 : -1"
          :style="{ backgroundColor: dye.colour, color: dye.ink }"
          @click="$emit('dye', dye.name)">
          <span v-if="dye.name === chosen" aria-hidden="true">✓</span>
        </button>
      </div>
    </div>`,
  props: { dyes: Array, chosen: String, heading: String },
  emits: ["dye"],
  methods: {
    key(event) {
      const columns = 8;
      const step = { ArrowRight: 1, ArrowLeft: -1, ArrowDown: columns, ArrowUp: -columns }[event.key];
      if (!step || event.altKey || event.ctrlKey || event.metaKey) return;
      event.preventDefault();
      event.stopPropagation();
      const buttons = [...this.$el.querySelectorAll("button")];
      const here = buttons.indexOf(document.activeElement);
      const next = buttons[(here + step + buttons.length) % buttons.length];
      next.focus();
      this.$emit("dye", next.dataset.dye);
    },
  },
};
