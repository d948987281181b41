// SPDX-License-Identifier: MIT
// Recognises the adapter among the serial ports that are plugged in. A robot's cable is often of the same kind, and an adapter that was pulled
// out comes back as a new port. So a port that was plugged in beside the adapter is never taken for it.

/** The part of Web Serial that is used here. */
export interface KindOfPort {
    getInfo(): { usbVendorId?: number | undefined; usbProductId?: number | undefined };
}

export class AdapterPorts<P extends KindOfPort> {
    private adapter: P;
    private others: readonly P[] = [];

    /** adapter: the port that the person chose. */
    constructor(adapter: P) {
        this.adapter = adapter;
    }

    /** Takes the ports that are plugged in and returns the adapter's; null: it is out. */
    find(ports: readonly P[]): P | null {
        const found = ports.includes(this.adapter)
            ? this.adapter
            : ports.find(port => isSameKind(port, this.adapter) && !this.others.includes(port));
        if (!found) return null;
        this.adapter = found;
        this.others = ports.filter(port => port !== found);
        return found;
    }
}

function isSameKind(a: KindOfPort, b: KindOfPort): boolean {
    const [one, other] = [a.getInfo(), b.getInfo()];
    return one.usbVendorId === other.usbVendorId && one.usbProductId === other.usbProductId;
}
