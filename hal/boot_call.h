/* SPDX-License-Identifier: MIT
 * boot_call.h - the two routines in a boot section that can write flash for an application, as C functions.
 * Portable side: firmware/common/page_service.c, which finds out which of them is present. AVR: hal/avr/boot_call.c.
 * Main loop only. Calling an absent routine runs whatever code is at its address. RAM: only the stack. */
#ifndef BOOT_CALL_H
#define BOOT_CALL_H

#include "boot_api.h"

#include <stdbool.h>
#include <stdint.h>

/* Our loader's boot_write_page (boot_api.h): a BOOT_* result. */
uint8_t boot_call_write(uint32_t addr, const uint8_t *data, uint16_t bytes, uint8_t mode, const boot_rx_t *rx);

/* The factory loader's routine at 0x1F238 (boot/ORIGINAL.md, 7b). Fills the fixed buffer with the `bytes` of data and 0xFF
 * (BOOT_MODE_PROGRAM: with old AND data, and old for the rest, because this loader always erases first), then writes. Saves
 * the RAM under the buffer on the stack and restores it: 300 bytes of stack, all above the buffer.
 * Interrupts are off for 9 ms. Of the bytes that arrive on UART1 meanwhile, only the first three survive.
 * addr : a flash page below 0x1E000; checked here, because the routine does not check it.
 * Result as above; BOOT_ERR_VERIFY after ten tries. */
uint8_t boot_call_factory(uint32_t addr, const uint8_t *data, uint16_t bytes, uint8_t mode);

#endif
