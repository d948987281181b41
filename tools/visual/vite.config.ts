// SPDX-License-Identifier: MIT
// Builds the page into build/visual. All addresses are relative, so the folder works under any path of any host.
import { defineConfig } from 'vite';
import { mujocoWithoutEval } from './mujoco-plugin.ts';
import { pythonHandedOver } from './python-plugin.ts';
import { licences } from './licences-plugin.ts';
import { TEXTS, start } from './start-plugin.ts';
import { offline } from './offline-plugin.ts';
import { oldBrowser } from './old-browser-plugin.ts';

const { bundled, page } = licences();

export default defineConfig({
    base: './',
    publicDir: false,
    plugins: [mujocoWithoutEval(), bundled(), page, start(), oldBrowser(TEXTS), offline()],
    build: {
        outDir: '../../build/visual',
        emptyOutDir: true,
        target: 'es2022',
        assetsInlineLimit: 0,
        modulePreload: { polyfill: false },
        chunkSizeWarningLimit: 1200,
    },
    worker: { format: 'es', plugins: () => [mujocoWithoutEval(), pythonHandedOver(), bundled()] },
});
