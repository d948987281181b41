/* SPDX-License-Identifier: MIT
 * fake_flash.h - the PC's flash for hal/flash.h. As strict as the chip: programming only clears bits, an erase covers a
 * whole page, writes to the boot section are refused, and the power can fail at any operation. One operation is one
 * page erase or one page program: a flash_write counts 2, a flash_program 1. */
#ifndef FAKE_FLASH_H
#define FAKE_FLASH_H

#include "flash.h"

#include <setjmp.h>
#include <stdbool.h>
#include <stdint.h>

/* State of the operation that the power cut hits. */
typedef enum { FAKE_FLASH_BEFORE, FAKE_FLASH_TORN, FAKE_FLASH_AFTER } fake_flash_phase_t;

/* All 0xFF, counters 0, no cut planned, all pages good. */
void fake_flash_reset(void);

/* The 128 KiB, to prepare and compare. */
uint8_t *fake_flash_bytes(void);

/* Cuts the power at operation `op` (1 = the next one; 0 = never): jumps to `where` with value 1. A torn erase sets only
 * some of the bits, a torn program clears only some, picked by `seed`. */
void fake_flash_cut(uint32_t op, fake_flash_phase_t phase, uint32_t seed, jmp_buf *where);

/* Operations since fake_flash_reset or the last fake_flash_cut. */
uint32_t fake_flash_ops(void);

/* Erases of one page since fake_flash_reset. */
uint32_t fake_flash_wear(uint16_t page);

/* The next `tries` operations on `page` do nothing (a bad cell), so the verify must fail. */
void fake_flash_break(uint16_t page, uint8_t tries);

/* No operation on the pages from..end - 1 does anything, until fake_flash_reset. */
void fake_flash_break_all(uint16_t from, uint16_t end);

#endif
