/* SPDX-License-Identifier: MIT
 * page_save.h - puts a motion page into flash so that a power cut leaves the old page or the new one (journal.h), through
 * whoever can write here (page_service.h). The reading side is page_store.h. Main loop only, nothing may be moving.
 * After a start, journal_recover comes first, before page_store_init: it finishes what a power cut left. No RAM. At most
 * 60 ms: six flash pages of 9 ms; flow control keeps the PC silent meanwhile, and our loader's service keeps what still
 * arrives. */
#ifndef PAGE_SAVE_H
#define PAGE_SAVE_H

#include <stdint.h>
#include "compiler.h"
#include "page.h"
#include "page_store.h"

typedef enum {
    PAGE_SAVE_OK = 0,
    PAGE_SAVE_UNCHANGED,       /* flash holds it already: nothing was written */
    PAGE_SAVE_ERR_VERIFY,      /* the flash did not take it: old page, or the next start repairs it */
    PAGE_SAVE_ERR_NO_WRITER    /* nobody here can write flash; page_save_by_mailbox may help */
} page_save_status_t;

/* Sets the checksum byte, saves and reads back. Afterwards, whatever it says, the store has to look at the page anew
 * (page_store_refresh): not done here, so that the answer comes first. */
MUST_CHECK page_save_status_t page_save(uint8_t page, uint8_t bytes[PAGE_BYTES]);

/* Sets the checksum byte and leaves the page in the mailbox of the factory loader, which saves it at the next start (4.5 s):
 * board_restart has to follow. */
void page_save_by_mailbox(uint8_t page, uint8_t bytes[PAGE_BYTES]);

#endif
