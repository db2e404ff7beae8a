// A field of a form: a number, a line of text, a colour, a check box, a list or a slider.
// The server's value never replaces what the user types, nor a value that is still on its way.
const TYPED = ["text", "number", "search"];

export default {
  template: `
    <select v-if="kind === 'select'" @change="send">
      <option v-for="[name, title] in choices" :key="name" :value="name">{{ title }}</option>
    </select>
    <input v-else-if="kind === 'range'" type="range" @input="send">
    <input v-else-if="kind === 'number'" inputmode="decimal" @input="type" @change="send" @blur="leave">
    <input v-else :type="kind" @input="type" @change="send" @blur="leave">`,
  props: { kind: String, shown: Object, choices: Array },
  emits: ["value"],
  mounted() {
    this.sent = 0;
    this.show();
  },
  updated() {
    // The list of choices may have changed.
    if (this.kind === "select") this.show();
  },
  watch: {
    shown: "show",
  },
  methods: {
    show() {
      const { value, answered } = this.shown;
      if (this.typing || answered < this.sent) return;
      const field = this.$el;
      if (this.kind === "checkbox") field.checked = value;
      else if (field.value !== String(value)) field.value = value;
    },
    type() {
      this.typing = TYPED.includes(this.kind);
    },
    send() {
      const value = this.kind === "checkbox" ? this.$el.checked : this.$el.value;
      this.typing = false;
      this.sent += 1;
      this.$emit("value", { value, number: this.sent });
      // A list that was chosen from by the mouse must not take the keys that change the wind.
      if (this.kind === "select" && !this.$el.matches(":focus-visible")) this.$el.blur();
    },
    // What was typed may be what was there before; then the browser reports no change.
    leave() {
      this.typing = false;
      this.show();
    },
  },
};
