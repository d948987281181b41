// SPDX-License-Identifier: MIT
// Copying text by a button.

/** false: the browser refuses, or has no clipboard: over plain http from another machine. */
export async function copyText(text: string): Promise<boolean> {
    try {
        await navigator.clipboard.writeText(text);
        return true;
    } catch {
        return false;
    }
}
