// SPDX-License-Identifier: MIT
// m512 in Python behind the interface of model/file-formats.ts. Runs in the worker, and in Node for the tests.

import type { PyodideAPI } from 'pyodide';
import type { Difference, FileFormats, Finding, NoRoom, Opened, Refused, Saved } from '../model/file-formats.ts';

/** Answers of bridge.py. */
interface Answer {
    readonly error?: string;
    readonly no_room?: string;
    readonly image?: Uint8Array;
    readonly file?: Uint8Array;
    readonly notes?: readonly string[];
    readonly losses?: readonly string[];
    readonly found?: readonly { page: number; text: string; is_fault: boolean }[];
    readonly changes?: readonly Difference[];
}

type Question = 'opened' | 'saved' | 'checked' | 'differences';

export class PythonFormats implements FileFormats {
    private readonly python: PyodideAPI;

    /** python: an instance with python.zip as its standard library. */
    constructor(python: PyodideAPI) {
        this.python = python;
    }

    async open(name: string, data: Uint8Array, leaveOut = false): Promise<Opened | NoRoom | Refused> {
        const answer = this.ask('opened', name, data, leaveOut);
        if (answer.no_room !== undefined) return { kind: 'no-room', pages: answer.no_room };
        if (!answer.image) return refused(answer);
        return { kind: 'opened', image: answer.image, notes: answer.notes ?? [], losses: answer.losses ?? [] };
    }

    async save(name: string, image: Uint8Array): Promise<Saved | Refused> {
        const answer = this.ask('saved', name, image);
        return answer.file ? { kind: 'saved', file: answer.file, losses: answer.losses ?? [] } : refused(answer);
    }

    async check(image: Uint8Array): Promise<readonly Finding[]> {
        const { found = [] } = this.ask('checked', image);
        return found.map(({ page, text, is_fault }) => ({ page, text, isFault: is_fault }));
    }

    async differences(first: Uint8Array, second: Uint8Array): Promise<readonly Difference[]> {
        return this.ask('differences', first, second).changes ?? [];
    }

    /** Copies everything, so that no reference to Python's memory leaves this function. */
    private ask(question: Question, ...what: readonly (string | boolean | Uint8Array)[]): Answer {
        const bridge = this.python.pyimport('bridge');
        const answer = bridge[question](...what);
        try {
            return answer.toJs({ dict_converter: Object.fromEntries, create_pyproxies: false }) as Answer;
        } finally {
            answer.destroy();
            bridge.destroy();
        }
    }
}

function refused(answer: Answer): Refused {
    return { kind: 'refused', text: answer.error ?? 'm512 gave no answer' };
}
