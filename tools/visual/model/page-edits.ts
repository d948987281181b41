// SPDX-License-Identifier: MIT
// Edits of whole pages and their headers as values.

import { isSamePage, pageOf, withChanges } from './document.ts';
import type { MotionDocument } from './document.ts';
import type { PageFormat } from './page-format.ts';
import { readPage } from './page.ts';
import type { LinkField, PageView } from './page.ts';
import { ok, refuse } from './result.ts';
import type { Result } from './result.ts';
import { changePage, editable } from './step-edits.ts';
import { transaction } from './transaction.ts';
import type { Change, EditName, Transaction } from './transaction.ts';

/** Appended to the name of a copy. */
const COPY_SIGN = ' 2';

/** The header except the name. */
export type HeaderChange = Partial<Omit<PageView, 'name' | 'steps'>>;

export interface PageTransfer {
    /** Links of other pages follow the moved page. A page's links to itself always do. */
    readonly linksFollow?: boolean;
    /** The target may hold a page, which is replaced (undo restores it). */
    readonly replace?: boolean;
}

export function rename(format: PageFormat, document: MotionDocument, page: number, name: string): Result<Transaction> {
    return changePage(format, 'rename', document, page, () => ok({ name }));
}

export function setHeader(format: PageFormat, document: MotionDocument, page: number, change: HeaderChange): Result<Transaction> {
    return changePage(format, 'set-header', document, page, () => ok(change));
}

/** target 0: no link. */
export function setLink(format: PageFormat, document: MotionDocument, page: number, link: LinkField, target: number): Result<Transaction> {
    return changePage(format, 'set-link', document, page, () => ok({ [link]: target }));
}

/** Checks that both are motion pages and that the source is not empty. */
function sourceOf(format: PageFormat, document: MotionDocument, from: number, to: number): Result<Uint8Array> {
    if (to === 0) return refuse('trim-page');
    if (!document.pages[to]) return refuse('no-such-page', String(to));
    const source = editable(format, document, from);
    if (!source.ok) return source;
    return format.isEmpty(source.value) ? refuse('page-empty', String(from)) : source;
}

export function copyPage(
    format: PageFormat,
    document: MotionDocument,
    from: number,
    to: number,
    options: PageTransfer = {},
): Result<Transaction> {
    const source = sourceOf(format, document, from, to);
    if (!source.ok) return source;
    const before = pageOf(document, to);
    if (from !== to && !format.isEmpty(before) && !options.replace) return refuse('page-in-use', String(to));
    return ok(transaction('copy-page', [{ page: to, before, after: format.relinked(source.value, new Map([[from, to]])) }]));
}

/** Copies a library page to a free page, with a new name and without a remote code. */
export function copyForEditing(
    format: PageFormat,
    document: MotionDocument,
    from: number,
): Result<{ readonly edit: Transaction; readonly page: number }> {
    const to = freePage(format, document);
    if (to === 0) return refuse('no-room');
    const copied = copyPage(format, document, from, to);
    if (!copied.ok) return copied;
    const { name } = readPage(format, pageOf(document, from));
    const own = setHeader(format, withChanges(document, copied.value.changes), to, { code: 0 });
    if (!own.ok) return own;
    const title = `${name.slice(0, format.layout.nameBytes - COPY_SIGN.length)}${COPY_SIGN}`;
    const named = rename(format, withChanges(withChanges(document, copied.value.changes), own.value.changes), to, title);
    if (!named.ok) return named;
    const [last] = named.value.changes;
    return ok({ edit: transaction('copy-page', last ? [{ ...last, before: pageOf(document, to) }] : copied.value.changes), page: to });
}

export function movePage(
    format: PageFormat,
    document: MotionDocument,
    from: number,
    to: number,
    options: PageTransfer = {},
): Result<Transaction> {
    const source = sourceOf(format, document, from, to);
    if (!source.ok) return source;
    if (from === to) return ok(transaction('move-page', []));
    if (!format.isEmpty(pageOf(document, to)) && !options.replace) return refuse('page-in-use', String(to));
    const moved = new Map([[from, to]]);
    const pages = new Map([
        [from, format.empty],
        [to, format.relinked(source.value, moved)],
    ]);
    return ok(transaction('move-page', rearranged(format, document, pages, options.linksFollow ? moved : null)));
}

/** Exchanges two pages. */
export function swapPages(
    format: PageFormat,
    document: MotionDocument,
    a: number,
    b: number,
    options: PageTransfer = {},
): Result<Transaction> {
    const first = editable(format, document, a);
    const second = editable(format, document, b);
    if (!first.ok) return first;
    if (!second.ok) return second;
    const moved = new Map([
        [a, b],
        [b, a],
    ]);
    const own = (bytes: Uint8Array, from: number, to: number): Uint8Array =>
        format.relinked(bytes, options.linksFollow ? moved : new Map([[from, to]]));
    const pages = new Map([
        [a, own(second.value, b, a)],
        [b, own(first.value, a, b)],
    ]);
    return ok(transaction('swap-pages', a === b ? [] : rearranged(format, document, pages, options.linksFollow ? moved : null)));
}

/** Changes that insert these pages. If `moved` is given, the links of all other pages follow it. */
function rearranged(
    format: PageFormat,
    document: MotionDocument,
    pages: ReadonlyMap<number, Uint8Array>,
    moved: ReadonlyMap<number, number> | null,
): Change[] {
    return document.pages.map((before, page) => {
        const after = pages.get(page) ?? (moved && page !== 0 ? format.relinked(before, moved) : before);
        return { page, before, after };
    });
}

/** Also repairs a damaged page by emptying it. */
export function clearPages(format: PageFormat, document: MotionDocument, pages: Iterable<number>): Result<Transaction> {
    return replacePages(format, document, new Map(Array.from(pages, page => [page, format.empty])), 'clear-page');
}

/** Inserts whole pages from a file, robot or backup and replaces what is there. Page 0 is allowed too, except for clearing: it is a robot's
 *  trim. */
export function replacePages(
    format: PageFormat,
    document: MotionDocument,
    pages: ReadonlyMap<number, Uint8Array>,
    label: EditName = 'replace-pages',
): Result<Transaction> {
    const changes: Change[] = [];
    for (const [page, after] of pages) {
        const before = document.pages[page];
        if (!before) return refuse('no-such-page', String(page));
        if (page === 0 && label === 'clear-page') return refuse('trim-page');
        if (after.length !== format.layout.pageBytes) return refuse('bad-number', `${after.length} bytes`);
        changes.push({ page, before, after: isSamePage(before, after) ? before : after.slice() });
    }
    return ok(transaction(label, changes));
}

/** Inserts pages from elsewhere, each at its own number if free, else at the next free one. Links between them follow; links to pages that
 *  did not come are cut. A page that is already here, together with all pages it leads to, is not inserted again. `placed`: their number ->
 *  our number. Refuses if there is no room. */
export function adoptPages(
    format: PageFormat,
    document: MotionDocument,
    pages: ReadonlyMap<number, Uint8Array>,
): Result<{ readonly edit: Transaction; readonly placed: ReadonlyMap<number, number> }> {
    const known = alreadyHere(format, document, pages);
    const placed = new Map<number, number>();
    let filled = document;
    for (const [from, bytes] of pages) {
        const to = known.has(from) ? from : freePage(format, filled, from);
        if (to === 0) return refuse('no-room');
        placed.set(from, to);
        filled = { ...filled, pages: filled.pages.with(to, bytes) };
    }
    const moved = new Map(Array.from(document.pages, (_, page) => [page, placed.get(page) ?? 0]));
    const fresh = [...pages].filter(([from]) => !known.has(from));
    const edit = replacePages(
        format,
        document,
        new Map(fresh.map(([from, bytes]) => [placed.get(from) ?? from, format.relinked(bytes, moved)])),
    );
    return edit.ok ? ok({ edit: edit.value, placed }) : edit;
}

/** The pages that are already here at their own number and lead only to such pages. */
function alreadyHere(format: PageFormat, document: MotionDocument, pages: ReadonlyMap<number, Uint8Array>): ReadonlySet<number> {
    const here = new Set([...pages].filter(([page, bytes]) => isSamePage(pageOf(document, page), bytes)).map(([page]) => page));
    for (let before = -1; before !== here.size; ) {
        before = here.size;
        for (const page of here) {
            const isTorn = format.leads(pageOf(document, page)).some(({ to }) => pages.has(to) && !here.has(to));
            if (isTorn) here.delete(page);
        }
    }
    return here;
}

/** The first empty page in 1..127, searched from `from` with wrap-around; 0: none is free. */
export function freePage(format: PageFormat, document: MotionDocument, from = 1): number {
    const numbers = document.pages.map((_, i) => i).filter(page => page > 0);
    const ordered = [...numbers.filter(page => page >= from), ...numbers.filter(page => page < from)];
    return ordered.find(page => format.isEmpty(pageOf(document, page))) ?? 0;
}
