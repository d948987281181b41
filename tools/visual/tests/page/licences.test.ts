// SPDX-License-Identifier: MIT
// The built page has the notices of all its parts. The names come from package.json, from the sources of the modules, and from the modules'
// bytes.
import { readFileSync, readdirSync } from 'node:fs';
import { expect, test } from 'vitest';

const BUILT = new URL('../../../../build/visual/', import.meta.url);
const page = readFileSync(new URL('licences.html', BUILT), 'utf8');
const dependencies = Object.keys(
    (JSON.parse(readFileSync(new URL('../../package.json', import.meta.url), 'utf8')) as { dependencies: object }).dependencies,
);

/** The notice of one work: from its title to the next. */
function notice(title: string): string {
    const [, after = ''] = page.split(`<h2>${title}`);
    return after.split('<h2>')[0] ?? '';
}

test.each(dependencies)('%s: its copyright and its licence', name => {
    expect(notice(name)).toMatch(/Copyright/);
    expect(notice(name)).toMatch(/Permission is hereby granted|Apache License\s+Version 2.0|Mozilla Public License Version 2.0/);
});

test.each([
    ['simavr', /Michel Pollet[\s\S]*GNU GENERAL PUBLIC LICENSE\s+Version 3[\s\S]*END OF TERMS AND CONDITIONS/],
    ['simavr', /complete source/],
    ['wasi-libc', /Rich Felker/],
    ['compiler-rt', /LLVM[\s\S]*Apache License/],
    ['Python', /Python Software Foundation/],
    ['intelhex', /Alexander Belchenko/],
    ['Motion512', /MIT License|Permission is hereby granted/],
])('%s: %s', (title, text) => {
    expect(notice(title)).toMatch(text);
});

test('what MuJoCo is compiled from is named', () => {
    for (const part of ['Daniel Fiser', 'Lode Vandevenne', 'Qhull', 'TinyXML2', 'Syoyo Fujita'])
        expect(notice('@mujoco/mujoco')).toContain(part);
});

test('every file of the page that is not ours by its name has a notice', () => {
    const known = [/^(board|motion|servos|trial|mujoco|pyodide|python|body|motions|boot|edit|play)[.-]/];
    const fetched = readdirSync(new URL('assets/', BUILT)).filter(name => !/\.(js|css)$/.test(name));
    expect(fetched.filter(name => !known.some(pattern => pattern.test(name)))).toEqual([]);
});
