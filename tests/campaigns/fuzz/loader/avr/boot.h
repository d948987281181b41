/* SPDX-License-Identifier: MIT
 * Fuses and lock bits for the loader built on a PC: a programmed chip's. */
#ifndef LOADER_BOOT_H
#define LOADER_BOOT_H

#define boot_lock_fuse_bits_get(number) ((uint8_t)(0xC0u | (number)))

#endif
