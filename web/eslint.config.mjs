// What types do not show: promises that nobody waits for, whose errors are lost.

import tseslint from "typescript-eslint";

export default tseslint.config({
  files: ["src/**/*.ts"],
  extends: [tseslint.configs.base],
  languageOptions: { parserOptions: { project: ["./tsconfig.json", "./tsconfig.worker.json"] } },
  rules: {
    "@typescript-eslint/await-thenable": "error",
    "@typescript-eslint/no-floating-promises": "error",
    "@typescript-eslint/no-misused-promises": "error",
  },
});
