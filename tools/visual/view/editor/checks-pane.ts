// SPDX-License-Identifier: MIT
// The area Checks: findings from the firmware, the body and m512, each with a button that goes to its place. It checks only while it is
// shown, and only pages that have changed.

import { PageChecks, checkLinks } from '../../model/checks.ts';
import type { PageFinding } from '../../model/checks.ts';
import { imageOf, pageOf } from '../../model/document.ts';
import type { MotionDocument } from '../../model/document.ts';
import type { Finding } from '../../model/file-formats.ts';
import { NOMINAL_VOLTS } from '../../model/motion.ts';
import type { Law } from '../../model/motion.ts';
import { wholeCurve } from '../../model/whole-curve.ts';
import type { Tab } from '../session/session.ts';
import { define, make, setText } from '../element.ts';
import type { PageTrial } from '../session/trials.ts';
import { PhysicsBar } from './physics-bar.ts';
import { findingText, isFaulty, titleOf } from '../texts/editor.ts';
import { jointTitle } from '../texts/robot.ts';
import { TEXTS } from '../texts/texts.ts';
import { touchText, verdictText } from '../texts/trials.ts';
import { SessionElement } from '../session-element.ts';
import './checks-pane.css';

const WAIT_MS = 400;
/** 47 s: a motion that loops is played at least that long each time that it is checked. */
const CURVE_TICKS = 6000;

interface Shown {
    readonly page: number;
    readonly step: number | null;
    readonly joint: number | null;
    readonly text: string;
    readonly isFault: boolean;
    readonly tab: Tab;
    /** Derived from poses alone; a trial in physics overrides it. */
    readonly isGuess?: boolean;
    /** Text of m512, in English. */
    readonly isQuoted?: boolean;
}

export class ChecksPane extends SessionElement {
    private readonly summary = make('p', { class: 'summary', role: 'status', 'aria-label': TEXTS.checks.result });
    private readonly list = make('ul', { 'aria-label': TEXTS.checks.findings });
    /** The law of the findings. */
    private law: Law | null = null;
    private pageChecks = new PageChecks();
    private shown: MotionDocument | null = null;
    /** The document to check next, or checked last. */
    private due: MotionDocument | null = null;
    private drawn = '';
    /** Findings of the last check, without physics. */
    private known: { readonly document: MotionDocument; readonly all: readonly Shown[]; readonly note: string } | null = null;
    private timer: ReturnType<typeof setTimeout> | undefined;

    connectedCallback(): void {
        this.replaceChildren(make('p', { class: 'purpose' }, TEXTS.checks.purpose), this.give(new PhysicsBar()), this.summary, this.list);
        const { editor, state, trials } = this.session;
        this.watch(() => this.later(), editor.state, state);
        this.watch(() => this.render(), trials.state);
        this.disposals.push(() => clearTimeout(this.timer));
    }

    private later(): void {
        const { document, gesture, law } = this.session.editor.state.get();
        if (this.session.state.get().tab !== 'checks' || gesture) return;
        if (law !== this.law) this.forget(law);
        if (document === this.shown) this.render();
        if (document === this.due) return; // state changes of the robot must not delay the check
        clearTimeout(this.timer);
        this.due = document;
        if (document === this.shown) return;
        this.timer = setTimeout(() => void this.look(document), this.shown === null ? 0 : WAIT_MS);
    }

    /** Another law moves the joints at other speeds. */
    private forget(law: Law): void {
        this.law = law;
        this.pageChecks = new PageChecks();
        this.shown = this.due = null;
    }

    private async look(document: MotionDocument): Promise<void> {
        this.shown = document;
        const own = this.ownFindings(document).map(one => this.shownOf(one));
        this.show(document, own, TEXTS.checks.checking);
        const checked = await this.session.files.formats.check(imageOf(document)).catch(() => null);
        if (this.shown !== document) return;
        const theirs = checked?.map(one => this.shownOfM512(one)) ?? [];
        // m512 describes damage better than the page's own finding does.
        const rest = checked
            ? own.filter(one => !theirs.some(other => other.page === one.page && other.text.startsWith('damaged') && one.tab === 'pages'))
            : own;
        this.show(document, [...theirs, ...rest], checked ? '' : TEXTS.checks.noM512);
    }

    private ownFindings(document: MotionDocument): PageFinding[] {
        const { editor, body } = this.session;
        const options = {
            format: editor.format,
            body,
            topSpeed: editor.topSpeed(NOMINAL_VOLTS),
            curve: (page: number) => wholeCurve(ticks => editor.curve(page, { ticks }), CURVE_TICKS),
        };
        return [...this.pageChecks.look(document, options), ...checkLinks(editor.format, document)];
    }

    private shownOf(one: PageFinding): Shown {
        const joint = this.session.body.joints.find(other => other.servo === one.joint);
        const isOfLinks = one.kind === 'exit-circle';
        const tab: Tab = isOfLinks ? 'links' : one.step === null ? 'pages' : 'steps';
        return {
            page: one.page,
            step: one.step,
            joint: one.joint,
            text: findingText(
                one,
                joint ? jointTitle(joint) : TEXTS.joint(one.joint ?? 0),
                one.after === null ? null : titleOf(this.session.editor, one.after),
            ),
            isFault: isFaulty(one),
            tab,
            isGuess: one.kind === 'tips-over',
        };
    }

    private shownOfM512({ page, text, isFault }: Finding): Shown {
        const isOfLinks = /leads to page|linked page/.test(text);
        return { page, step: null, joint: null, text, isFault, tab: isOfLinks ? 'links' : 'pages', isQuoted: true };
    }

    private show(document: MotionDocument, all: readonly Shown[], note: string): void {
        this.known = { document, all, note };
        this.render();
    }

    /** Findings from trials in physics. A robot that stands to the end is no finding. */
    private physicsFindings(): Shown[] {
        const { editor, trials: physics } = this.session;
        const { document } = editor.state.get();
        const { trials } = physics.state.get();
        return [...trials]
            .filter(([page]) => editor.format.isPlayable(pageOf(document, page)))
            .flatMap(([page, trial]) => {
                const isFresh = physics.isFresh(page);
                const verdict = trial.verdict.kind === 'stands' && trial.verdict.isWhole ? [] : [this.verdictShown(page, trial, trials)];
                const [deepest] = [...trial.touches].sort((a, b) => b.depthM - a.depthM);
                const touches = deepest
                    ? [
                          {
                              page,
                              step: deepest.step,
                              joint: null,
                              text: touchText(
                                  deepest,
                                  trial.touches.map(({ step }) => step),
                              ),
                              isFault: false,
                              tab: 'steps' as const,
                          },
                      ]
                    : [];
                return [...verdict, ...touches].map(one => ({ ...one, text: isFresh ? one.text : TEXTS.trials.stale(one.text) }));
            });
    }

    private verdictShown(page: number, { verdict }: PageTrial, trials: ReadonlyMap<number, PageTrial>): Shown {
        const [behind] = [...trials].filter(([one, trial]) => one !== page && trial.pages.includes(page));
        const text = verdictText(
            verdict,
            page,
            one => titleOf(this.session.editor, one),
            behind ? [behind[0], behind[1].verdict.kind] : null,
        );
        return {
            page: verdict.at?.page ?? page,
            step: verdict.at?.step ?? 0,
            joint: null,
            text,
            isFault: verdict.kind === 'falls',
            tab: 'steps',
        };
    }

    private render(): void {
        if (!this.known) return;
        const { document, note } = this.known;
        const tried = this.session.trials;
        const guessed = this.known.all.filter(({ page, isGuess }) => !isGuess || !tried.isJudged(page));
        const all = [...guessed, ...this.physicsFindings()];
        const { format } = this.session.editor;
        const used = document.pages.filter((bytes, page) => page > 0 && !format.isEmpty(bytes)).length;
        const faults = all.filter(one => one.isFault).length;
        const counted = all.length === 0 ? TEXTS.checks.allGood(used) : TEXTS.checks.counted(faults, all.length - faults);
        const text = [counted, note].filter(Boolean).join(' ');
        setText(this.summary, text);
        const sorted = [...all].sort((a, b) => Number(b.isFault) - Number(a.isFault) || a.page - b.page || (a.step ?? -1) - (b.step ?? -1));
        const drawn = JSON.stringify(sorted);
        if (drawn === this.drawn) return; // keeps the focus
        this.drawn = drawn;
        this.list.replaceChildren(...sorted.map(one => this.row(one)));
    }

    private row(one: Shown): HTMLElement {
        const title = titleOf(this.session.editor, one.page);
        return make(
            'li',
            { class: one.isFault ? 'fault' : 'note' },
            make('span', { class: 'sign' }, one.isFault ? TEXTS.checks.fault : TEXTS.checks.note),
            make('b', {}, title),
            make('span', { class: 'words', ...(one.isQuoted ? { lang: 'en' } : {}) }, one.text),
            make(
                'button',
                {
                    'aria-label': one.step === null ? TEXTS.checks.show(title) : TEXTS.checks.showStep(title, one.step + 1),
                    onclick: () => this.goTo(one),
                },
                TEXTS.page.show,
            ),
        );
    }

    private goTo({ page, step, joint, tab }: Shown): void {
        this.session.editor.select({ page, step: step ?? 0, steps: new Set([step ?? 0]), joints: new Set(joint === null ? [] : [joint]) });
        this.session.show(tab);
    }
}

define('checks-pane', ChecksPane);
