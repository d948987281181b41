/* SPDX-License-Identifier: MIT
 * fake_flash.h - 128 KiB of flash in host memory, behind flash.h. Starts erased. Writing obeys the chip: a page is erased
 * whole (all bits 1), programming only clears bits. Ranges abort. Power can be cut at the n-th erase or write. */
#ifndef FAKE_FLASH_H
#define FAKE_FLASH_H

#include <setjmp.h>
#include <stdbool.h>
#include <stdint.h>

#define FAKE_FLASH_BYTES 0x20000ul
#define FAKE_FLASH_PAGE_BYTES 256u

void fake_flash_reset(void);                      /* erased, no wear, no cut */
const uint8_t *fake_flash_bytes(void);            /* to compare */
void fake_flash_load(uint32_t address, const void *bytes, uint32_t count); /* as a programmer does: no rules, no wear */

/* What the boot section can do, `address` page-aligned. */
void fake_flash_erase(uint32_t address);
void fake_flash_program(uint32_t address, const uint8_t bytes[FAKE_FLASH_PAGE_BYTES]);
uint16_t fake_flash_wear(uint32_t address);       /* erases of the page */
uint32_t fake_flash_operations(void);             /* erases + programs since reset */

/* Power cut at operation `operation` (1 = the next one; 0 = never): the operation is done only up to byte `torn_bytes`
 * (0 = not at all, 256 = completely; an erase torn in the middle leaves random bits in the rest), then longjmp to `where`.
 * The flash stays as it is. */
void fake_flash_cut(uint32_t operation, uint16_t torn_bytes, jmp_buf *where);

#endif
