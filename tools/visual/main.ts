// SPDX-License-Identifier: MIT
// The entry point of the page.

import './view/theme.css';
import { fileFormats, motionInstance, motionLibrary, robotBody } from './app/assets.ts';
import { RobotSession } from './app/robot-session.ts';
import type { ChosenStorage } from './app/document-parts.ts';
import type { EditorParts } from './app/editor.ts';
import { simulatedMotions } from './app/robot-memory.ts';
import { documentFrom } from './model/document.ts';
import { PageFormat } from './model/page-format.ts';
import { AppShell } from './view/app-shell.ts';
import { BrowserStorage, PassingStorage } from './view/document-storage.ts';
import { make } from './view/element.ts';
import { watchTyping } from './view/half-typed.ts';
import { useLanguage } from './view/texts/languages.ts';
import { TEXTS } from './view/texts/texts.ts';

async function start(): Promise<void> {
    await useLanguage(); // before any text is used
    if (typeof WebAssembly === 'undefined') return; // old-browser.js says so
    const [body, parts, storage] = await Promise.all([robotBody(), editorParts(), documentStorage()]);
    const session = new RobotSession(body, parts, fileFormats(), storage);
    const commitTyped = watchTyping(document);
    document.addEventListener('visibilitychange', () => leave(storage, commitTyped)); // the last event that a page receives, also on reload
    window.addEventListener('beforeunload', event => session.losesWork && event.preventDefault());
    await Promise.all([session.start(), show(session, parts, commitTyped)]); // the robot starts in its worker while the page is built
    keepOffline(session);
}

function leave({ storage }: ChosenStorage, commitTyped: () => void): void {
    if (document.visibilityState !== 'hidden') return;
    commitTyped();
    storage.leave();
}

async function show(session: RobotSession, parts: EditorParts, commitTyped: () => void): Promise<void> {
    await session.documents.start(parts.document);
    const shell = new AppShell();
    shell.session = session;
    document.body.append(shell);
    const readAddress = (): void => {
        commitTyped(); // to the motion it was typed for: the link chooses another one
        void session.files.readAddress(window.location.hash);
    };
    window.addEventListener('hashchange', readAddress); // a link to this page while it is open
    readAddress();
}

/** The first document is a copy of the simulated robot's motions. */
async function editorParts(): Promise<EditorParts> {
    const [scratch, player, motions, library] = await Promise.all([
        motionInstance(),
        motionInstance(),
        simulatedMotions(),
        motionLibrary(),
    ]);
    return {
        format: new PageFormat(scratch),
        player,
        document: documentFrom(motions, TEXTS.document.mine),
        library: documentFrom(library, '').pages,
    };
}

async function documentStorage(): Promise<ChosenStorage> {
    try {
        return { storage: await BrowserStorage.open(), isKept: true };
    } catch {
        return { storage: new PassingStorage(), isKept: false };
    }
}

/** Stores the complete page in the browser once everything it needs is loaded. Only the built page has a service worker. */
function keepOffline(session: RobotSession): void {
    if (!import.meta.env.PROD) return;
    const unwatch = session.state.watch(state => {
        if (state.physics === 'loading') return;
        queueMicrotask(() => unwatch());
        void session.version.keep();
    });
}

function fail(text: string): void {
    document.body.prepend(make('p', { role: 'alert', class: 'start-failed' }, text));
}

start().catch((error: unknown) => fail(TEXTS.page.couldNotStart(error instanceof Error ? error.message : String(error))));
