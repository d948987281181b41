/* SPDX-License-Identifier: MIT
 * journal.h - replaces a 512-byte motion page so that a power cut leaves the old page or the new one.
 * Knows flash.h and nothing of registers. Used by applications to save and by the loader (and applications, under
 * the factory loader) to recover. Main loop only. No RAM of its own: the flash is scanned at each call (0.3 ms).
 *
 * Area MEM_JOURNAL_START..MEM_JOURNAL_END: JOURNAL_SLOTS slots of 3 flash pages. Slot s, at start + 768 s:
 *
 *   +0    512  the new contents of the motion page
 *   +512   12  record, little endian; the rest of this flash page is 0xFF
 *              0 magic "MJ"  2 sequence  4 target page 0..127  5 layout 1
 *              6 CRC-16 of the 512 bytes  8 CRC-16 of record bytes 0..7  10 state: 0xFFFF pending, otherwise done
 *
 *   save:     data -> record -> target (flash pages that differ) -> state := 0 (programmed, no erase)
 *   recover:  newest record pending -> target (pages that differ) -> state := 0
 *
 * The newest record is the one with the highest sequence (modulo 65536) among those whose own CRC is correct. Only that one
 * takes effect; older ones count as done, whatever their state. A save uses the slot after the newest, so every flash page
 * of the area is erased once in JOURNAL_SLOTS saves. A slot that does not take what is written is passed over.
 * A power cut before the record is complete leaves an invalid record, hence the old page. Once the record is complete, the
 * next start finishes the target, however often the power fails meanwhile. */
#ifndef JOURNAL_H
#define JOURNAL_H

#include "flash.h"

#include "memory_map.h"

#include <stdbool.h>
#include <stdint.h>

#define JOURNAL_SLOTS ((MEM_JOURNAL_END - MEM_JOURNAL_START) / (256u * JOURNAL_SLOT_PAGES))
#define JOURNAL_SLOT_PAGES 3u     /* flash pages */
#define JOURNAL_TARGET_BYTES 512u

/* Replaces motion page `motion_page` (0..127). Call journal_recover once after start, before the first save.
 * Writes a record even if the page already holds `data`: page_save.h does not call it then. At most 6 flash operations: five
 * of 9 ms, the last one 4.5 ms; up to three more of 9 ms for each slot that is worn out.
 * FLASH_ERR_RANGE, FLASH_ERR_NO_WRITER : nothing was touched
 * FLASH_ERR_VERIFY    : all slots are worn out, and the page is old
 * JOURNAL_ERR_PENDING : its own flash is worn out, and it is undefined; the next recovery tries again, unless another save
 *                       comes before. The record is not dropped: it makes the page whole if one half of it was written */
#define JOURNAL_ERR_PENDING (FLASH_ERR_NO_WRITER + 1u)
MUST_CHECK uint8_t journal_save(uint8_t motion_page, const uint8_t data[JOURNAL_TARGET_BYTES]);

typedef enum {
    JOURNAL_CLEAN = 0, /* nothing was pending */
    JOURNAL_RESTORED,  /* the pending page was written */
    JOURNAL_LOST,      /* the data of the pending record fail their CRC (not caused by a power cut); dropped */
    JOURNAL_FAILED     /* the write failed, or no program here can write flash; still pending */
} journal_result_t;

/* Completes a save that a power cut interrupted. work : undefined afterwards. */
journal_result_t journal_recover(uint8_t work[JOURNAL_TARGET_BYTES]);

/* Whether journal_recover has a page to write. For images without a writer. */
bool journal_is_pending(void);

/* Drops a pending record, before something else overwrites the motion area. */
MUST_CHECK flash_status_t journal_void(void);

#endif
