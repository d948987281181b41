// SPDX-License-Identifier: MIT
// The built page, served on this computer, in Debian's Chromium. A console error, an error in the page or a request to another host fails
// the test in close().

import { spawn } from 'node:child_process';
import type { ChildProcess } from 'node:child_process';
import { existsSync } from 'node:fs';
import { chromium } from 'playwright-core';
import type { Browser, BrowserContext, ConsoleMessage, Locator, Page } from 'playwright-core';
import type { Session } from '../../view/session/session.ts';

/** The whole browser, which draws its own window around each page even if nobody sees it. */
export const BROWSER = ['/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome'].find(existsSync);
/** The same browser without that window: a visit costs half the processor time until the robot stands. */
const SHELL = ['/usr/bin/chromium-headless-shell'].find(existsSync);
/** Without a graphics chip WebGL is drawn by software. The page is then composed without WebGL: composing with it takes 0.2 s per frame,
 *  and a robot that must keep real time would wait for each frame. */
export const FLAGS = [
    '--disable-gpu-compositing',
    '--disable-quic',
    '--no-first-run',
    '--disable-background-networking',
    '--disable-component-update',
    '--disable-sync',
    '--use-gl=angle',
    '--use-angle=swiftshader',
    '--enable-unsafe-swiftshader',
    ...(process.getuid?.() === 0 ? ['--no-sandbox'] : []),
];
/** CSS pixels. */
export interface Screen {
    readonly width: number;
    readonly height: number;
    readonly hasTouch?: boolean;
}

const SCREEN: Screen = { width: 1000, height: 640 };

/** Properties of a visit. */
export interface Visit {
    readonly theme?: 'light' | 'dark';
    /** Screen pixels per CSS pixel. */
    readonly sharpness?: number;
    readonly screen?: Screen;
    /** Default: the browser has no WebGL, as on an old machine (lacking.test.ts). Drawing by software doubles what a visit costs, so
     *  true draws until the robot stands: the scene behind the picture goes on, and untilStanding() ends the drawing. */
    readonly hasPicture?: boolean | 'drawn';
    /** Default: the robot's physics cannot be loaded. It stands without a physical body and is ready three seconds sooner. Physics doubles
     *  what a visit costs, too. 'later': the first robot lacks it, what is tried has it. */
    readonly hasPhysics?: boolean | 'later';
    /** Default: m512, which checks, compares and reads files, never comes. Starting Python costs more than a visit. */
    readonly hasPython?: boolean;
    /** The browser stores the page for offline use (offline.test.ts), which writes 10 MB. */
    readonly keepsPage?: boolean;
    /** A first visit: the page suggests what to do (first-minute.test.ts). Other visitors are past that. */
    readonly isNew?: boolean;
    /** Runs with the empty page before the address is opened. */
    readonly before?: (page: Page) => Promise<unknown>;
}

/** Console messages about abilities that the test removed. */
const NO_PICTURE = /^THREE\.WebGLRenderer/;
const NO_PHYSICS = /ERR_FAILED .*mujoco\.wasm/;
/** The file with the physics. */
export const PHYSICS = '**/mujoco.wasm*';
const PYTHON = /\/(pyodide|python)[^/]*\.(gz|zip)$/;

/** In the browser: disables WebGL. */
function withoutWebGl(): void {
    const { prototype } = HTMLCanvasElement;
    const contextOf = prototype.getContext as (this: HTMLCanvasElement, kind: string, options?: unknown) => RenderingContext | null;
    Object.assign(prototype, {
        getContext(this: HTMLCanvasElement, kind: string, options?: unknown) {
            return kind.startsWith('webgl') ? null : contextOf.call(this, kind, options);
        },
    });
}

const STANDS = /^(The robot stands and waits|Edit runs: its screen is in the terminal)\.$/;
/** Set by robot-view.ts. */
const ROBOT_DRAWN = 'robot-drawn';
/** Default time limit of all waits. A busy computer must not fail a test. While writing tests, set WAIT_MS to a shorter time. */
const LIMIT_MS = Number(process.env.WAIT_MS ?? 240_000);

/** The page's own objects, as far as tests reach into them: what the views see, and the cable to the robot in the page. */
export type InPage = Session & {
    readonly sources: {
        readonly simulated: { readonly connection: { readonly port: { deliver(bytes: Uint8Array): void; unplug(): void } } };
    };
    readonly editor: { setRobot(pages: readonly (Uint8Array | null)[]): void };
};

/** Runs an action in the page, which sees nothing around it, with the page's own objects. */
export async function inPage<T, A>(page: Page, action: (session: InPage, argument: A) => T, argument?: A): Promise<Awaited<T>> {
    await page.locator('app-shell').waitFor();
    const call = `(${String(action)})(document.querySelector('app-shell').session, ${JSON.stringify(argument)})`;
    return page.evaluate(call) as Promise<Awaited<T>>;
}

export class PageServer {
    readonly address: string;
    private readonly process: ChildProcess;

    private constructor(process: ChildProcess, address: string) {
        this.process = process;
        this.address = address;
    }

    static async start(...options: string[]): Promise<PageServer> {
        const server = spawn(new URL('../../serve', import.meta.url).pathname, options, { stdio: ['ignore', 'pipe', 'inherit'] });
        const address = await new Promise<string>((resolve, reject) => {
            server.stdout.once('data', (line: Buffer) => resolve(line.toString().trim()));
            server.once('exit', () => reject(new Error('the server ended: is the page built? tools/dev/build web')));
        });
        return new PageServer(server, address);
    }

    stop(): Promise<void> {
        return new Promise(resolve => {
            if (this.process.exitCode !== null || this.process.signalCode !== null) return resolve();
            this.process.once('exit', () => resolve());
            this.process.kill();
        });
    }
}

/** more: additional flags. */
export async function startBrowser(...more: string[]): Promise<Browser> {
    const executablePath = SHELL ?? BROWSER;
    if (!executablePath) throw new Error('there is no Chromium: tools/dev/setup webtest');
    return chromium.launch({ executablePath, headless: true, args: [...FLAGS, ...more] });
}

/** A visitor with a separate browser profile. */
export class Visitor {
    readonly page: Page;
    readonly faults: string[] = [];
    private readonly context: BrowserContext;
    private readonly isDrawn: boolean;

    private constructor(context: BrowserContext, page: Page, isDrawn: boolean) {
        this.context = context;
        this.page = page;
        this.isDrawn = isDrawn;
    }

    static async come(browser: Browser, address: string, visit: Visit = {}): Promise<Visitor> {
        const {
            theme = 'light',
            sharpness = 1,
            screen: { width, height, hasTouch = false } = SCREEN,
            hasPicture = false,
            hasPhysics = false,
            hasPython = false,
            keepsPage = false,
            isNew = false,
            before,
        } = visit;
        // Reduced motion, so that no colour is checked during a transition.
        const context = await browser.newContext({
            viewport: { width, height },
            hasTouch,
            colorScheme: theme,
            deviceScaleFactor: sharpness,
            reducedMotion: 'reduce',
            serviceWorkers: keepsPage ? 'allow' : 'block',
        });
        context.setDefaultTimeout(LIMIT_MS);
        if (!hasPicture) await context.addInitScript(withoutWebGl);
        if (!isNew) await context.addInitScript(() => localStorage.setItem('motion512.begun', '1'));
        if (!hasPython) await context.route(PYTHON, () => undefined);
        let isRefused = hasPhysics !== true;
        await context.route(PHYSICS, route => {
            const refuses = isRefused;
            isRefused = !hasPhysics;
            return refuses ? route.abort() : route.continue();
        });
        const visitor = new Visitor(context, await context.newPage(), hasPicture === 'drawn');
        visitor.watch(new URL(address).origin, [...(hasPicture ? [] : [NO_PICTURE]), ...(hasPhysics === true ? [] : [NO_PHYSICS])]);
        await before?.(visitor.page);
        await visitor.page.goto(address);
        return visitor;
    }

    private watch(origin: string, expected: readonly RegExp[]): void {
        const isExpected = (message: ConsoleMessage): boolean =>
            expected.some(lack => lack.test(`${message.text()} ${message.location().url}`));
        this.page.on(
            'console',
            message => message.type() === 'error' && !isExpected(message) && this.faults.push(`console: ${message.text()}`),
        );
        this.page.on('pageerror', error => this.faults.push(`error: ${error.message}`));
        this.context.on('request', request => {
            const url = request.url();
            if (!url.startsWith(origin) && !url.startsWith('data:') && !url.startsWith('blob:'))
                this.faults.push(`foreign request: ${url}`);
        });
    }

    /** The status text of the robot. */
    get doing() {
        return this.page.getByRole('status', { name: 'What the robot does' });
    }

    /** Waits until the robot's status says this. */
    untilDoing(hasText: string | RegExp): Promise<void> {
        return this.doing.filter({ hasText }).waitFor();
    }

    /** Waits until this is the last message. */
    untilSaid(hasText: string | RegExp): Promise<void> {
        return this.page.getByRole('log', { name: 'Last message' }).filter({ hasText }).waitFor();
    }

    /** Runs an action with the page's own objects. */
    inPage<T, A = undefined>(action: (session: InPage, argument: A) => T, argument?: A): Promise<Awaited<T>> {
        return inPage(this.page, action, argument);
    }

    button(name: string) {
        return this.page.getByRole('button', { name, exact: true });
    }

    async open(tab: 'Remote' | 'Steps' | 'Curves' | 'Motions' | 'Links' | 'Checks' | 'Terminal' | 'Robot'): Promise<void> {
        await this.showAllAreas(tab);
        await this.page.getByRole('tab', { name: tab, exact: true }).click();
    }

    /** Opens the head's menu if the head has no room for everything. */
    async openMenu(): Promise<void> {
        const toggle = this.page.locator('more-menu .toggle');
        await this.page.locator('app-shell').waitFor();
        if ((await toggle.isVisible()) && (await toggle.getAttribute('aria-expanded')) === 'false') await toggle.click();
    }

    async closeMenu(): Promise<void> {
        const toggle = this.page.locator('more-menu .toggle');
        if ((await toggle.isVisible()) && (await toggle.getAttribute('aria-expanded')) === 'true') await toggle.click();
    }

    /** Presses a button of the head or its menu that opens no dialog. */
    async press(name: string): Promise<void> {
        await this.openMenu();
        await this.button(name).click();
        await this.closeMenu();
    }

    /** Ticks live follow in Steps, with a motion that has steps. Returns its box. */
    async follow(): Promise<Locator> {
        await this.open('Steps');
        await this.page.getByRole('combobox', { name: 'Motion', exact: true }).selectOption('3');
        const box = this.page.getByRole('checkbox', { name: /^The robot follows/ });
        await box.check();
        return box;
    }

    /** Opens "More" if this area has no tab yet. */
    async showAllAreas(tab: string): Promise<void> {
        await this.page.locator('app-shell').waitFor();
        const isSeen = await this.page.getByRole('tab', { name: tab, exact: true }).isVisible();
        if (!isSeen) await this.button('More').click();
    }

    /** Waits until the robot is drawn. Returns milliseconds since the page was requested. */
    async untilDrawn(): Promise<number> {
        const drawn = await this.page.waitForFunction(mark => performance.getEntriesByName(mark)[0]?.startTime, ROBOT_DRAWN);
        return (await drawn.jsonValue()) ?? NaN;
    }

    /** Waits until the page shows that the firmware answers and nothing plays; with physics, that the robot stands by itself. */
    async untilStanding(): Promise<void> {
        await this.page.locator('status-bar .doing').filter({ hasText: STANDS }).waitFor();
        const hasPicture = (await this.page.locator('robot-view canvas').count()) > 0;
        if (!hasPicture) return;
        await this.untilDrawn(); // by software a second later
        if (!this.isDrawn) await this.stopDrawing();
    }

    /** Waits until changes are on the screen, so that the mouse hits what is shown. */
    async untilSeen(): Promise<void> {
        await this.page.evaluate(() => new Promise(resolve => requestAnimationFrame(() => requestAnimationFrame(resolve))));
    }

    /** The place of a part of the robot on the screen. */
    placeOf(shape: string): Promise<{ x: number; y: number }> {
        return this.page
            .locator('robot-view')
            .evaluate((view, name) => (view as unknown as { placeOf(name: string): { x: number; y: number } }).placeOf(name), shape);
    }

    /** The picture stays as it is. The scene, where placeOf() and the mouse find the robot, follows it on. */
    stopDrawing(): Promise<void> {
        return this.page.locator('robot-view').evaluate(view => {
            type Moving = { updateMatrixWorld(): void };
            const { scene } = view as unknown as { scene: { renderer: object; aside: object | null } };
            const render = (...parts: Moving[]): void => {
                for (const part of parts) part.updateMatrixWorld();
            };
            Object.assign(scene.renderer, { render });
            Object.assign(scene.aside ?? {}, { show: () => undefined });
        });
    }

    /** Waits until the camera is still; it glides on a little after a gesture. */
    async untilStill(): Promise<void> {
        await this.page.waitForFunction(() => (document.querySelector('robot-view') as unknown as { isStill: boolean }).isStill);
    }

    /** The positions of these servos in the next picture. */
    async positions(ids: readonly number[]): Promise<number[]> {
        const servos = await this.inPage(
            session =>
                new Promise<readonly { id: number; position: number }[]>(resolve => {
                    const stop = session.onFrame(state => {
                        stop();
                        resolve(state.servos);
                    });
                }),
        );
        return ids.map(id => servos.find(one => one.id === id)?.position ?? 0);
    }

    /** Waits in the robot's own time, which is slower than the clock on a busy computer. */
    robotSeconds(seconds: number): Promise<void> {
        return this.inPage(
            (session, ticks) =>
                new Promise<void>(resolve => {
                    let first = -1;
                    const end = session.onFrame(state => {
                        if (first < 0) first = state.ticks;
                        if (state.ticks - first < ticks) return;
                        end();
                        resolve();
                    });
                }),
            seconds * 128,
        );
    }

    /** The terminal's screen as text. */
    screen(): Promise<string> {
        return this.page.locator('terminal-pane').evaluate(pane => (pane as unknown as { screenText: string }).screenText);
    }

    /** Types into the terminal. */
    async type(text: string): Promise<void> {
        await this.page.getByRole('textbox', { name: 'Terminal of the robot' }).focus();
        for (const part of text.split(/(\r)/))
            part === '\r' ? await this.page.keyboard.press('Enter') : await this.page.keyboard.type(part);
    }

    async untilScreenSays(text: string | RegExp, limitMs = LIMIT_MS): Promise<void> {
        const end = Date.now() + limitMs;
        for (let screen = await this.screen(); !screen.match(text); screen = await this.screen()) {
            if (Date.now() > end) throw new Error(`the terminal never said ${text}; it shows:\n${screen}`);
            await this.page.waitForTimeout(100);
        }
    }

    /** Closes the page. Throws if there was any fault. */
    async leave(): Promise<void> {
        await this.context.close();
        if (this.faults.length > 0) throw new Error(this.faults.join('\n'));
    }
}
