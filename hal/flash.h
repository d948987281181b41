/* SPDX-License-Identifier: MIT
 * flash.h - the program memory: read from anywhere, write by flash pages of 256 bytes.
 * Knows nothing of motions, journals or CRCs. Main loop only, never from an ISR. No RAM of its own.
 * Reading : hal/avr/flash.c (applications), firmware/boot/memory.c (loader), hal/host/memory.c, tests/fake/fake_flash.c.
 * Writing : firmware/common/page_service.c calls the program in the boot section; the loader does it itself.
 * A page takes about 9 ms (erase 4.5 + write 4.5) with interrupts off; programming alone takes half of that.
 * After a power cut a page may be old, erased or torn: check what you load. */
#ifndef FLASH_H
#define FLASH_H

#include "compiler.h"

#include <stdbool.h>
#include <stdint.h>

#define FLASH_PAGE_BYTES 256u
#define FLASH_PAGES 512u

typedef enum {
    FLASH_OK = 0,
    FLASH_ERR_RANGE,     /* page in the boot section or beyond the end, or a bad byte count: nothing was touched */
    FLASH_ERR_VERIFY,    /* the read-back differs: the page's contents are undefined */
    FLASH_ERR_NO_WRITER  /* no program in the boot section can write for us: nothing was touched */
} flash_status_t;

/* The byte address of a page. */
uint32_t flash_addr(uint16_t page);

/* Copies `bytes` from byte address `addr` (0..0x1FFFF) on. */
void flash_read(uint32_t addr, void *to, uint16_t bytes);

/* Whether flash holds `data` at byte address `addr`. 25 cycles per equal byte. */
bool flash_equals(uint32_t addr, const void *data, uint16_t bytes);

/* Erases `page` (an index, 0..FLASH_PAGES-1), programs `bytes` of data (even, 2..256; the rest of the page then reads
 * 0xFF) and reads back. Does not keep a pointer to `data`. */
MUST_CHECK flash_status_t flash_write(uint16_t page, const uint8_t *data, uint16_t bytes);

/* The same without the erase: every bit becomes old AND new. The rest of the page is unchanged.
 * FLASH_ERR_VERIFY unless the page then holds exactly `data` in these bytes. */
MUST_CHECK flash_status_t flash_program(uint16_t page, const uint8_t *data, uint16_t bytes);

#endif
