/* SPDX-License-Identifier: MIT
 * boot_call.h - the two routines in a boot section that can write flash for an application, as C functions.
 * Portable side: firmware/common/page_service.c, which knows which of them is there. AVR: hal/avr/boot_call.c.
 * Main loop only. Calling one that is not there runs into whatever stands at that address. No RAM but the stack. */
#ifndef BOOT_CALL_H
#define BOOT_CALL_H

#include "avr/boot_api.h"

#include <stdbool.h>
#include <stdint.h>

/* Our loader's boot_write_page (boot_api.h): a BOOT_* result. */
uint8_t boot_call_write(uint32_t addr, const uint8_t *data, uint16_t bytes, uint8_t mode, const boot_rx_t *rx);

/* The factory loader's routine at 0x1F238 (bootloader-original.md, 7b). Fills the fixed buffer with the `bytes` of
 * data and 0xFF (BOOT_MODE_PROGRAM: with old AND data, old for the rest: this loader always erases first), then
 * writes. Whatever lives in that buffer's place is kept on the stack meanwhile: 300 bytes, which must lie above it.
 * Interrupts are off for 9 ms; what arrives on UART1 meanwhile is lost but for three bytes.
 * addr : a flash page below 0x1E000; checked here, because the routine does not.
 * Result as above; it has tried ten times before it says BOOT_ERR_VERIFY. */
uint8_t boot_call_factory(uint32_t addr, const uint8_t *data, uint16_t bytes, uint8_t mode);

#endif
