// SPDX-License-Identifier: MIT
// The serial ports that a person has allowed. A board and a servo adapter are both one, and the browser tells no more of them than their
// kind, so the kind of the adapter is remembered: nobody's board is found there.

import { RobotError } from '../robot/robot-error.ts';

const ADAPTER = 'motion512.adapter';

function kindOf(port: SerialPort): string {
    const { usbVendorId = 0, usbProductId = 0 } = port.getInfo();
    return `${usbVendorId.toString(16)}:${usbProductId.toString(16)}`;
}

/** A browser that keeps nothing lets the person choose once more. */
export function isAdapter(port: SerialPort): boolean {
    try {
        return localStorage.getItem(ADAPTER) === kindOf(port);
    } catch {
        return false;
    }
}

export function rememberAdapter(port: SerialPort): void {
    try {
        localStorage.setItem(ADAPTER, kindOf(port));
    } catch {
        return;
    }
}

/** Does what needs Web Serial and a port that somebody chooses. false: the chooser was closed. Rejects with RobotError. */
export async function withPort(work: () => Promise<void>): Promise<boolean> {
    if (!('serial' in navigator)) throw new RobotError('no-serial');
    try {
        await work();
        return true;
    } catch (error) {
        if (error instanceof DOMException && error.name === 'NotFoundError') return false;
        throw new RobotError('port-busy', error instanceof Error ? error.message : '', { cause: error });
    }
}
