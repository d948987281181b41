/* SPDX-License-Identifier: MIT
 * page_store.h - reads the 128 motion pages in flash: which are valid, their names and codes, their bytes for the player.
 * page_save.h is the writing side. Main loop only. RAM: one page_store_t. */
#ifndef PAGE_STORE_H
#define PAGE_STORE_H

#include <stdbool.h>
#include <stdint.h>
#include "page.h"
#include "player.h"

typedef struct {
    page_source_t source;              /* for player_init; context is this store */
    uint8_t good[PAGE_COUNT / 8];      /* bit per page: page_check returned PAGE_OK */
} page_store_t;

/* Checks all pages: blocks about 130 ms on a board, kicks the watchdog. Images that can write flash call journal_recover
 * first. */
void page_store_init(page_store_t *store);

/* Checks one page again (after a save): about 1 ms. */
void page_store_refresh(page_store_t *store, uint8_t page);

/* Byte address of a page in flash. */
uint32_t page_store_addr(uint8_t page);

/* Copies part of a page, offset + count <= 512. page 0..PAGE_COUNT - 1. */
void page_store_read(uint8_t page, uint16_t offset, void *to, uint16_t count);

/* Returns one byte of a page. */
uint8_t page_store_byte(uint8_t page, uint16_t offset);

bool page_store_is_good(const page_store_t *store, uint8_t page);

/* Returns what is wrong with a page, like page_check. Reads the flash only if the page is not known to be good. */
page_status_t page_store_check(const page_store_t *store, uint8_t page);

/* The same without a store. Always reads the flash, 1 ms. */
page_status_t page_store_look(uint8_t page);

/* Whether all 512 bytes are 0xFF (erased). page_store_check reports such a page as bad, but it is not damaged. */
bool page_store_is_erased(uint8_t page);

/* Whether a page is neither good nor erased. */
bool page_store_is_damaged(const page_store_t *store, uint8_t page);

/* Name, NUL-terminated, at most 13 characters, cut at the first byte that is not printable ASCII. */
void page_store_name(uint8_t page, char name[PAGE_NAME_BYTES]);

/* The lowest good page above `after` with this name, ignoring case; 0: none. Start with after = 0. */
uint8_t page_store_find(const page_store_t *store, const char *name, uint8_t after);

/* The lowest good and playable page 1..PAGE_COUNT - 1 with this play code (1..254); 0: none. */
uint8_t page_store_find_code(const page_store_t *store, uint8_t code);

/* Signed trim offsets from the third step of page 0 (PAGE_FORMAT.md, "Offset"). A word 0x4000..0x5FFF marks an unused joint
 * and counts as 0. false: page 0 is not good; then all offsets are 0. */
bool page_store_trim(const page_store_t *store, int16_t trim_pos[PAGE_JOINTS]);

#endif
