// SPDX-License-Identifier: MIT
// Fingers on a tablet's screen. Playwright can only tap, so other gestures use the browser's touch events.
import type { CDPSession, Page } from 'playwright-core';

export interface Point {
    readonly x: number;
    readonly y: number;
}

/** Events of a drag, as many as a quick finger makes. */
const MOVES = 6;

export class Fingers {
    private readonly page: Page;
    private readonly session: CDPSession;

    private constructor(page: Page, session: CDPSession) {
        this.page = page;
        this.session = session;
    }

    static async on(page: Page): Promise<Fingers> {
        return new Fingers(page, await page.context().newCDPSession(page));
    }

    async down(...points: readonly Point[]): Promise<void> {
        await this.send('touchStart', points);
    }

    async to(...points: readonly Point[]): Promise<void> {
        await this.send('touchMove', points);
    }

    async up(...left: readonly Point[]): Promise<void> {
        await this.send('touchEnd', left);
    }

    /** Drags one finger from a point by an offset. */
    async drag(from: Point, dx: number, dy: number): Promise<void> {
        await this.down(from);
        for (let i = 1; i <= MOVES; i++) await this.to({ x: from.x + (dx * i) / MOVES, y: from.y + (dy * i) / MOVES });
        await this.up();
    }

    /** Drags two fingers, one after the other down, each by its offset. */
    async pinch(a: Point, b: Point, byA: Point, byB: Point): Promise<void> {
        await this.down(a);
        await this.to({ x: a.x + 3, y: a.y });
        await this.down(a, b);
        const moved = (point: Point, by: Point, i: number): Point => ({ x: point.x + (by.x * i) / MOVES, y: point.y + (by.y * i) / MOVES });
        for (let i = 1; i <= MOVES; i++) await this.to(moved(a, byA, i), moved(b, byB, i));
        await this.up();
    }

    private async send(type: 'touchStart' | 'touchMove' | 'touchEnd', points: readonly Point[]): Promise<void> {
        await this.session.send('Input.dispatchTouchEvent', { type, touchPoints: points.map(({ x, y }, id) => ({ x, y, id })) });
        await this.page.evaluate(() => new Promise(resolve => requestAnimationFrame(resolve))); // a finger is slower than a frame
    }
}
