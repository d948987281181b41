// SPDX-License-Identifier: MIT
// Writes licences.html: the notices of everything in the built page. The bundler reports the npm packages in the page and its workers;
// their notices are in the packages. WebAssembly is compiled from distribution packages, with notices in /usr/share/doc. A missing notice
// fails the build.

import { existsSync, readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import type { Plugin } from 'vite';

const COMMON = '/usr/share/common-licenses';
const DOC = '/usr/share/doc';
const VENV = new URL('../../build/venv/', import.meta.url).pathname;
const HERE = new URL('./', import.meta.url).pathname;
/** Matches the package folder in node_modules that contains a module. */
const PACKAGE = /^(.*\/node_modules\/((?:@[^/]+\/)?[^/]+))\//;

/** A work that is part of the page. texts: its notices in full. */
interface Notice {
    readonly title: string;
    readonly about: string;
    readonly texts: readonly string[];
}

function read(path: string): string {
    if (!existsSync(path))
        throw new Error(
            `licences: ${path} is missing, and the page must not be passed on without it. Build on Debian or Ubuntu, after tools/dev/setup demo web`,
        );
    return readFileSync(path, 'utf8');
}

/** The notice of a distribution package. */
function copyright(name: string): string {
    return read(join(DOC, name, 'copyright'));
}

/** The newest entry whose name matches. */
function newest(folder: string, name: RegExp): string {
    const [found] = readdirSync(folder)
        .filter(one => name.test(one))
        .sort()
        .reverse();
    if (found === undefined) throw new Error(`licences: ${folder} holds nothing like ${name.source}`);
    return found;
}

/** Licence texts for packages that bring none. */
const LICENCE_FILES: Readonly<Record<string, string>> = { 'Apache-2.0': 'Apache-2.0', 'MPL-2.0': 'MPL-2.0' };

function npmNotice(folder: string, name: string): Notice {
    const about = JSON.parse(read(join(folder, 'package.json'))) as {
        version: string;
        license: string;
        author?: string | { name: string };
        repository?: string | { url: string };
    };
    const own = readdirSync(folder)
        .filter(file => /^(licen[cs]e|notice|copying)/i.test(file))
        .map(file => read(join(folder, file)));
    const common = LICENCE_FILES[about.license];
    if (own.length === 0 && !common) throw new Error(`licences: the npm package ${name} (${about.license}) brings no text of its licence`);
    const author = typeof about.author === 'string' ? about.author : (about.author?.name ?? `the authors of ${name}`);
    const source = typeof about.repository === 'string' ? about.repository : (about.repository?.url ?? `the npm package ${name}`);
    const texts =
        own.length > 0
            ? own
            : [
                  `Copyright ${author}. Unchanged; its source: ${source.replace(/^git\+/, '')}, version ${about.version}.`,
                  read(join(COMMON, common ?? '')),
              ];
    return {
        title: `${name} ${about.version}`,
        about: `npm package, ${about.license}`,
        texts: name === '@mujoco/mujoco' ? [...texts, read(join(HERE, 'licences/mujoco-parts.txt'))] : texts,
    };
}

/** Parts that the bundler does not know, because they are fetched at run time. */
function compiledNotices(): Notice[] {
    const packages = join(VENV, 'lib', newest(join(VENV, 'lib'), /^python3/), 'site-packages');
    const intelhex = newest(packages, /^intelhex-.*\.dist-info$/);
    return [
        {
            title: 'Motion512',
            about: 'the page, the firmware, motion.wasm, trial.wasm, servos-*.wasm; MIT',
            texts: [read(join(HERE, '../../LICENSE'))],
        },
        {
            title: 'simavr',
            about: 'in board-*.wasm, which is therefore passed on under the GPL, version 3',
            texts: [OFFER, copyright('libsimavr-dev'), read(join(COMMON, 'GPL-3'))],
        },
        { title: 'wasi-libc and musl', about: 'in every .wasm of ours', texts: [copyright('wasi-libc')] },
        {
            title: 'compiler-rt of LLVM',
            about: 'in every .wasm of ours',
            texts: [copyright(newest(DOC, /^libclang-rt-\d+-dev-wasm32$/)), read(join(COMMON, 'Apache-2.0'))],
        },
        { title: 'Python', about: 'in pyodide-*.wasm and python-*.zip', texts: [copyright(newest(DOC, /^python3\.\d+-minimal$/))] },
        {
            title: 'intelhex',
            about: 'in python-*.zip',
            texts: [
                read(
                    join(packages, intelhex, existsSync(join(packages, intelhex, 'LICENSE.txt')) ? 'LICENSE.txt' : 'licenses/LICENSE.txt'),
                ),
            ],
        },
    ];
}

const OFFER = `board-*.wasm contains simavr. Its complete source: the repository of Motion512 (folders tools/sim and tools/visual/board) and
the source package simavr of Debian or Ubuntu in the version of libsimavr-dev, which tools/visual/board/get_simavr fetches. The page talks
to that file and does not contain it. Whoever passes on this folder passes on this offer with it, and gives the source to anybody who asks.`;

function escaped(text: string): string {
    return text.replaceAll('&', '&amp;').replaceAll('<', '&lt;').replaceAll('>', '&gt;');
}

function html(notices: readonly Notice[]): string {
    const sections = notices.map(
        ({ title, about, texts }) =>
            `<h2>${escaped(title)}</h2>\n<p>${escaped(about)}</p>\n${texts.map(text => `<pre>${escaped(text.trim())}</pre>`).join('\n')}`,
    );
    return `<!doctype html>
<html lang="en">
<head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1"><title>Motion512: licences</title>
<style>body { max-width: 50rem; margin: 2rem auto; padding: 0 1rem; font-family: system-ui, sans-serif } pre { max-height: 20rem; overflow: auto; padding: 0.7rem; border: 1px solid #8888; white-space: pre-wrap }</style></head>
<body><h1>Licences</h1><p><a href="./">Back to the robot</a></p>
<p>What this page is made of, and under which terms it may be passed on. Keep this file with it.</p>
${sections.join('\n')}
</body></html>
`;
}

/** Two plugins: `bundled` collects packages in every bundle, `page` writes the file at the end. */
export function licences(): { readonly bundled: () => Plugin; readonly page: Plugin } {
    const folders = new Map<string, string>();
    const bundled = (): Plugin => ({
        name: 'licences-of-modules',
        generateBundle(_options, bundle) {
            for (const chunk of Object.values(bundle)) {
                for (const module of chunk.type === 'chunk' ? chunk.moduleIds : []) {
                    const [, folder, name] = PACKAGE.exec(module) ?? [];
                    if (folder && name) folders.set(name, folder);
                }
            }
        },
    });
    return {
        bundled,
        page: {
            name: 'licences',
            apply: 'build',
            generateBundle() {
                const packages = [...folders].sort(([a], [b]) => a.localeCompare(b)).map(([name, folder]) => npmNotice(folder, name));
                this.emitFile({ type: 'asset', fileName: 'licences.html', source: html([...compiledNotices(), ...packages]) });
            },
        },
    };
}
