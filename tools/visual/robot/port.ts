// SPDX-License-Identifier: MIT
// A serial port with the interface of the browser's SerialPort. All code above treats the board in the page, Web Serial and a fake that can
// be unplugged alike.

/** 57,600 baud 8N1, no flow control except XOFF and XON. Every image uses it. */
export const BAUD_RATE = 57_600;

/** A connection to a board. The streams exist between open() and close(). A pulled cable ends `readable` with an error. */
export interface Port {
    /** For people: "the robot in this page", "USB serial port". */
    readonly name: string;
    readonly readable: ReadableStream<Uint8Array> | null;
    readonly writable: WritableStream<Uint8Array> | null;
    open(options: { readonly baudRate: number }): Promise<void>;
    close(): Promise<void>;
}
