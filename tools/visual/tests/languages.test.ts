// SPDX-License-Identifier: MIT
// Every language has every text, in its own words and with the same arguments. Also the choice of the page's language.
import { readFileSync } from 'node:fs';
import { expect, test } from 'vitest';
import type { Body } from '../model/body.ts';
import DE from '../view/texts/de.ts';
import { EN } from '../view/texts/en.ts';
import ES from '../view/texts/es.ts';
import JA from '../view/texts/ja.ts';
import KO from '../view/texts/ko.ts';
import { LANGUAGES, languageFor } from '../view/texts/languages.ts';
import PSEUDO from '../view/texts/pseudo.ts';
import type { Texts } from '../view/texts/texts.ts';

const OTHERS: Readonly<Record<string, Texts>> = { de: DE, es: ES, ja: JA, ko: KO };
/** Texts that are the same in some languages: names of programs and formats, and borrowed words. */
const SAME =
    /^\W*(OK|Link|Tour|Robot|Insert|Delete|Shift|Pose|Hand|Pause|Servos?|Terminal|Firmware|Name|Text|in|Error|No|Intel HEX|RoboPlus)?\W*$/i;
/** Keys with the same name in every language. */
const KEY = /^([^a-z]*|.*\b(Tab|Esc|F\d|Alt|Enter|Ctrl|W A S D|Shift|Insert|Delete|Page Up)\b.*|[A-Z])$/;

type Leaf = string | ((...parts: never[]) => unknown);

/** All texts of a language by path: "steps.play". */
function leaves(value: unknown, place = ''): [string, Leaf][] {
    if (typeof value === 'string' || typeof value === 'function') return [[place, value as Leaf]];
    return Object.entries(value as Record<string, unknown>).flatMap(([name, one]) => leaves(one, place === '' ? name : `${place}.${name}`));
}

/** A text made with recognisable arguments: numbers 71, 72 ..., strings "<3>". */
function made(leaf: Leaf, place: string): string {
    if (typeof leaf === 'string') return leaf;
    const text = leaf(...(partsFor(place) as never[]));
    return String(text);
}

function partsFor(place: string): unknown[] {
    const special: Readonly<Record<string, unknown[]>> = {
        'robot.servosFound': [71, [72, 73]],
        'robotPane.lit': [['<1>', '<2>']],
        'layers.moved': [[71, 72]],
        'curves.fast': [[71, 72]],
        'curves.lags': [
            [
                [71, 72],
                [73, 74],
            ],
        ],
        'picture.touching': [[{ a: '<1>', b: '<2>', mm: 71 }], 72],
        'links.link': ['<1>', '<2>', '<3>', '<4>', true],
        'links.toItself': [['<1>', '<2>']],
        'trials.list': [['<1>', '<2>']],
        'trials.rises': [{ step: 71, motion: '<1>', seconds: '<2>' }],
        'trials.falls': [{ step: 71, motion: '<1>', seconds: '<2>' }],
        'trials.touch': [[71, 72, 73], '<1>', '<2>', 74],
        'motion.title': [71, '<1>'],
        'motion.card': [71, '<1>'],
        'remote.leadsOn': [71, '<1>'],
        'checks.tooFast': [71, '<1>', '<2>', 72],
        'checks.outOfReach': [71, '<1>'],
    };
    return special[place] ?? NUMBERS.get(place) ?? ['<1>', '<2>', '<3>'];
}

/** The arguments that are numbers: those that are not strings in the English text. */
const NUMBERS = new Map<string, unknown[]>(
    leaves(EN).flatMap(([place, leaf]) => {
        if (typeof leaf !== 'function') return [];
        const parts =
            /^\(?([^)=]*)\)?\s*=>/
                .exec(leaf.toString())?.[1]
                ?.split(',')
                .map(name => name.trim()) ?? [];
        const isNumber = (name: string): boolean =>
            /^(step|steps|page|count|number|total|done|mm|servo|times|at|of|faults|notes|damaged|more|position|volts|lateMs)$/.test(name);
        return [[place, parts.map((name, i) => (isNumber(name) ? 71 + i : `<${i + 1}>`))] as const];
    }),
);

/** The arguments found in a text, each once. */
function partsIn(text: string): string[] {
    return [...new Set(text.match(/<\d>|7[1-9]/g) ?? [])].sort();
}

test.each(Object.entries(OTHERS))('%s: every text is there, has the same parts as in English, and is not English', (_, texts) => {
    const english = new Map(leaves(EN));
    const theirs = new Map(leaves(texts));
    expect([...theirs.keys()].filter(place => !place.startsWith('keys.'))).toEqual(
        [...english.keys()].filter(place => !place.startsWith('keys.')),
    );
    const wrong: string[] = [];
    for (const [place, leaf] of english) {
        const other = theirs.get(place);
        if (other === undefined || place === 'menu.translation') continue;
        const [ours, own] = [made(leaf, place), made(other, place)];
        const letters = ours.replaceAll(/<\d>|7[1-9]/g, '');
        if (own.trim() === '') wrong.push(`${place}: empty`);
        if (partsIn(own).join() !== partsIn(ours).join()) wrong.push(`${place}: ${own} has not the parts of ${ours}`);
        const isSame = own === ours && !SAME.test(letters) && !(place.startsWith('keys.') && KEY.test(ours));
        if (isSame) wrong.push(`${place}: ${ours}`);
        if (/undefined|NaN|\[object/.test(own)) wrong.push(`${place}: ${own}`);
    }
    expect(wrong).toEqual([]);
});

test.each(Object.entries(OTHERS))('%s: says that no native reader has read it, and what m512 and the robot are told stays', (_, texts) => {
    expect(texts.menu.translation).not.toBe('');
    const theirs = new Map(leaves(texts));
    for (const [place, leaf] of leaves(EN)) {
        if (typeof leaf !== 'string') continue;
        const other = theirs.get(place);
        for (const [command] of leaf.matchAll(/m512 flash [a-z0-9-]+\.hex|@reset|\bGO\b|\bSAVE\b|\bUNDO\b/g))
            expect(other, place).toContain(command);
    }
});

test('joints and limbs of the body have a name in each language', () => {
    const body = JSON.parse(readFileSync(new URL('../../../build/wasm/body.json', import.meta.url), 'utf8')) as Body; // made by body_files.py
    for (const [language, { joints, limbs }] of Object.entries({ en: EN, ...OTHERS })) {
        expect(Object.keys(joints).sort(), language).toEqual(body.joints.map(({ name }) => name).sort());
        expect(Object.keys(limbs).sort(), language).toEqual(body.links.map(({ name }) => name).sort());
    }
});

test('the address before what was chosen, that before the browser, English where nothing fits', () => {
    const page = (query: string): URL => new URL(`https://example.org/robot/${query}`);
    expect(languageFor(page('?lang=ja'), 'de', ['ko'])).toBe('ja');
    expect(languageFor(page(''), 'de', ['ko'])).toBe('de');
    expect(languageFor(page(''), null, ['fr-FR', 'es-MX', 'de'])).toBe('es');
    expect(languageFor(page('?lang=toString'), 'xx', ['fr'])).toBe('en');
    expect(languageFor(page(''), 'en', ['de'])).toBe('en');
    expect(Object.keys(LANGUAGES).sort()).toEqual(['en', ...Object.keys(OTHERS)].sort());
});

test('the language for tests has no plain letters but those of its parts, and is 40 % longer', () => {
    expect(PSEUDO.page.close).toMatch(/^\[Çļöšèö+\]$/);
    expect(PSEUDO.motion.title(3, 'wave')).toMatch(/^\[ɱöţìöñ 3 \(wave\) ö+\]$/);
    const ours = new Map(leaves(EN));
    for (const [place, leaf] of leaves(PSEUDO)) {
        if (typeof leaf !== 'string') continue;
        expect(leaf, place).not.toMatch(/[A-Za-z]{2}/);
        const english = String(ours.get(place));
        if (/[a-z]/i.test(english)) expect(leaf.length, place).toBeGreaterThanOrEqual(1.4 * english.length);
    }
});
