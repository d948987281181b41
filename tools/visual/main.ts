// SPDX-License-Identifier: MIT
// Starts the page.

import './view/theme.css';
import { fileFormats, motionInstance, motionLibrary, robotBody } from './app/assets.ts';
import { RobotDesk } from './app/desk.ts';
import type { EditorParts } from './app/editor.ts';
import { documentFrom } from './model/document.ts';
import { PageFormat } from './model/page-format.ts';
import { AppShell } from './view/app-shell.ts';
import { make } from './view/element.ts';

async function start(): Promise<void> {
  const [body, parts] = await Promise.all([robotBody(), editorParts()]);
  const desk = new RobotDesk(body, parts, fileFormats());
  const shell = new AppShell();
  shell.desk = desk;
  document.body.append(shell);
  void desk.files.readAddress(window.location.hash);
  await desk.start();
  keepOffline(desk);
}

async function editorParts(): Promise<EditorParts> {
  const [scratch, player, library] = await Promise.all([motionInstance(), motionInstance(), motionLibrary()]);
  return { format: new PageFormat(scratch), player, document: documentFrom(library, 'My motions') };
}

/** Keeps the whole page in the browser, once everything it needs now has been loaded. Only the built page has a service
 *  worker; where the browser refuses it (plain http from another machine) the page works, but not offline. */
function keepOffline(desk: RobotDesk): void {
  if (!import.meta.env.PROD || !('serviceWorker' in navigator)) return;
  const unwatch = desk.state.watch((state) => {
    if (state.physics === 'loading') return;
    queueMicrotask(() => unwatch());
    void navigator.serviceWorker.register('./service-worker.js').catch(() => undefined);
  });
}

start().catch((error: unknown) => {
  const why = error instanceof Error ? error.message : String(error);
  document.body.prepend(make('p', { role: 'alert', class: 'start-failed' }, `The page could not start: ${why}. Reload it.`));
});
