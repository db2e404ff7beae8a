// The layers, topmost first. Drag a row by mouse or finger, or move it by Alt and an arrow key.
const DRAG_START = 4; // The distance that the pointer must move before a drag starts [px].

export default {
  template: `
    <ol class="rows" :aria-label="words.layers" @keydown="key" @focusin="remember">
      <li v-for="row in shown" :key="row.number" class="layer" :data-number="row.number"
        :class="{ chosen: row.number === chosen, concealed: row.hidden, dragged: row.number === dragged }"
        @pointerdown="grab($event, row)">
        <span class="grip" aria-hidden="true" title="Drag to move">⠿</span>
        <button type="button" class="row-main" data-part="main" :aria-pressed="row.number === chosen"
          @click="pick(row)">
          <span class="row-place">{{ row.place + 1 }}</span>
          <span class="cell thumb" :style="{ '--sheet': 'url(' + row.sheet + ')', '--index': row.index, '--count': count }"></span>
          <span class="row-words">
            <span class="row-title">{{ row.title }}</span>
            <span class="row-dye"><i class="dot" :style="{ backgroundColor: row.colour }"></i>{{ row.dyeTitle }}</span>
          </span>
        </button>
        <span class="row-tools">
          <button type="button" class="tool" data-part="hide" :aria-pressed="row.hidden"
            :aria-label="(row.hidden ? words.show : words.hide) + ' ' + row.name" :title="(row.hidden ? words.show : words.hide) + ' (H)'"
            @click="act('hide', row)"><i class="material-icons" aria-hidden="true">{{ row.hidden ? 'visibility_off' : 'visibility' }}</i></button>
          <button type="button" class="tool" data-part="duplicate" :aria-label="words.duplicate + ' ' + row.name"
            :title="words.duplicate + ' (Ctrl+D)'" @click="act('duplicate', row)"><i class="material-icons" aria-hidden="true">content_copy</i></button>
          <button type="button" class="tool" data-part="remove" :aria-label="words.remove + ' ' + row.name"
            :title="words.remove + ' (Delete)'" @click="act('remove', row)"><i class="material-icons" aria-hidden="true">close</i></button>
        </span>
      </li>
      <li class="layer layer-field" :class="{ chosen: chosen === 'field' }" key="field">
        <span class="grip" aria-hidden="true"></span>
        <button type="button" class="row-main" data-part="main" :aria-pressed="chosen === 'field'"
          @click="$emit('choose', 'field')">
          <span class="row-place" aria-hidden="true"></span>
          <span class="thumb" :style="{ backgroundColor: field.colour }"></span>
          <span class="row-words"><span class="row-title">{{ words.field }}</span>
            <span class="row-dye"><i class="dot" :style="{ backgroundColor: field.colour }"></i>{{ field.dyeTitle }}</span></span>
        </button>
      </li>
      <li v-if="!rows.length" class="hint">{{ words.empty }}</li>
    </ol>`,
  props: { rows: Array, field: Object, chosen: [Number, String], count: Number, words: Object },
  emits: ["choose", "act"],
  data: () => ({ order: null, dragged: null }),
  computed: {
    shown() {
      if (!this.order) return this.rows;
      return this.order.map((number) => this.rows.find((row) => row.number === number)).filter(Boolean);
    },
  },
  watch: {
    rows() {
      if (this.dragged === null) this.order = null;
    },
  },
  updated() {
    this.refocus();
  },
  beforeUnmount() {
    this.drop?.(false);
  },
  methods: {
    pick(row) {
      // Ignore the click that ends a drag.
      if (!this.justDragged) this.$emit("choose", row.number);
    },
    act(what, row, place = 0) {
      this.$emit("act", { what, number: row.number, place });
    },
    remember(event) {
      const row = event.target.closest(".layer");
      this.focused = { number: Number(row?.dataset.number), part: event.target.dataset.part, at: this.index(row) };
    },
    index(row) {
      return [...this.$el.children].indexOf(row);
    },
    // A row loses the focus when it moves in the page or is removed.
    refocus() {
      if (!this.focused || document.activeElement !== document.body) return;
      const rows = [...this.$el.children];
      const row = rows.find((each) => Number(each.dataset.number) === this.focused.number);
      const next = row ?? rows[Math.min(this.focused.at, rows.length - 1)];
      (next?.querySelector(`[data-part="${this.focused.part}"]`) ?? next?.querySelector("button"))?.focus();
    },
    key(event) {
      const row = this.rows.find((each) => each.number === Number(event.target.closest(".layer").dataset.number));
      const step = { ArrowUp: 1, ArrowDown: -1 }[event.key];
      if (step && event.altKey && row) this.act("move", row, row.place + step);
      else if (step && !event.ctrlKey && !event.metaKey) this.walk(event.target, -step);
      else if (event.key === "Delete" && row) this.act("remove", row);
      else if (event.key.toLowerCase() === "h" && row && !event.ctrlKey && !event.metaKey) this.act("hide", row);
      else if (event.key.toLowerCase() === "d" && row && (event.ctrlKey || event.metaKey)) this.act("duplicate", row);
      else return;
      event.preventDefault();
      event.stopPropagation();
    },
    walk(target, step) {
      const rows = [...this.$el.children];
      const next = rows[this.index(target.closest(".layer")) + step];
      (next?.querySelector(`[data-part="${target.dataset.part}"]`) ?? next?.querySelector("button"))?.focus();
    },
    grab(event, row) {
      const finger = event.pointerType !== "mouse";
      if (event.button !== 0 || event.target.closest(".tool")) return;
      if (finger && !event.target.closest(".grip")) return;
      const from = event.clientY;
      this.justDragged = false;
      const go = (move) => {
        if (this.dragged === null && Math.abs(move.clientY - from) < DRAG_START) return;
        move.preventDefault();
        this.dragged = row.number;
        this.justDragged = true;
        this.put(row.number, move.clientY);
      };
      const stop = (end) => this.drop(end.type === "pointerup");
      const escape = (press) => press.key === "Escape" && this.drop(false);
      const listeners = [["pointermove", go], ["pointerup", stop], ["pointercancel", stop], ["keydown", escape]];
      for (const [name, call] of listeners) window.addEventListener(name, call);
      this.drop = (done) => {
        for (const [name, call] of listeners) window.removeEventListener(name, call);
        const place = this.order ? this.order.length - 1 - this.order.indexOf(row.number) : row.place;
        const moved = done && this.dragged !== null && place !== row.place;
        this.dragged = null;
        if (moved) this.act("move", row, place);
        else this.order = null;
        this.drop = null;
        // Reset after the click event that the browser sends at the end of the drag.
        setTimeout(() => (this.justDragged = false));
      };
    },
    put(number, y) {
      const seen = this.$el.getBoundingClientRect();
      if (y < seen.top + 24) this.$el.scrollTop -= 14;
      else if (y > seen.bottom - 24) this.$el.scrollTop += 14;
      const rows = [...this.$el.querySelectorAll(".layer:not(.layer-field)")];
      const others = rows.filter((each) => Number(each.dataset.number) !== number);
      const above = others.filter((each) => {
        const box = each.getBoundingClientRect();
        return y > box.top + box.height / 2;
      });
      const order = others.map((each) => Number(each.dataset.number));
      order.splice(above.length, 0, number);
      this.order = order;
    },
  },
};
