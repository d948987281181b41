/* SPDX-License-Identifier: MIT
 * page_save.h - saves a motion page so that a power cut leaves the old page or the new one (journal.h), through whatever
 * can write flash here (page_service.h). page_store.h is the reading side. Main loop only, nothing may be moving.
 * RAM: 4 bytes. After a start call journal_recover first, then page_store_init. A save takes at most 60 ms: six flash pages
 * of 9 ms. Flow control stops the PC meanwhile; our loader's service keeps the bytes that still arrive. */
#ifndef PAGE_SAVE_H
#define PAGE_SAVE_H

#include <stdint.h>
#include "compiler.h"
#include "page.h"
#include "page_store.h"

typedef enum {
    PAGE_SAVE_OK = 0,
    PAGE_SAVE_UNCHANGED,       /* flash already holds the page: nothing was written */
    PAGE_SAVE_ERR_VERIFY,      /* the write failed: flash has the old page */
    PAGE_SAVE_ERR_NO_WRITER,   /* no program here can write flash; try page_save_by_mailbox */
    PAGE_SAVE_ERR_PENDING,     /* the write failed half way: flash may have a damaged page. The next start tries again */
    PAGE_SAVE_ERR_RESTART      /* nothing was written: another page is pending, and the next start must complete it first */
} page_save_status_t;

/* Sets the checksum byte, saves and reads back. Call page_store_refresh afterwards, whatever the result. This function does
 * not, so that the user sees the answer first.
 * After PAGE_SAVE_ERR_PENDING the page is whole in the journal only, where the next save takes its place. So until the next
 * start only the same page may be saved, or its contents under another number. */
MUST_CHECK page_save_status_t page_save(uint8_t page, uint8_t bytes[PAGE_BYTES]);

/* The CRC-16 of a page. */
uint16_t page_save_crc(const uint8_t bytes[PAGE_BYTES]) NOINLINE;

/* Sets the checksum byte and leaves the page in the mailbox of the factory loader (4.5 s), which saves it at the next
 * start: call board_restart next. */
void page_save_by_mailbox(uint8_t page, uint8_t bytes[PAGE_BYTES]);

#endif
