/* SPDX-License-Identifier: MIT */
#include "page_save.h"

#include <string.h>
#include "console.h"
#include "journal.h"
#include "page_service.h"
#include "system.h"
#include "tick.h"

#define CHUNK_BYTES 64u

void page_save_recover(uint8_t work[PAGE_BYTES])
{
    page_service_kind_t kind = page_service_kind();
    if (kind == PAGE_SERVICE_OURS || kind == PAGE_SERVICE_FACTORY) {
        (void)journal_recover(work);
    }
}

static NOINLINE bool is_in_flash(uint8_t page, const uint8_t bytes[PAGE_BYTES])
{
    uint8_t chunk[CHUNK_BYTES];
    for (uint16_t offset = 0; offset < PAGE_BYTES; offset = (uint16_t)(offset + CHUNK_BYTES)) {
        page_store_read(page, offset, chunk, CHUNK_BYTES);
        if (memcmp(chunk, bytes + offset, CHUNK_BYTES) != 0) {
            return false;
        }
    }
    return true;
}

page_save_status_t page_save(page_store_t *store, uint8_t page, uint8_t bytes[PAGE_BYTES])
{
    page_seal(bytes);
    if (is_in_flash(page, bytes)) {
        return PAGE_SAVE_UNCHANGED;
    }
    console_hold();
    flash_status_t status = journal_save(page, bytes);
    console_resume();
    tick_forgive();
    page_store_refresh(store, page);
    if (status == FLASH_ERR_NO_WRITER) {
        return PAGE_SAVE_ERR_NO_WRITER;
    }
    return status == FLASH_OK ? PAGE_SAVE_OK : PAGE_SAVE_ERR_VERIFY;   /* each flash page was read back */
}

void page_save_by_mailbox(uint8_t page, uint8_t bytes[PAGE_BYTES])
{
    page_seal(bytes);
    (void)!page_service_post(page, bytes);
    console_flush();
    system_restart();
}
