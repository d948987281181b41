// SPDX-License-Identifier: MIT
// A Web Serial port as a Port. The view asks for it (requestPort), because that needs a click.

import type { Port } from './port.ts';

/** The part of the browser's SerialPort that is used here. */
export interface BrowserSerialPort {
    readonly readable: ReadableStream<Uint8Array> | null;
    readonly writable: WritableStream<Uint8Array> | null;
    open(options: { baudRate: number; bufferSize?: number }): Promise<void>;
    close(): Promise<void>;
    getInfo?(): { usbVendorId?: number | undefined };
}

/** The answers for 128 pages come without a pause. The browser's default buffer of 255 bytes would overrun. */
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

    /** nameOf: the name for people of a port with a chip of this maker; '': unknown maker. */
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
