// SPDX-License-Identifier: MIT
// Reads the board's name from the banner of a boot loader: "SYSTEM O.K. (CM5 Boot loader V1.31)". Loaders of other boards use the same
// words (tools/m512/src/m512/board/banner.py).

const OURS = ['CM5', 'CM2', 'CM2+', 'MOTION512'];
const BANNER = /SYSTEM O\.K\. \(([ -~]{1,40}?) boot ?loader\b/i;
const LONGEST = 80;

export class LoaderBanner {
    private text = '';

    /** The name of a foreign board if these bytes complete its banner; else null. */
    heard(bytes: Uint8Array): string | null {
        const text = this.text + String.fromCharCode(...bytes);
        this.text = text.slice(-LONGEST);
        const name = BANNER.exec(text)?.[1]?.trim();
        if (name === undefined) return null;
        this.text = '';
        return OURS.includes(name.replaceAll(/[- _]/g, '').toUpperCase()) ? null : name;
    }
}
