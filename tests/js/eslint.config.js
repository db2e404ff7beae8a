// ESLint for the page's JavaScript; `npm run lint` runs it from the root of the repository.
import js from "@eslint/js";
import globals from "globals";

export default [
  js.configs.recommended,
  {
    files: ["drapery/testing/*.js"],
    languageOptions: { sourceType: "script", globals: globals.browser },
    rules: { eqeqeq: "error", "no-var": "error", "prefer-const": "error" },
  },
  {
    files: ["drapery/{studio,web}/**/*.js"],
    languageOptions: { sourceType: "module", globals: globals.browser },
    rules: {
      eqeqeq: "error",
      "no-var": "error",
      "prefer-const": "error",
    },
  },
  {
    files: ["examples/web/*"],
    languageOptions: {
      sourceType: "module",
      globals: globals.browser,
      parserOptions: { ecmaFeatures: { jsx: true } },
    },
    rules: { "no-unused-vars": "off" }, // it does not see what JSX uses
  },
  {
    // Scripts that Selenium runs as the body of a function.
    files: ["tests/page_*.js"],
    languageOptions: {
      sourceType: "script",
      globals: globals.browser,
      parserOptions: { ecmaFeatures: { globalReturn: true } },
    },
  },
  {
    files: ["tests/js/**/*.js"],
    languageOptions: { sourceType: "module", globals: globals.node },
  },
];
