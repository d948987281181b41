// SPDX-License-Identifier: MIT
// axe-core finds no serious fault in a part of the page, and the contrast holds in the light and in the dark.
import { readFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import type { Page } from 'playwright-core';

const AXE = createRequire(import.meta.url).resolve('axe-core/axe.min.js');
/** Cards that are made as the one of page 2, which is looked at. */
const OTHERS = 'page-card:not([data-page="2"])';

/** A name that is spoken contains what is written. Accents stand for no letter here, so this is asked in English. */
const SPOKEN = 'label-content-name-mismatch';

interface Asked {
    readonly part: string;
    readonly others: string;
    readonly rules: object;
}

/** In the browser: serious and critical findings in a part of the page: "rule: element". */
async function serious({ part, others, rules }: Asked): Promise<string[]> {
    type Found = { id: string; impact: string; nodes: { target: string[]; failureSummary: string }[] };
    const { axe } = globalThis as unknown as { axe: { run(within: object, options: object): Promise<{ violations: Found[] }> } };
    const { violations } = await axe.run({ include: [part], exclude: [others] }, { resultTypes: ['violations'], preload: false, ...rules });
    return violations
        .filter(({ impact }) => impact === 'serious' || impact === 'critical')
        .flatMap(({ id, nodes }) => nodes.map(({ target, failureSummary }) => `${id}: ${target.join(' ')} ${failureSummary}`));
}

/** In the browser: texts of a part of the page that stand out too little from what is behind them (WCAG, AA). axe's own rule takes as long
 *  as all its others. It also sees what lies across a text, which screens.test.ts checks. */
function faint({ part, others }: Omit<Asked, 'rules'>): string[] {
    type Colour = readonly [number, number, number, number];
    const canvas = new OffscreenCanvas(1, 1).getContext('2d', { willReadFrequently: true });
    const known = new Map<string, Colour>();
    const read = (css: string): Colour => {
        canvas?.clearRect(0, 0, 1, 1);
        Object.assign(canvas ?? {}, { fillStyle: css });
        canvas?.fillRect(0, 0, 1, 1);
        const [r = 0, g = 0, b = 0, a = 0] = canvas?.getImageData(0, 0, 1, 1).data ?? [];
        known.set(css, [r, g, b, a / 255]);
        return [r, g, b, a / 255];
    };
    const colour = (css: string): Colour => known.get(css) ?? read(css);
    const over = ([r, g, b, a]: Colour, [x, y, z]: Colour): Colour => [r * a + x * (1 - a), g * a + y * (1 - a), b * a + z * (1 - a), 1];
    const behind = (element: Element | null): Colour | null => {
        if (!element) return [255, 255, 255, 1];
        const { backgroundColor, backgroundImage } = getComputedStyle(element);
        const own = colour(backgroundColor);
        const below = own[3] === 1 ? own : behind(element.parentElement);
        return backgroundImage === 'none' ? below && over(own, below) : null;
    };
    const light = ([r, g, b]: Colour): number =>
        [r, g, b].reduce((sum, of, i) => {
            const share = of / 255;
            return sum + ([0.2126, 0.7152, 0.0722][i] ?? 0) * (share <= 0.04045 ? share / 12.92 : ((share + 0.055) / 1.055) ** 2.4);
        }, 0.05);
    const found: string[] = [];
    const look = (theme: string): void => {
        const walker = document.createTreeWalker(document.querySelector(part) ?? document, NodeFilter.SHOW_TEXT);
        for (let node = walker.nextNode(); node; node = walker.nextNode()) {
            const parent = node.parentElement;
            if (!node.textContent?.trim() || !parent?.checkVisibility({ visibilityProperty: true, opacityProperty: true })) continue;
            const back = behind(parent);
            if (!back || parent.closest(`:disabled, svg, script, style, .visually-hidden, .skip, ${others}`)) continue;
            const { color, fontSize, fontWeight } = getComputedStyle(parent);
            const [a, b] = [light(over(colour(color), back)), light(back)];
            const ratio = Math.max(a, b) / Math.min(a, b);
            const isLarge = parseFloat(fontSize) >= (Number(fontWeight) >= 700 ? 18.66 : 24);
            if (ratio < (isLarge ? 3 : 4.5)) found.push(`${theme}: ${ratio.toFixed(1)}: ${node.textContent.trim()}`);
        }
    };
    for (const theme of ['dark', 'light']) {
        document.documentElement.dataset.theme = theme;
        look(theme);
    }
    return found;
}

async function ask(page: Page, part: string, rules: object): Promise<string[]> {
    if (!(await page.evaluate(() => 'axe' in globalThis))) await page.evaluate(await readFile(AXE, 'utf8'));
    return page.evaluate(serious, { part, others: OTHERS, rules });
}

/** What bars somebody in this part of the page, in any language. */
export async function barriers(page: Page, part: 'body' | 'main' | 'dialog[open]'): Promise<string[]> {
    const found = await ask(page, part, { rules: { 'color-contrast': { enabled: false }, [SPOKEN]: { enabled: false } } });
    return [...found, ...(await page.evaluate(faint, { part, others: OTHERS }))];
}

/** Elements that are spoken otherwise than they are written; for a page in English. */
export function misnamed(page: Page): Promise<string[]> {
    return ask(page, 'body', { runOnly: [SPOKEN] });
}
