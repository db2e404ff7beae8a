// All patterns in the chosen dyes: cells of one picture.
const UNLIKE = 9;
const HOVER = 80; // How long the pointer rests on a pattern before it is shown [ms].

// How well a pattern fits the words: 0 is the best, UNLIKE does not fit.
function rank(pattern, wanted) {
  const title = pattern.title.toLowerCase();
  const words = pattern.words.toLowerCase();
  const ofWord = (word) => {
    if (words.split(" ").includes(word)) return title.includes(word) ? 0 : 1;
    if (` ${title} ${words}`.includes(` ${word}`)) return 2;
    return `${title} ${words}`.includes(word) ? 3 : UNLIKE;
  };
  return Math.max(...wanted.map(ofWord));
}

export default {
  template: `
    <div class="patterns">
      <div class="patterns-head">
        <input v-model="wanted" type="search" class="field" :placeholder="words.find + '  ( / )'"
          :aria-label="words.find" @keydown.enter="first" @keydown.esc="leave">
        <div v-if="canSwap" class="segments" role="group" :aria-label="words.what">
          <button type="button" :aria-pressed="!swaps" @click="$emit('swaps', false)">{{ words.add }}</button>
          <button type="button" :aria-pressed="swaps" @click="$emit('swaps', true)">{{ words.change }}</button>
        </div>
      </div>
      <div class="pattern-grid" role="group" :aria-label="label"
        :style="{ '--sheet': 'url(' + sheet + ')', '--count': patterns.length }">
        <button v-for="(pattern, index) in found" :key="pattern.name" type="button" class="pattern"
          :data-pattern="pattern.name" :aria-label="pattern.title" :title="pattern.title"
          :tabindex="index === at ? 0 : -1" :aria-pressed="swaps ? pattern.name === current : null"
          @focus="at = index; preview(pattern.name)" @blur="preview('')" @click="lay(pattern.name)"
          @pointerenter="preview(pattern.name, $event)" @pointerleave="preview('')">
          <span class="cell" :style="{ '--index': pattern.index }"></span>
          <span class="pattern-title" aria-hidden="true">{{ pattern.title }}</span>
        </button>
      </div>
      <p v-if="!found.length" class="hint">{{ words.nothing }}</p>
      <p class="sr" role="status">{{ wanted ? words.count.replace('{count}', found.length) : '' }}</p>
    </div>`,
  props: {
    patterns: Array, sheet: String, label: String, swaps: Boolean, canSwap: Boolean, current: String, words: Object,
  },
  emits: ["pattern", "preview", "swaps"],
  data: () => ({ wanted: "", at: 0 }),
  computed: {
    found() {
      const wanted = this.wanted.toLowerCase().replaceAll("_", " ").split(" ").filter(Boolean);
      const all = this.patterns.map((pattern, index) => ({ ...pattern, index }));
      if (!wanted.length) return all;
      const found = all.map((pattern) => ({ ...pattern, rank: rank(pattern, wanted) }));
      return found.filter((pattern) => pattern.rank < UNLIKE).sort((a, b) => a.rank - b.rank);
    },
  },
  watch: {
    wanted() {
      this.at = 0;
      this.preview(""); // a pattern that is not found any more gets no event of the pointer
    },
  },
  methods: {
    first(event) {
      event.preventDefault();
      if (this.found.length) this.lay(this.found[0].name);
    },
    lay(name) {
      this.preview("");
      this.$emit("pattern", name);
    },
    // Show the flat face with this pattern while the pointer or the focus is on it.
    preview(name, event) {
      if (event?.pointerType === "touch") return;
      clearTimeout(this.waiting);
      this.waiting = setTimeout(() => this.$emit("preview", name), name ? HOVER : 0);
    },
    leave(event) {
      event.stopPropagation();
      if (this.wanted) this.wanted = "";
      else event.target.blur();
    },
  },
};
