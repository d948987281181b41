// SPDX-License-Identifier: MIT
// Starts the page.

import './view/theme.css';
import { fileFormats, motionInstance, robotBody } from './app/assets.ts';
import { RobotDesk } from './app/desk.ts';
import type { DeskStorage } from './app/document-parts.ts';
import type { EditorParts } from './app/editor.ts';
import { simulatedMotions } from './app/simulated-source.ts';
import { documentFrom } from './model/document.ts';
import { PageFormat } from './model/page-format.ts';
import { AppShell } from './view/app-shell.ts';
import { BrowserStorage, PassingStorage } from './view/document-storage.ts';
import { make } from './view/element.ts';

async function start(): Promise<void> {
  const [body, parts, storage] = await Promise.all([robotBody(), editorParts(), documentStorage()]);
  const desk = new RobotDesk(body, parts, fileFormats(), storage);
  await Promise.all([desk.start(), show(desk, parts)]); // the robot starts in its worker while the page is built
  keepOffline(desk);
}

async function show(desk: RobotDesk, parts: EditorParts): Promise<void> {
  await desk.documents.start(parts.document);
  const shell = new AppShell();
  shell.desk = desk;
  document.body.append(shell);
  void desk.files.readAddress(window.location.hash);
}

/** The first document holds what the robot in the page has. */
async function editorParts(): Promise<EditorParts> {
  const [scratch, player, motions] = await Promise.all([motionInstance(), motionInstance(), simulatedMotions()]);
  return { format: new PageFormat(scratch), player, document: documentFrom(motions, 'My motions') };
}

async function documentStorage(): Promise<DeskStorage> {
  try {
    return { storage: await BrowserStorage.open(), isKept: true };
  } catch {
    return { storage: new PassingStorage(), isKept: false };
  }
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
