// SPDX-License-Identifier: MIT
// The page: head, picture, areas in tabs, strip.

import { ActionBar } from './action-bar.ts';
import type { Desk, DeskState, Tab } from './desk.ts';
import { FilesMenu } from './editor/files-menu.ts';
import { CurvesPane } from './editor/curves-pane.ts';
import { EDITING_START } from './editor/editing.ts';
import type { Editing } from './editor/editing.ts';
import { PoseBar } from './editor/pose-bar.ts';
import { StepsPane } from './editor/steps-pane.ts';
import { define, make } from './element.ts';
import { ChecksPane } from './editor/checks-pane.ts';
import { CompareDialog } from './editor/compare-dialog.ts';
import { EditBar } from './editor/edit-bar.ts';
import { LinksPane } from './editor/links-pane.ts';
import { PagesPane } from './editor/pages-pane.ts';
import { TourCard } from './editor/tour.ts';
import { KeysDialog } from './keys-dialog.ts';
import { LabPane } from './lab-pane.ts';
import { MoreMenu } from './more-menu.ts';
import { RemotePad } from './remote-pad.ts';
import { RobotView } from './robot-view.ts';
import { StatusStrip } from './status-strip.ts';
import { Store } from './store.ts';
import { TerminalPane } from './terminal-pane.ts';
import { TEXTS } from './texts.ts';
import './app-shell.css';

const TABS: readonly (readonly [Tab, string])[] = [
    ['remote', 'Remote'],
    ['steps', 'Steps'],
    ['curves', 'Curves'],
    ['pages', 'Pages'],
    ['links', 'Links'],
    ['checks', 'Checks'],
    ['terminal', 'Terminal'],
    ['lab', 'Lab'],
];
/** Areas that show the document. */
const EDITING: readonly Tab[] = ['steps', 'curves', 'pages', 'links', 'checks'];

export class AppShell extends HTMLElement {
    desk!: Desk; // set before it is connected
    private readonly editing = new Store<Editing>(EDITING_START);
    private readonly tabs = new Map<Tab, HTMLButtonElement>();
    private readonly panels = new Map<Tab, HTMLElement>();
    private readonly simulated = make('button', { onclick: () => this.desk.useSimulated() }, 'Robot in this page');
    private readonly yours = make('button', { onclick: () => void this.desk.connectYours() }, 'Your robot …');
    private readonly newVersion = make(
        'button',
        { class: 'wanted', hidden: true, title: TEXTS.newVersion, onclick: () => this.desk.takeNewVersion() },
        'New version: reload',
    );
    private readonly editBar = new EditBar();
    private readonly keys = new KeysDialog();
    private readonly areas = make('div', { class: 'areas' });
    private readonly sheet = make('button', {
        class: 'sheet',
        'aria-label': 'Areas',
        'aria-expanded': 'true',
        onclick: () => this.foldSheet(!this.isFolded),
    });
    private startTour: () => void = () => undefined;
    private unwatch: () => void = () => undefined;

    connectedCallback(): void {
        const robot = Object.assign(this.give(new RobotView()), { editing: this.editing });
        const poses = Object.assign(this.give(new PoseBar()), {
            editing: this.editing,
            margin: () => robot.margin,
            touches: () => robot.touches,
        });
        const lab = this.give(new LabPane());
        lab.onTilt = (front, left) => robot.tilt(front, left);
        this.addPanel('remote', this.give(new RemotePad()));
        this.addPanel('steps', Object.assign(this.give(new StepsPane()), { editing: this.editing }));
        const pages = this.give(new PagesPane());
        const compare = this.give(new CompareDialog());
        pages.onCompare = this.editBar.onTransfer = () => void compare.open();
        this.addEventListener('open-steps', () => this.desk.show('steps'));
        this.addPanel('curves', this.give(new CurvesPane()));
        this.addPanel('pages', pages);
        this.addPanel('links', this.give(new LinksPane()));
        this.addPanel('checks', this.give(new ChecksPane()));
        this.addPanel('terminal', this.give(new TerminalPane()));
        this.addPanel('lab', lab);
        const tour = Object.assign(this.give(new TourCard()), { editing: this.editing, placeOf: (shape: string) => robot.placeOf(shape) });
        this.startTour = () => tour.start();
        this.areas.append(this.sheet, this.tabList(), this.give(this.editBar), ...this.panels.values());
        tour.onArea = () => this.foldSheet(false);
        this.replaceChildren(
            this.head(),
            make('main', {}, make('div', { class: 'stage' }, robot, poses, this.give(new ActionBar()), tour), this.areas),
            this.give(new StatusStrip()),
            compare,
            this.keys.element,
        );
        this.addEventListener('click', event => this.giveKeysBack(event));
        const unlisten = this.keys.listen();
        const between = (event: KeyboardEvent): void => this.goBetween(event, robot);
        document.addEventListener('keydown', between);
        const unwatch = this.desk.state.watch(state => this.render(state));
        this.unwatch = () => {
            unlisten();
            document.removeEventListener('keydown', between);
            unwatch();
        };
    }

    disconnectedCallback(): void {
        this.unwatch();
    }

    private give<T extends HTMLElement & { desk: Desk }>(element: T): T {
        element.desk = this.desk;
        return element;
    }

    private addPanel(name: Tab, content: HTMLElement): void {
        this.panels.set(
            name,
            make('div', { id: `area-${name}`, role: 'tabpanel', 'aria-labelledby': `tab-${name}`, class: `area ${name}` }, content),
        );
    }

    private head(): HTMLElement {
        const theme = make('button', { 'aria-label': 'Light or dark', title: 'Light or dark', onclick: () => this.changeTheme() }, '◐');
        const keys = make('button', { 'aria-label': 'Keys', title: 'Keys (?)', onclick: () => this.keys.open() }, '?');
        const sources = make('div', { class: 'sources', role: 'group', 'aria-label': 'Which robot' }, this.simulated, this.yours);
        const more = Object.assign(new MoreMenu(), {
            content: [sources, this.give(new FilesMenu()), make('a', { href: './licences.html' }, 'Licences'), keys, theme],
        });
        const tour = make(
            'button',
            { class: 'tour-start', title: 'Two minutes to the first motion', onclick: () => this.startTour() },
            'Tour',
        );
        const skip = make('button', { class: 'skip', onclick: () => this.tabs.get(this.desk.state.get().tab)?.focus() }, 'To the areas');
        return make('header', {}, skip, make('h1', {}, 'Motion512'), this.newVersion, tour, more);
    }

    /** A button that the mouse has pressed does not keep the keys: beside the remote, the space bar is to stop and not to press it again. */
    private giveKeysBack(event: MouseEvent): void {
        const byMouse = event.detail > 0 && event.target instanceof Element;
        if (byMouse && this.desk.state.get().tab === 'remote') event.target.closest('button')?.blur();
    }

    /** F6: from the picture to the area, and back. */
    private goBetween(event: KeyboardEvent, robot: RobotView): void {
        if (event.key !== 'F6' || event.ctrlKey || event.altKey || document.querySelector('dialog[open]')) return;
        event.preventDefault();
        const { tab } = this.desk.state.get();
        if (robot.contains(document.activeElement)) this.tabs.get(tab)?.focus();
        else robot.querySelector('canvas')?.focus();
    }

    private changeTheme(): void {
        const root = document.documentElement;
        const isDark = getComputedStyle(root).getPropertyValue('--ground').trim() === '#14181c';
        root.dataset['theme'] = isDark ? 'light' : 'dark';
    }

    private tabList(): HTMLElement {
        const list = make('div', { role: 'tablist', 'aria-label': 'Areas' });
        for (const [name, title] of TABS) {
            const tab = make(
                'button',
                { role: 'tab', id: `tab-${name}`, 'aria-controls': `area-${name}`, onclick: () => this.choose(name) },
                title,
            );
            tab.addEventListener('keydown', event => this.moveTab(event, name));
            this.tabs.set(name, tab);
            list.append(tab);
        }
        return list;
    }

    private choose(name: Tab): void {
        this.foldSheet(false);
        this.desk.show(name);
    }

    private get isFolded(): boolean {
        return this.areas.classList.contains('folded');
    }

    /** On end, the areas are a sheet from below: folded, only its tabs are left, and the picture has the room. */
    private foldSheet(folds: boolean): void {
        this.areas.classList.toggle('folded', folds);
        this.sheet.setAttribute('aria-expanded', String(!folds));
    }

    private moveTab(event: KeyboardEvent, from: Tab): void {
        const by = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
        if (by === undefined) return;
        event.preventDefault();
        const index = TABS.findIndex(([name]) => name === from);
        const [next] = TABS[(index + by + TABS.length) % TABS.length] ?? [from];
        this.desk.show(next);
        this.tabs.get(next)?.focus();
    }

    private render(state: DeskState): void {
        // Whoever was in an area that goes with the keyboard is at the tab of the one that comes.
        const isLeft = [...this.panels].some(([name, panel]) => name !== state.tab && panel.contains(document.activeElement));
        this.editBar.hidden = !EDITING.includes(state.tab);
        for (const [name, tab] of this.tabs) {
            tab.setAttribute('aria-selected', String(name === state.tab));
            tab.tabIndex = name === state.tab ? 0 : -1;
            const panel = this.panels.get(name);
            if (panel) panel.hidden = name !== state.tab;
        }
        if (isLeft) this.tabs.get(state.tab)?.focus({ preventScroll: true });
        this.newVersion.hidden = !state.hasNewVersion;
        this.simulated.setAttribute('aria-pressed', String(state.source === 'simulated'));
        this.yours.setAttribute('aria-pressed', String(state.source === 'yours'));
        this.yours.textContent = state.source === 'yours' && state.connection !== 'closed' ? state.portName : 'Your robot …';
    }
}

define('app-shell', AppShell);
