// The sixteen dyes, one of them marked.
export default {
  template: `
    <div>
      <h2 class="heading">{{ heading }}</h2>
      <div class="dyes" role="radiogroup" :aria-label="heading">
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
};
