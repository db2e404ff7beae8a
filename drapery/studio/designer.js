// The designer of the page, which lives in the page's places and not in this element.
export default {
  template: "<span hidden></span>",
  props: { module: String, given: Object, faces: Object, beside: Object },
  emits: ["design"],
  watch: {
    async faces(addresses) {
      (await this.designer).redraw(addresses);
    },
    async beside(packs) {
      (await this.designer).packComparison.open(packs);
    },
  },
  mounted() {
    this.designer = this.open();
  },
  methods: {
    async open() {
      const { StudioDesigner } = await import(new URL(this.module, location.href));
      return new StudioDesigner(this.given, this.faces, (design) => this.$emit("design", design));
    },
    async lay(...given) {
      (await this.designer).lay(...given);
    },
  },
};
