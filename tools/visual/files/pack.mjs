// SPDX-License-Identifier: MIT
// Makes build/wasm/python.zip: what the page's Python needs and no more, compiled. The standard library as published is 559
// sources, which the browser would compile at every start. Node runs the same Python here: it imports m512 and the bridge, uses
// every format once, and packs the modules that are then loaded. The same sources give the same bytes.
//
//   node files/pack.mjs FOLDER_OF_M512 FOLDER_OF_INTELHEX OUTPUT

import { readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { join, relative } from 'node:path';
import { loadPyodide } from 'pyodide';
import { LOCK } from './lock.ts';

const [m512 = '', intelhex = '', output = ''] = process.argv.slice(2);
const BRIDGE = new URL('bridge.py', import.meta.url);

function sources(folder) {
  return readdirSync(folder, { recursive: true }).filter((name) => name.endsWith('.py')).map((name) => join(folder, name));
}

const python = await loadPyodide({ lockFileContents: LOCK });
const { FS } = python;
FS.mkdirTree('/pack');
for (const root of [m512, intelhex]) {
  for (const file of sources(root)) {
    const to = `/pack/${relative(join(root, '..'), file)}`;
    FS.mkdirTree(to.slice(0, to.lastIndexOf('/')));
    FS.writeFile(to, readFileSync(file));
  }
}
FS.writeFile('/pack/bridge.py', readFileSync(BRIDGE));
python.runPython(readFileSync(new URL('pack.py', import.meta.url), 'utf8'));
writeFileSync(output, FS.readFile('/python.zip'));
