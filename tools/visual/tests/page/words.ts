// SPDX-License-Identifier: MIT
// Walks through all areas and dialogs of the page, in any language, and collects the visible text and what bars somebody.
import { readFileSync } from 'node:fs';
import type { Page } from 'playwright-core';
import type { Texts } from '../../view/texts/texts.ts';
import { barriers } from './accessible.ts';
import type { Screen, Visitor } from './page-bench.ts';
import { PAGE_BYTES } from '../../model/motion.ts';
import type { Tab } from '../../view/session/session.ts';

const AREAS: readonly Tab[] = ['remote', 'steps', 'curves', 'pages', 'links', 'checks', 'terminal', 'robot'];

const ROOT = new URL('../../../../', import.meta.url).pathname;
const LIBRARY = `${ROOT}build/motions/motions.bin`;
const LARGE = `${ROOT}tests/samples/robot_12bit_256p.bin`;

export interface Words {
    /** Texts with two consecutive plain letters outside quotations. */
    readonly plain: readonly string[];
    /** Texts that are partly invisible and cannot be scrolled into view. */
    readonly cut: readonly string[];
}

/** Words, and on the widest screen what bars somebody. */
export interface Place extends Words {
    readonly barred: readonly string[];
}

/** In the browser: the visible text of the page or the open dialog. */
function look(): Words {
    /** Quotations: the terminal, names of motions, messages of board and m512, labels on the board. */
    const QUOTED =
        '.xterm, script, style, noscript, status-bar .message, status-bar .facts, [lang="en"]:not(html), .leds, page-card .name, language-choice option, canvas';
    const root = document.querySelector('dialog[open]') ?? document.body;
    const isSeen = (element: Element): boolean => element.checkVisibility({ visibilityProperty: true, opacityProperty: true });
    const plain = new Set<string>();
    const cut = new Set<string>();
    const read = (text: string | null): void => {
        if (text !== null && /[A-Za-z]{2}/.test(text)) plain.add(text.trim());
    };
    /** The nearest box that clips the element. null: it can be scrolled into view. */
    const hidingBox = (element: Element): DOMRect | null => {
        for (let one: Element | null = element; one; one = one.parentElement) {
            const { overflowX, position } = getComputedStyle(one);
            if (overflowX === 'auto' || overflowX === 'scroll') return null;
            if (overflowX === 'hidden' || overflowX === 'clip') return one.getBoundingClientRect();
            if (position === 'fixed') break;
        }
        return new DOMRect(0, -1e6, innerWidth, 2e6);
    };
    const walker = document.createTreeWalker(root, NodeFilter.SHOW_TEXT);
    for (let node = walker.nextNode(); node; node = walker.nextNode()) {
        const { parentElement: parent, textContent: text } = node;
        if (!parent || !text?.trim() || !isSeen(parent) || parent.closest('.visually-hidden, .skip, option')) continue;
        if (!parent.closest(QUOTED)) read(text);
        const range = document.createRange();
        range.selectNodeContents(node);
        const [at, box] = [range.getBoundingClientRect(), parent.closest('.xterm, svg') ? null : hidingBox(parent)];
        if (box && (at.left < box.left - 1.5 || at.right > box.right + 1.5)) cut.add(text.trim());
    }
    read(document.title);
    read(document.querySelector<HTMLMetaElement>('meta[name="description"]')?.content ?? '');
    for (const area of root.querySelectorAll('.area:not([hidden]), dialog[open]'))
        if (area.scrollWidth > area.clientWidth + 1) cut.add('something that is scrolled to sideways');
    for (const element of root.querySelectorAll('*')) {
        if (element.closest(QUOTED) || (!isSeen(element) && !element.matches('option'))) continue;
        for (const name of ['aria-label', 'title', 'placeholder', 'alt', 'aria-valuetext']) read(element.getAttribute(name));
        if (element.matches('option') && element.parentElement && isSeen(element.parentElement)) read(element.textContent);
    }
    return { plain: [...plain], cut: [...cut] };
}

/** A file whose name is not a word in any language. */
function file(buffer: Buffer, name = '1.bin'): { name: string; mimeType: string; buffer: Buffer } {
    return { name, mimeType: '', buffer };
}

/** Adds a trim and a damaged motion. */
function withFaults(image: Buffer): Buffer {
    image.copy(image, 0, 2 * PAGE_BYTES, 3 * PAGE_BYTES);
    return image.fill(7, 3 * PAGE_BYTES + PAGE_BYTES / 2, 4 * PAGE_BYTES);
}

export class Walk {
    private readonly person: Visitor;
    private readonly page: Page;
    private readonly texts: Texts;
    private readonly screens: readonly Screen[];
    private readonly found: (place: string, what: Place) => void;

    /** screens: at each place the page is looked at on all of them, from the narrowest on. */
    constructor(person: Visitor, texts: Texts, screens: readonly Screen[], found: (place: string, what: Place) => void) {
        this.person = person;
        this.screens = screens;
        this.page = person.page;
        this.texts = texts;
        this.found = found;
    }

    private async look(place: string, screens = this.screens): Promise<void> {
        for (const screen of screens) {
            await this.page.setViewportSize(screen);
            await this.person.untilSeen();
            const words = await this.page.evaluate(look);
            const barred = screen === this.screens.at(-1) ? await barriers(this.page, await this.part(place)) : [];
            this.found(`${place}, ${screen.width} px`, { ...words, barred });
        }
    }

    /** What is new in the page. The head is the same everywhere. */
    private async part(place: string): Promise<'body' | 'main' | 'dialog[open]'> {
        if ((await this.page.locator('dialog[open]').count()) > 0) return 'dialog[open]';
        return ['remote', 'menu', 'tour 14', 'sent motion'].includes(place) ? 'body' : 'main';
    }

    async open(area: Tab): Promise<void> {
        await this.page.locator(`#tab-${area}`).click();
    }

    /** Opens everything in the page that needs no moving robot, as on a first visit. */
    async all(): Promise<void> {
        const { page } = this;
        await page.locator('first-minute').waitFor();
        await this.look('first minute');
        await page.locator('.more-areas').click();
        for (const area of AREAS) {
            await this.open(area);
            if (area === 'links') await page.locator('svg .node').first().waitFor();
            await this.look(area);
        }
        await this.open('remote');
        await page.locator('details.overlay summary').click();
        await this.look('layers');
        await this.person.openMenu();
        await this.look('menu');
        await page.keyboard.press('Escape');
        await this.tour();
        await this.dialogs();
        await this.files();
    }

    private async tour(): Promise<void> {
        const { page, texts } = this;
        await page.getByRole('button', { name: texts.tour.tour, exact: true }).click();
        const next = page.locator('tour-card .row button:not(.back)').nth(1);
        for (let stop = 1; stop < 14; stop++) {
            await this.look(`tour ${stop}`, this.screens.slice(0, 1)); // nothing but texts, which wrap
            await next.click();
        }
        await this.look('tour 14');
        await page.getByRole('button', { name: texts.tour.done, exact: true }).click();
    }

    private async dialog(place: string, open: () => Promise<unknown>): Promise<void> {
        await open();
        await this.page.locator('dialog[open]:not([aria-busy=true])').waitFor();
        await this.look(place);
        await this.page.keyboard.press('Escape');
        await this.page.locator('dialog[open]').waitFor({ state: 'hidden' });
    }

    private async dialogs(): Promise<void> {
        const { page, texts } = this;
        const button = (name: string): Promise<void> => page.getByRole('button', { name, exact: true }).click();
        await this.open('steps');
        await this.dialog('keys', () => page.keyboard.press('?'));
        await page.locator('steps-pane page-head select').selectOption('3');
        await page.locator('pose-bar summary').click();
        await this.look('steps of a motion');
        await page.keyboard.press('Escape');
        const documents = page.locator('edit-bar select');
        for (const action of ['new', 'copy', 'rename', 'remove'])
            await this.dialog(`document ${action}`, () => documents.selectOption(action));
        await this.open('pages');
        await this.dialog('rename', () => button(texts.document.rename));
        await this.dialog('clear', () => button(texts.motions.clear));
        await this.dialog('move', async () => {
            await button(texts.motions.transfer);
            await page.getByRole('textbox', { name: texts.motions.toNumber }).fill('2');
            await page.keyboard.press('Enter');
            await page.getByText(texts.motions.linksFollow).waitFor();
        });
        await page.locator('page-card[data-page="3"]').click();
        await page.keyboard.press('Delete');
        await page.locator('dialog[open] button.primary').click();
        await this.dialog('compare', async () => {
            await button(texts.motions.compare);
            await page.locator('.rows li').first().waitFor();
        });
        await this.open('robot');
        await this.dialog('factory fresh', () => button(texts.robotPane.fresh));
        await this.person.openMenu();
        await page.locator('page-card[data-page="2"]').waitFor({ state: 'attached' });
        await this.dialog('nothing to send', () => button(texts.files.send));
    }

    /** Opens files with motions and all questions about them: the trim, and what to leave out if there is no room. */
    private async files(): Promise<void> {
        const { page } = this;
        const chooser = page.locator('files-menu input[type="file"]');
        await this.dialog('opened file', () => chooser.setInputFiles(file(withFaults(readFileSync(LIBRARY)))));
        await this.dialog('too large a file', () => chooser.setInputFiles(file(readFileSync(LARGE))));
        await this.dialog('refused file', () => chooser.setInputFiles(file(Buffer.from('type=0\n'), '1.mtn')));
        await this.dialog('losses', () => page.locator('files-menu select').selectOption('.mtn'));
        await this.person.closeMenu();
        await this.open('pages');
        await page.locator('page-card[data-page="2"]').click();
        await this.person.openMenu();
        await this.dialog('link', () => page.getByRole('button', { name: this.texts.files.send, exact: true }).click());
        const hash = await this.person.inPage(({ files }) => files.link());
        const address = page.url();
        await page.goto('about:blank');
        await page.goto(address + hash);
        await page.locator('sent-card').waitFor();
        await this.look('sent motion');
    }
}
