// SPDX-License-Identifier: MIT
// A port of the browser's Web Serial API as a Port. Asking for one (requestPort) is the view's business: it needs a click.

import type { Port } from './port.ts';

/** What we use of the browser's SerialPort. */
export interface BrowserSerialPort {
    readonly readable: ReadableStream<Uint8Array> | null;
    readonly writable: WritableStream<Uint8Array> | null;
    open(options: { baudRate: number; bufferSize?: number }): Promise<void>;
    close(): Promise<void>;
    getInfo?(): { usbVendorId?: number | undefined };
}

/** The answers of 128 pages come without a pause; the browser's own buffer of 255 bytes would overrun. */
const BUFFER_BYTES = 16_384;

const VENDORS: ReadonlyMap<number, string> = new Map([
    [0x0403, 'FTDI'],
    [0x067b, 'Prolific'],
    [0x10c4, 'Silicon Labs'],
    [0x1a86, 'WCH'],
]);

export class WebSerialPort implements Port {
    readonly name: string;
    private readonly port: BrowserSerialPort;

    /** nameOf: how people call a port with such a chip in it; '': nobody knows which. */
    constructor(port: BrowserSerialPort, nameOf: (maker: string) => string) {
        this.port = port;
        const vendor = port.getInfo?.().usbVendorId;
        this.name = nameOf(vendor === undefined ? '' : (VENDORS.get(vendor) ?? vendor.toString(16)));
    }

    get readable(): ReadableStream<Uint8Array> | null {
        return this.port.readable;
    }

    get writable(): WritableStream<Uint8Array> | null {
        return this.port.writable;
    }

    open(options: { readonly baudRate: number }): Promise<void> {
        return this.port.open({ baudRate: options.baudRate, bufferSize: BUFFER_BYTES });
    }

    close(): Promise<void> {
        return this.port.close();
    }
}
