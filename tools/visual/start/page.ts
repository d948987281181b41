// SPDX-License-Identifier: MIT
// motions.html: a card with a picture for each motion. Each card is a link that opens the page with the robot playing the motion.

import type { Texts } from '../view/texts/texts.ts';
import type { StartMotion } from './motions.ts';

/** The name of the start page's file in this language. */
export function startFile(language: string): string {
    return language === 'en' ? 'motions.html' : `motions.${language}.html`;
}

export interface Card extends StartMotion {
    /** The part of the link after the address of the robot's page, with the motion. */
    readonly address: string;
}

const STYLE = `
:root { color-scheme: light dark; --ground: #f4f5f3; --panel: #fff; --ink: #1b2024; --soft: #56606a; --line: #d7dad5; --accent: #0b67c2 }
@media (prefers-color-scheme: dark) { :root { --ground: #14181c; --panel: #cdd6dc; --ink: #e7ebee; --soft: #a3afba; --line: #343d46; --accent: #6db3f8 } }
* { box-sizing: border-box }
body { margin: 0 auto; max-width: 70rem; padding: 20px; background: var(--ground); color: var(--ink); font: 15px/1.45 system-ui, sans-serif }
header { display: flex; flex-wrap: wrap; gap: 4px 20px; align-items: baseline; justify-content: space-between }
h1 { margin: 0; font-size: 20px }
a { color: var(--accent) }
ul { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(46%, 200px), 1fr)); gap: 12px; margin: 20px 0; padding: 0; list-style: none }
li a { display: block; height: 100%; padding-bottom: 12px; border: 1px solid var(--line); border-radius: 8px; overflow: hidden; color: inherit; text-decoration: none }
li a:hover { border-color: var(--accent) }
:focus-visible { outline: 2px solid var(--accent); outline-offset: 2px }
img { display: block; width: 100%; height: auto; margin-bottom: 8px; background: var(--panel) }
b, span { display: block; padding: 0 12px }
b { font-size: 17px }
span { color: var(--soft) }`;

/** others: the page's other languages, code -> name. */
export function startPage(cards: readonly Card[], language: string, { first, start }: Texts, others: ReadonlyMap<string, string>): string {
    const query = language === 'en' ? '' : `?lang=${language}`;
    const items = cards.map(({ name, address }) => {
        const [title = '', text = ''] = start.cards[name] ?? [];
        return `<li><a href="./${query}${address}"><picture><source media="(prefers-reduced-motion: reduce)" srcset="./motions/${name}-still.svg"><img src="./motions/${name}.svg" alt="" width="320" height="320"></picture><b>${title}</b><span>${text}</span></a></li>`;
    });
    const languages = [...others].map(([code, name]) => `<a href="${startFile(code)}" lang="${code}" hreflang="${code}">${name}</a>`);
    return `<!doctype html>
<html lang="${language}">
<head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1"><link rel="icon" href="./icon.svg"><title>${start.title}</title>
<style>${STYLE}</style></head>
<body><header><h1>${first.what}</h1><a href="./${query}">${start.toRobot}</a></header>
<p>${start.choose}</p>
<ul>
${items.join('\n')}
</ul>
<nav>${languages.join(' · ')}</nav>
</body></html>
`;
}
