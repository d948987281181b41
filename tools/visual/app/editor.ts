// SPDX-License-Identifier: MIT
// The editor joins the document's store with motion.wasm and the messages to the person. It is the only writer of the store.

import { jointPairs } from '../model/body.ts';
import type { Body } from '../model/body.ts';
import type { MotionDocument } from '../model/document.ts';
import { isSamePage, pageOf } from '../model/document.ts';
import { makeEdits } from '../model/edit.ts';
import type { Edits } from '../model/edit.ts';
import * as states from '../model/editor-state.ts';
import type { EditorState, Selection } from '../model/editor-state.ts';
import type { History } from '../model/history.ts';
import { AS_STORED, JOINTS, POSITION_MIDDLE, STANDING_PAGE } from '../model/motion.ts';
import type { Curve, Motion, Shape } from '../model/motion.ts';
import { freePage } from '../model/page-edits.ts';
import type { PageFormat } from '../model/page-format.ts';
import { readPage } from '../model/page.ts';
import type { PageView } from '../model/page.ts';
import type { Refusal, Result } from '../model/result.ts';
import type { JointPair } from '../model/step-edits.ts';
import type { EditName, Transaction } from '../model/transaction.ts';
import type { CurveOptions, Editor, Gesture } from '../view/session/editor.ts';
import { Store } from '../view/store.ts';

const CURVE_TICKS = 4096;

export interface EditorParts {
    readonly format: PageFormat;
    /** Used by this editor only. */
    readonly player: Motion;
    readonly document: MotionDocument;
    /** The motions that the robot shipped with. */
    readonly library?: readonly Uint8Array[];
}

export interface EditorEvents {
    /** A finished edit, undo or redo has changed the document. */
    changed(document: MotionDocument): void;
    refused(refusal: Refusal): void;
    opened(): void;
}

export class DocumentEditor implements Editor {
    readonly format: PageFormat;
    readonly edits: Edits;
    readonly pairs: readonly JointPair[];
    readonly state: Store<EditorState>;
    private readonly player: Motion;
    private readonly library: readonly Uint8Array[];
    private readonly events: EditorEvents;
    private readonly views = new WeakMap<Uint8Array, PageView>();
    /** The owner of the open gesture; null if none is open. */
    private holder: symbol | null = null;
    private readonly loaded: (Uint8Array | null)[] = [];

    constructor(body: Body, { format, player, document, library = [] }: EditorParts, events: EditorEvents) {
        this.format = format;
        this.edits = makeEdits(format);
        this.pairs = jointPairs(body);
        this.player = player;
        this.library = library;
        this.events = events;
        this.state = new Store(states.startState(document));
    }

    page(page: number): PageView {
        const bytes = pageOf(this.state.get().document, page);
        const view = this.views.get(bytes) ?? readPage(this.format, bytes);
        this.views.set(bytes, view);
        return view;
    }

    dispatch(edit: Result<Transaction>): boolean {
        if (!edit.ok) return this.refuse(edit.refusal);
        this.become(states.dispatch(this.state.get(), edit.value));
        return true;
    }

    gesture(label: EditName): Gesture {
        this.become(states.beginGesture(this.state.get(), label));
        const open = this.state.get().gesture;
        if (!open) throw new Error('a gesture did not begin');
        const mine = Symbol(label);
        this.holder = mine;
        const isOpen = (): boolean => this.holder === mine && this.state.get().gesture !== null;
        return {
            start: open.start,
            change: edit => {
                if (!isOpen()) return false;
                if (!edit.ok) return this.refuse(edit.refusal);
                this.show(states.changeGesture(this.state.get(), edit.value));
                return true;
            },
            finish: () => isOpen() && this.become(states.finishGesture(this.state.get())),
            cancel: () => isOpen() && this.show(states.cancelGesture(this.state.get())),
        };
    }

    undo(): void {
        this.become(states.undoOne(this.state.get()));
    }

    redo(): void {
        this.become(states.redoOne(this.state.get()));
    }

    select(change: Partial<Selection>): void {
        const state = this.state.get();
        const isFirst = change.page !== undefined && change.step === undefined;
        const chosen = { page: state.page, step: state.step, ...(isFirst ? { step: 0, steps: new Set([0]) } : {}), ...change };
        const isElsewhere = chosen.page !== state.page || chosen.step !== state.step;
        this.become({ ...(isElsewhere ? states.finishGesture(state) : state), ...chosen });
    }

    open(document: MotionDocument, history: History): void {
        const { robot, law } = this.state.get();
        this.show({
            ...states.startState(document),
            history,
            robot,
            law,
            page: this.lastEdited(history) ?? (freePage(this.format, document) || states.FIRST_PAGE),
        });
        this.events.opened();
    }

    isOfLibrary(page: number): boolean {
        const bytes = pageOf(this.state.get().document, page);
        return page > 0 && !this.format.isEmpty(bytes) && this.library.some(one => isSamePage(one, bytes));
    }

    private lastEdited(history: History): number | null {
        const pages = history.done.at(-1)?.changes.map(({ page }) => page) ?? [];
        return pages.find(page => page > 0) ?? null;
    }

    rename(name: string): void {
        const { document } = this.state.get();
        this.state.set({ document: { ...document, name } });
    }

    /** Sets the known content of the robot's pages. */
    setRobot(robot: readonly (Uint8Array | null)[]): void {
        this.state.set({ robot });
    }

    curve(page: number, options: CurveOptions = {}): Curve | null {
        this.load();
        const law = options.law ?? this.state.get().law;
        this.player.setShape(options.shape ?? AS_STORED);
        const from = options.from ?? this.firstPose(page, options.shape);
        return this.player.start(page, from, { law, code: options.code ?? 0 }) ? this.player.curve(options.ticks ?? CURVE_TICKS) : null;
    }

    topSpeed(volts: number): number {
        return this.player.topSpeed(volts);
    }

    firstPose(
        page: number,
        shape: Shape = AS_STORED,
        from: ArrayLike<number> = new Uint16Array(JOINTS).fill(POSITION_MIDDLE),
    ): Uint16Array {
        this.load();
        this.player.setShape(shape);
        return this.player.firstPose(page, from);
    }

    get standingPose(): number[] {
        const ready = this.library[STANDING_PAGE];
        const positions = ready ? readPage(this.format, ready).steps[0]?.positions : [];
        return Array.from({ length: JOINTS }, (_, id) => positions?.[id] ?? POSITION_MIDDLE);
    }

    poseAfter(page: number, step: number): number[] {
        this.load();
        this.player.setShape(AS_STORED);
        return Array.from(this.player.poseAfter(page, step, new Uint16Array(JOINTS).fill(POSITION_MIDDLE)));
    }

    /** Loads the document into the player. Only changed pages are copied. */
    private load(): void {
        for (const [page, bytes] of this.state.get().document.pages.entries()) {
            if (this.loaded[page] === bytes) continue;
            this.player.setPage(page, bytes);
            this.loaded[page] = bytes;
        }
    }

    private refuse(refusal: Refusal): false {
        this.events.refused(refusal);
        return false;
    }

    private become(next: EditorState): void {
        const before = this.state.get();
        this.show(next);
        if (next.history !== before.history) this.events.changed(next.document);
    }

    /** Keeps the cursor on an existing step. */
    private show(next: EditorState): void {
        const count = readPage(this.format, pageOf(next.document, next.page)).steps.length;
        const step = Math.max(0, Math.min(next.step, count - 1));
        const steps = [...next.steps].every(index => index < count) ? next.steps : new Set([step]);
        this.state.set({ ...next, step, steps });
    }
}
