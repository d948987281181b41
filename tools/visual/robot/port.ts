// SPDX-License-Identifier: MIT
// A serial port as the browser's SerialPort is one, so that the board in the page, Web Serial and a fake that can be
// unplugged are the same to everything above.

/** 57,600 baud 8N1, no flow control but XOFF and XON: what every image speaks. */
export const BAUD_RATE = 57_600;

/** One way to a board. Streams are there between open() and close(); a pulled cable ends `readable` with an error. */
export interface Port {
    /** For people: "the robot in this page", "USB serial port". */
    readonly name: string;
    readonly readable: ReadableStream<Uint8Array> | null;
    readonly writable: WritableStream<Uint8Array> | null;
    open(options: { readonly baudRate: number }): Promise<void>;
    close(): Promise<void>;
}
