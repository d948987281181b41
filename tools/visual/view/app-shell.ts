// SPDX-License-Identifier: MIT
// The page: header, picture, areas in tabs, status bar.

import { ActionBar } from './action-bar.ts';
import { AreaTabs } from './area-tabs.ts';
import type { SessionState, Tab } from './session/session.ts';
import { FilesMenu } from './editor/files-menu.ts';
import { CurvesPane } from './editor/curves-pane.ts';
import { EDITING_START } from './editor/editing.ts';
import type { Editing } from './editor/editing.ts';
import { AS_STORED } from '../model/motion.ts';
import type { Shape } from '../model/motion.ts';
import { PoseBar } from './editor/pose-bar.ts';
import { StepsPane } from './editor/steps-pane.ts';
import { define, make } from './element.ts';
import { ChecksPane } from './editor/checks-pane.ts';
import { CompareDialog } from './editor/compare-dialog.ts';
import { EditBar } from './editor/edit-bar.ts';
import { LinksPane } from './editor/links-pane.ts';
import { PagesPane } from './editor/pages-pane.ts';
import { SentCard } from './editor/sent-card.ts';
import { TourCard } from './editor/tour.ts';
import { FirstMinute } from './first-minute.ts';
import { KeysDialog } from './keys-dialog.ts';
import { RobotPane } from './robot-pane.ts';
import { MoreMenu } from './more-menu.ts';
import { RemotePad } from './remote-pad.ts';
import { RobotView } from './robot-view.ts';
import { StatusBar } from './status-bar.ts';
import { Store } from './store.ts';
import { TerminalPane } from './terminal-pane.ts';
import { LanguageChoice } from './language-choice.ts';
import { TEXTS } from './texts/texts.ts';
import { changeTheme, showTheme } from './theme.ts';
import { SessionElement } from './session-element.ts';
import './app-shell.css';

/** Areas that show the document. */
const EDITING: readonly Tab[] = ['steps', 'curves', 'pages', 'links', 'checks'];

export class AppShell extends SessionElement {
    private readonly editing = new Store<Editing>(EDITING_START);
    private readonly shape = new Store<Shape>(AS_STORED);
    private readonly tabs = new AreaTabs();
    private readonly first = new FirstMinute();
    private readonly files = new FilesMenu();
    private readonly panels = new Map<Tab, HTMLElement>();
    private readonly simulated = make('button', { onclick: () => this.session.useSimulated() }, TEXTS.menu.robotInPage);
    private readonly yours = make('button', { onclick: () => void this.session.connectYours() }, TEXTS.menu.yourRobot);
    private readonly servos = make('button', { onclick: () => void this.session.connectServos() }, TEXTS.menu.myServos);
    private readonly newVersion = make(
        'button',
        { class: 'wanted', hidden: true, title: TEXTS.page.newVersion, onclick: () => this.session.takeNewVersion() },
        TEXTS.page.reload,
    );
    private readonly editBar = new EditBar();
    private readonly keys = new KeysDialog();
    private readonly areas = make('div', { class: 'areas' });
    private readonly sheet = make('button', {
        class: 'sheet',
        'aria-label': TEXTS.areas.areas,
        'aria-expanded': 'true',
        onclick: () => this.foldSheet(!this.isFolded),
    });
    private startTour: () => void = () => undefined;

    connectedCallback(): void {
        showTheme();
        const actions = this.give(new ActionBar());
        const { editing, shape } = this;
        const robot = this.give(new RobotView(), { editing, cover: actions });
        const poses = this.give(new PoseBar(), { editing, margin: () => robot.margin, touches: () => robot.touches });
        this.addPanel('remote', this.give(new RemotePad(), { shape, onPad: () => this.first.close() }));
        this.addPanel('steps', this.give(new StepsPane(), { editing }));
        const pages = this.give(new PagesPane());
        const compare = this.give(new CompareDialog());
        pages.onCompare = this.editBar.onTransfer = () => void compare.open();
        this.addEventListener('open-steps', () => this.session.show('steps'));
        this.addPanel('curves', this.give(new CurvesPane(), { shape }));
        this.addPanel('pages', pages);
        this.addPanel('links', this.give(new LinksPane()));
        this.addPanel('checks', this.give(new ChecksPane()));
        this.addPanel('terminal', this.give(new TerminalPane()));
        this.addPanel('robot', this.give(new RobotPane(), { onTilt: (front, left) => robot.tilt(front, left) }));
        const tour = this.give(new TourCard(), {
            editing,
            placeOf: part => robot.placeOf(part),
            onArea: () => this.foldSheet(false),
            onSend: () => void this.files.send(),
        });
        const first = this.give(this.first, { onTeach: () => tour.teach() });
        const sent = this.give(new SentCard(), { onSent: () => first.close(false), onTeach: () => tour.teach() });
        this.startTour = () => {
            sent.leave(); // it would lie under the tour's card
            tour.start();
        };
        this.tabs.onChoose = (tab, isClick) => (isClick ? this.choose(tab) : this.session.show(tab));
        this.areas.append(this.sheet, this.tabs, this.give(this.editBar), ...this.panels.values());
        this.replaceChildren(
            this.head(),
            make('main', {}, make('div', { class: 'stage' }, robot, poses, actions, tour, sent, first), this.areas),
            this.give(new StatusBar()),
            compare,
            this.keys.element,
        );
        this.addEventListener('click', event => this.giveKeysBack(event));
        this.listenTo(document, 'keydown', event => {
            this.keys.key(event);
            this.goBetween(event, robot);
        });
        this.disposals.push(this.session.state.watch(state => this.render(state)));
    }

    private addPanel(name: Tab, content: HTMLElement): void {
        this.panels.set(
            name,
            make('div', { id: `area-${name}`, role: 'tabpanel', 'aria-labelledby': `tab-${name}`, class: `area ${name}` }, content),
        );
    }

    private head(): HTMLElement {
        const theme = make('button', { 'aria-label': TEXTS.menu.theme, title: TEXTS.menu.theme, onclick: changeTheme }, '◐');
        const keys = make('button', { 'aria-label': TEXTS.keys.title, title: TEXTS.keys.hint, onclick: () => this.keys.open() }, '?');
        const sources = make(
            'div',
            { class: 'sources', role: 'group', 'aria-label': TEXTS.menu.whichRobot },
            this.simulated,
            this.yours,
            this.servos,
        );
        const more = this.give(new MoreMenu(), {
            content: [
                sources,
                this.give(this.files),
                make('a', { href: './licences.html' }, TEXTS.menu.licences),
                this.give(new LanguageChoice()),
                keys,
                theme,
            ],
        });
        const tour = make('button', { class: 'tour-start', title: TEXTS.page.tourHint, onclick: () => this.startTour() }, TEXTS.tour.tour);
        const skip = make('button', { class: 'skip', onclick: () => this.tabs.focusTab(this.session.state.get().tab) }, TEXTS.page.toAreas);
        return make('header', {}, skip, make('h1', {}, 'Motion512'), this.newVersion, tour, more);
    }

    /** In the remote's area a button loses the focus after a mouse click: the space bar must stop the robot, not press the button again. */
    private giveKeysBack(event: MouseEvent): void {
        const byMouse = event.detail > 0 && event.target instanceof Element;
        if (byMouse && this.session.state.get().tab === 'remote') event.target.closest('button')?.blur();
    }

    /** F6 moves the focus between picture and area. */
    private goBetween(event: KeyboardEvent, robot: RobotView): void {
        if (event.key !== 'F6' || event.ctrlKey || event.altKey || document.querySelector('dialog[open]')) return;
        event.preventDefault();
        const { tab } = this.session.state.get();
        if (robot.contains(document.activeElement)) this.tabs.focusTab(tab);
        else robot.querySelector('canvas')?.focus();
    }

    private choose(name: Tab): void {
        this.foldSheet(false);
        this.session.show(name);
    }

    private get isFolded(): boolean {
        return this.areas.classList.contains('folded');
    }

    /** On an upright screen the areas are a sheet at the bottom. Folded, it shows only its tabs, and the picture gets the space. */
    private foldSheet(folds: boolean): void {
        this.areas.classList.toggle('folded', folds);
        this.sheet.setAttribute('aria-expanded', String(!folds));
    }

    private render(state: SessionState): void {
        // If the focus is in the area that is hidden, it moves to the tab of the new one.
        const isLeft = [...this.panels].some(([name, panel]) => name !== state.tab && panel.contains(document.activeElement));
        this.editBar.hidden = !EDITING.includes(state.tab);
        this.tabs.select(state.tab);
        for (const [name, panel] of this.panels) panel.hidden = name !== state.tab;
        if (isLeft) this.tabs.focusTab(state.tab);
        this.newVersion.hidden = !state.hasNewVersion;
        this.simulated.setAttribute('aria-pressed', String(state.source === 'simulated'));
        this.yours.setAttribute('aria-pressed', String(state.source === 'yours'));
        this.servos.setAttribute('aria-pressed', String(state.source === 'servos'));
        this.yours.textContent = state.source === 'yours' && state.connection !== 'closed' ? state.portName : TEXTS.menu.yourRobot;
    }
}

define('app-shell', AppShell);
