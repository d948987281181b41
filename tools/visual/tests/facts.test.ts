// SPDX-License-Identifier: MIT
// What C says is not said again: its numbers come from build/wasm/facts.ts, and stand nowhere else in TypeScript.
import { readFileSync, readdirSync } from 'node:fs';
import { resolve } from 'node:path';
import { expect, test } from 'vitest';
import * as facts from '../model/facts.ts';

const ROOT = resolve(import.meta.dirname, '..');
const FOLDERS = ['app', 'files', 'model', 'robot', 'sim', 'view'];
/** Numbers that can hardly be anything else than what C calls so: sizes, limits, offsets, rates. */
const TELLING = new Set([
    facts.PAGE_BYTES,
    facts.PAGE_COUNT,
    facts.PAGE_COUNT - 1,
    facts.PAGE_JOINTS,
    facts.PAGE_POS_MAX,
    facts.PAGE_POS_MAX + 1,
    facts.PAGE_POS_UNUSED,
    facts.PAGE_POS_TORQUE_OFF,
    facts.PAGE_BYTES * facts.PAGE_COUNT,
    facts.LINK_CODE_STOP,
    facts.SHAPE_RATE_MAX,
    facts.SHAPE_AMPLITUDE_MAX,
    facts.PAGE_FACTS_BATTERY_DV,
    facts.PAGE_FACTS_BATTERY_DV / 10,
    facts.MEM_APP_END,
    facts.MEM_MOTION_START,
    facts.MEM_BOOT_END,
    facts.MEM_EEPROM_BYTES,
    facts.MEM_EE_BOOT_MODE,
    facts.BOARD_API_BUFFER_BYTES,
    facts.MOTION_API_CURVE_TICKS,
    facts.M128_HZ,
    125_000,
    16_000,
    1 / facts.PLAYER_TICKS_PER_SECOND,
    1000 / facts.PLAYER_TICKS_PER_SECOND,
    0x1021,
    0x55,
]);
/** Lines with such a number that mean something else, or are the other end of a talk. A line that is gone is to be taken out here. */
const OTHERS: Readonly<Record<string, string>> = {
    'app/editor.ts: const CURVE_TICKS = 4096;': 'how much is drawn',
    'model/page-format.ts: const ERASED = 0xff;': 'what flash is made of',
    'model/page.ts: export const BYTE_MAX = 0xff;': 'what a byte is',
    'model/page.ts: bytes[at + 2 * id] = value & 0xff;': 'what a byte is',
    'model/motion.ts: return { share: both & 0xff, rest: both >> 8 };': 'what a byte is',
    'robot/connection.ts: const ASK_AGAIN_MS = 400;': 'a time',
    'robot/line-parser.ts: const LINE_MAX = 8192;': 'a limit of the parser',
    'robot/remote.ts: const low = word & 0xff;': 'what a byte is',
    'robot/remote.ts: return Uint8Array.of(0xff, 0x55, low, low ^ 0xff, high, high ^ 0xff);':
        'the end of the line that makes packets; C takes them apart',
    'robot/web-serial-port.ts: const BUFFER_BYTES = 16_384;': 'a buffer of the browser',
    'sim/hands.ts: const GRIP = { newtonPerMetre: 150, newtonSecondPerMetre: 6, limitNewton: 14 };': 'forces',
    'sim/hands.ts: const HOLD = { move: 400, moveDamp: 50, turn: 20, turnDamp: 1.6, farthestM: 0.1, liftedM: 0.36, releaseSteps: 400 };':
        'forces',
    'sim/machine.ts: board.writeFlash(0, new Uint8Array(APPLICATION_END).fill(0xff));': 'what flash is made of',
    'sim/simulation.ts: const TRACE_LIMIT = 512;': 'how much is kept for a chart',
    'sim/trial.ts: const AFTER_TICKS = 96;': 'how long is waited',
    'view/robot-scene.ts: this.light.shadow.mapSize.set(1024, 1024);': 'pixels',
    'view/editor/checks-pane.ts: const WAIT_MS = 400;': 'a time',
    'view/editor/pose-picture.ts: const [r = 0, g = 0, b = 0] = rgb.map((value) => Math.round(255 * Math.min(1, value ** 0.75 * light)));':
        'colours',
};

/** Code without comments and texts: what is computed with. */
export function codeOf(source: string): string {
    return source
        .replaceAll(/\/\*[\s\S]*?\*\//g, '')
        .replaceAll(/(^|[^:'"`])\/\/.*$/gm, '$1')
        .replaceAll(/'(?:[^'\\\n]|\\.)*'/g, "''");
}

/** Lines that compute with a telling number. */
export function tellingLines(source: string): string[] {
    return codeOf(source)
        .split('\n')
        .map(line => line.trim())
        .filter(line => {
            const numbers = line.match(/(?<![\w.$#])(?:0x[\da-f_]+|\d[\d_]*(?:\.\d+)?)(?![\w.])/gi) ?? [];
            return numbers.some(number => TELLING.has(Number(number.replaceAll('_', ''))));
        });
}

test('no number of C is written a second time', () => {
    const sources = FOLDERS.flatMap(folder =>
        readdirSync(resolve(ROOT, folder), { recursive: true, encoding: 'utf8' }).map(name => `${folder}/${name}`),
    ).filter(name => name.endsWith('.ts') && !name.endsWith('texts.ts')); // sentences may name a number
    expect(sources.length).toBeGreaterThan(120);
    const found = new Set(sources.flatMap(name => tellingLines(readFileSync(resolve(ROOT, name), 'utf8')).map(line => `${name}: ${line}`)));
    expect([...found].filter(line => !(line in OTHERS))).toEqual([]);
    expect(
        Object.keys(OTHERS).filter(line => !found.has(line)),
        'allowed, but gone',
    ).toEqual([]);
});

test.each([
    'const POSITION_MAX = 1023;',
    'if (units > 1_023) return;',
    'page.slice(0, 0x200)',
    'goal / 128',
    'x * 7.8125',
    "board.send('x', 0xE000);",
])('%s is found', line => {
    expect(tellingLines(line)).toHaveLength(1);
});

test.each(["say('1023');", '// 1023', '/* of 512 bytes */ const a = 3;', 'x.p1023 = 5;', 'const y = 1024.5;', 'a512()'])(
    '%s is none',
    line => {
        expect(tellingLines(line)).toEqual([]);
    },
);

test('the numbers are those of the documents', () => {
    // motion/PAGE_FORMAT.md, REMOTE.md, linker/memory_map.h: by hand
    expect(facts).toMatchObject({
        PAGE_BYTES: 512,
        PAGE_COUNT: 128,
        PAGE_JOINTS: 31,
        PAGE_STEPS: 7,
        PAGE_POS_MAX: 1023,
        PAGE_AT_PLAY_CODE: 21,
        PAGE_AT_STEP0: 64,
        PLAYER_TICKS_PER_SECOND: 128,
        LINK_CODE_STOP: 255,
        REMOTE_BUTTON6: 512,
        MEM_MOTION_START: 0xe000,
        SERVO_SHAFT_FIELDS: 4,
    });
});
