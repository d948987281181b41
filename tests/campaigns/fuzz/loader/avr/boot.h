/* SPDX-License-Identifier: MIT
 * Fuses and lock bits of a programmed chip, for the loader built on a PC. */
#ifndef LOADER_BOOT_H
#define LOADER_BOOT_H

#define boot_lock_fuse_bits_get(number) ((uint8_t)(0xC0u | (number)))

#endif
