// SPDX-License-Identifier: MIT
// Bytes as pairs of hexadecimal digits.

export function hexOf(bytes: Uint8Array): string {
    return Array.from(bytes, byte => byte.toString(16).padStart(2, '0')).join('');
}

export function bytesOfHex(text: string): Uint8Array {
    return Uint8Array.from(text.match(/../g) ?? [], pair => Number.parseInt(pair, 16));
}
