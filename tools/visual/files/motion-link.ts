// SPDX-License-Identifier: MIT
// Motions in the page's address, so that a link is enough to send them. The text is base64url of deflated bytes: a version, then for each
// page its number and its 512 bytes. A page with three steps takes about 200 characters.

import { pageOf } from '../model/document.ts';
import type { MotionDocument } from '../model/document.ts';
import { PAGE_BYTES, PAGE_COUNT } from '../model/motion.ts';
import type { PageFormat } from '../model/page-format.ts';

/** Precedes the motion in the address. */
export const HASH = '#motion=';
const VERSION = 1;
const ENTRY = 1 + PAGE_BYTES;
/** Browsers and mail programs accept addresses of at least this length. */
export const MOST_CHARACTERS = 8000;
const MOST_BYTES = 1 + PAGE_COUNT * ENTRY;

async function through(bytes: Uint8Array, stream: CompressionStream | DecompressionStream): Promise<Uint8Array> {
    const chunks: Uint8Array[] = [];
    let length = 0;
    const reader = new Blob([bytes as Uint8Array<ArrayBuffer>])
        .stream()
        .pipeThrough(stream as ReadableWritablePair<Uint8Array, BufferSource>)
        .getReader();
    for (let read = await reader.read(); !read.done; read = await reader.read()) {
        chunks.push(read.value);
        length += read.value.length;
        if (length > MOST_BYTES) {
            await reader.cancel();
            throw new RangeError('more than 128 pages');
        }
    }
    const whole = new Uint8Array(length);
    let at = 0;
    for (const chunk of chunks) {
        whole.set(chunk, at);
        at += chunk.length;
    }
    return whole;
}

/** Encodes pages (by number, 1..127) as text for an address. */
export async function encodeMotion(pages: ReadonlyMap<number, Uint8Array>): Promise<string> {
    const bytes = new Uint8Array(1 + pages.size * ENTRY);
    bytes[0] = VERSION;
    [...pages].forEach(([page, contents], i) => {
        bytes[1 + i * ENTRY] = page;
        bytes.set(contents, 2 + i * ENTRY);
    });
    const packed = await through(bytes, new CompressionStream('deflate-raw'));
    return btoa(String.fromCharCode(...packed))
        .replaceAll('+', '-')
        .replaceAll('/', '_')
        .replaceAll('=', '');
}

/** What stands before or behind the motion (a full stop, a space, another parameter) is left out. Null: the text is not a motion or was cut
 *  off. */
export async function decodeMotion(text: string): Promise<Map<number, Uint8Array> | null> {
    try {
        const [letters = ''] = /[\w-]+/.exec(text.replace(/^(?:%\w\w|[^\w-])+/, '')) ?? [];
        const packed = Uint8Array.from(atob(letters.replaceAll('-', '+').replaceAll('_', '/')), letter => letter.charCodeAt(0));
        return entries(await through(packed, new DecompressionStream('deflate-raw')));
    } catch {
        return null; // there is one message for every bad link
    }
}

function entries(bytes: Uint8Array): Map<number, Uint8Array> | null {
    if (bytes[0] !== VERSION || bytes.length === 1 || (bytes.length - 1) % ENTRY !== 0) return null;
    const pages = new Map<number, Uint8Array>();
    for (let at = 1; at < bytes.length; at += ENTRY) {
        const page = bytes[at] ?? 0;
        if (page === 0 || page >= PAGE_COUNT || pages.has(page)) return null;
        pages.set(page, bytes.slice(at + 1, at + ENTRY));
    }
    return pages;
}

/** The valid, non-empty pages to send: the page itself first, then all pages it leads to. */
export function pagesToSend(format: PageFormat, document: MotionDocument, start: number): Map<number, Uint8Array> {
    const others = format.reach(document, start).filter(page => page !== start);
    const pages = [start, ...others].map((page): [number, Uint8Array] => [page, pageOf(document, page)]);
    return new Map(pages.filter(([page, bytes]) => page > 0 && !format.isEmpty(bytes) && format.fault(bytes) === null));
}
