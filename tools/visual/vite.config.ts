// SPDX-License-Identifier: MIT
// Builds the page into build/visual. Relative addresses everywhere: the folder works from any sub-path of any host.
import { defineConfig } from 'vite';

export default defineConfig({
  base: './',
  publicDir: false,
  build: { outDir: '../../build/visual', emptyOutDir: true, target: 'es2022', assetsInlineLimit: 0, modulePreload: { polyfill: false } },
  worker: { format: 'es' },
});
