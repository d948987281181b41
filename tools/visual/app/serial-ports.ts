// SPDX-License-Identifier: MIT
// The serial ports that the person has allowed. A board and a servo adapter both are one, and the browser reveals only the kind of a port.
// The adapter's kind is remembered, so that it is not taken for a board.

import { RobotError } from '../robot/robot-error.ts';
import { recall, store } from '../view/remembered.ts';

function kindOf(port: SerialPort): string {
    const { usbVendorId = 0, usbProductId = 0 } = port.getInfo();
    return `${usbVendorId.toString(16)}:${usbProductId.toString(16)}`;
}

/** A browser without storage asks the person again. */
export function isAdapter(port: SerialPort): boolean {
    return recall('adapter') === kindOf(port);
}

export function rememberAdapter(port: SerialPort): void {
    store('adapter', kindOf(port));
}

/** Runs `work`, which needs Web Serial and a port chosen by the person. false: the chooser was closed. Rejects with RobotError. */
export async function withPort(work: () => Promise<void>): Promise<boolean> {
    if (!('serial' in navigator)) throw new RobotError(globalThis.isSecureContext === false ? 'plain-http' : 'no-serial');
    try {
        await work();
        return true;
    } catch (error) {
        if (error instanceof DOMException && error.name === 'NotFoundError') return false;
        throw new RobotError('port-busy', error instanceof Error ? error.message : '', { cause: error });
    }
}
