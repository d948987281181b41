// SPDX-License-Identifier: MIT
// The terminal on the robot's serial line: Edit's full screen at 80x35, Play's shell, the boot loader's prompt. The font is as large as 80
// columns allow. Below a readable size the pane scrolls instead, and the user can go to full screen.

import { Terminal } from '@xterm/xterm';
import { TEXTS } from './texts/texts.ts';
import '@xterm/xterm/css/xterm.css';
import { define, make } from './element.ts';
import { SessionElement } from './session-element.ts';
import './terminal-pane.css';

const COLUMNS = 80;
const ROWS_MOST = 35;
const ROWS_LEAST = 24;
/** Width and height of a character at font size 1. */
const LETTER = { width: 0.602, height: 1.17 };
const FONT = { least: 12, most: 16 };
/** Gap between button and terminal. */
const BELOW_PX = 8;
const LINES_KEPT = 2000;

export class TerminalPane extends SessionElement {
    private terminal: Terminal | null = null;
    private readonly full = make(
        'button',
        { class: 'full-screen', 'aria-pressed': 'false', onclick: () => void this.fillScreen() },
        TEXTS.terminal.fullScreen,
    );

    connectedCallback(): void {
        const screen = make('div', { class: 'screen' });
        this.replaceChildren(this.full, screen);
        this.addEventListener('fullscreenchange', () =>
            this.full.setAttribute('aria-pressed', String(document.fullscreenElement === this)),
        );
        const terminal = new Terminal({
            cols: COLUMNS,
            rows: ROWS_MOST,
            scrollback: LINES_KEPT,
            fontFamily: '"DejaVu Sans Mono", ui-monospace, monospace',
            cursorBlink: false,
            screenReaderMode: false,
            theme: { background: '#10151a', foreground: '#d8e0e6', cursor: '#6db3f8' },
        });
        this.terminal = terminal;
        // Tab moves the focus, so that keyboard users can leave the terminal. No firmware needs it.
        terminal.attachCustomKeyEventHandler(event => event.key !== 'Tab');
        terminal.onData(text => this.session.type(new TextEncoder().encode(text)));
        terminal.onBinary(text => this.session.type(Uint8Array.from(text, c => c.charCodeAt(0))));
        const observer = new ResizeObserver(() => this.fit(terminal, screen));
        observer.observe(this);
        this.disposals.push(
            this.session.onText(bytes => terminal.write(bytes)),
            () => observer.disconnect(),
            () => terminal.dispose(),
        );
    }

    override focus(): void {
        this.terminal?.focus();
    }

    /** The text on the screen, line by line: for tests and screen readers. */
    get screenText(): string {
        const buffer = this.terminal?.buffer.active;
        if (!buffer) return '';
        return Array.from(
            { length: this.terminal?.rows ?? 0 },
            (_, row) => buffer.getLine(buffer.baseY + row)?.translateToString(true) ?? '',
        ).join('\n');
    }

    /** Where elements cannot go to full screen (iPhone), the terminal fills the page. */
    private async fillScreen(): Promise<void> {
        this.focus(); // at once, because the next key is for the robot and not for the button
        if (document.fullscreenElement === this) await document.exitFullscreen();
        else if (document.fullscreenEnabled) await this.requestFullscreen();
        else this.full.setAttribute('aria-pressed', String(this.classList.toggle('full')));
    }

    /** Call this only while the pane is visible. xterm measures characters on the screen and does not cache a width of 0: opened while
     *  hidden, it would measure them again for every line of the robot, 70 ms on a slow computer. */
    private open(terminal: Terminal, screen: HTMLElement): void {
        terminal.open(screen);
        terminal.textarea?.setAttribute('aria-label', TEXTS.terminal.terminal);
    }

    private fit(terminal: Terminal, screen: HTMLElement): void {
        const width = this.clientWidth - 24;
        const height = this.clientHeight - 24 - this.full.offsetHeight - BELOW_PX;
        if (width <= 0 || height <= 0) return;
        if (!terminal.element) this.open(terminal, screen);
        const byWidth = width / (COLUMNS * LETTER.width);
        const byHeight = height / (ROWS_MOST * LETTER.height);
        const size = Math.max(FONT.least, Math.min(FONT.most, byWidth, Math.max(byHeight, FONT.least)));
        const rows = Math.floor(height / (size * LETTER.height));
        terminal.options.fontSize = Math.floor(size * 2) / 2;
        terminal.resize(COLUMNS, Math.max(ROWS_LEAST, Math.min(ROWS_MOST, rows)));
        this.session.terminalSize({ rows: terminal.rows, columns: terminal.cols });
    }
}

define('terminal-pane', TerminalPane);
