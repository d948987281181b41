/* SPDX-License-Identifier: MIT
 * page_store.h - the 128 motion pages in flash: which are valid, by number and by name, and their bytes for the player.
 * Reading side; saving is page_save.h. Main loop only. RAM: one page_store_t, 24 bytes. */
#ifndef PAGE_STORE_H
#define PAGE_STORE_H

#include <stdbool.h>
#include <stdint.h>
#include "page.h"
#include "player.h"

typedef struct {
    page_source_t source;              /* for player_init; context is this store */
    uint8_t good[PAGE_COUNT / 8];      /* bit per page: page_check said PAGE_OK */
} page_store_t;

/* Checks all 128 pages: blocks about 130 ms, kicks the watchdog. Whoever has a journal recovers it first
 * (journal.h, page_service.h). */
void page_store_init(page_store_t *store);

/* Checks one page again (after a save): about 1 ms. */
void page_store_refresh(page_store_t *store, uint8_t page);

/* Byte address of a page in flash. */
uint32_t page_store_addr(uint8_t page);

/* Copies part of a page, offset + count <= 512. page 0..127. */
void page_store_read(uint8_t page, uint16_t offset, void *to, uint16_t count);

/* One byte of it. */
uint8_t page_store_byte(uint8_t page, uint16_t offset);

bool page_store_is_good(const page_store_t *store, uint8_t page);

/* What is wrong with a page, as page_check would say it; looks at the flash unless the page is good. */
page_status_t page_store_look(uint8_t page);   /* the same without a store: always looks */
page_status_t page_store_check(const page_store_t *store, uint8_t page);

/* true when all 512 bytes are 0xFF (erased): then page_store_check says PAGE_ERR_CHECKSUM or so, but nothing is damaged. */
bool page_store_is_erased(uint8_t page);

/* Name, NUL-terminated, at most 13 characters, cut at the first byte that is not printable ASCII. */
void page_store_name(uint8_t page, char name[PAGE_NAME_BYTES]);

/* The lowest good page above `after` with this name (letter case does not count); 0: none. Start with after = 0. */
uint8_t page_store_find(const page_store_t *store, const char *name, uint8_t after);

/* The lowest good and playable page 1..127 with this play code (1..254); 0: none. */
uint8_t page_store_find_code(const page_store_t *store, uint8_t code);

/* Signed trim offsets from page 0, the third step (motion512.md, "Offset"). false: page 0 is not good; all zero then. A word
 * 0x4000..0x5FFF (an unused joint, not a small negative number) counts as 0. */
bool page_store_trim(const page_store_t *store, int16_t trim_pos[PAGE_JOINTS]);

#endif
