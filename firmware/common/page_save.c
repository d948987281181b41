/* SPDX-License-Identifier: MIT */
#include "page_save.h"

#include "console.h"
#include "journal.h"
#include "page_service.h"
#include "tick.h"

page_save_status_t page_save(uint8_t page, uint8_t bytes[PAGE_BYTES])
{
    page_seal(bytes);
    if (flash_equals(page_store_addr(page), bytes, PAGE_BYTES)) {
        return PAGE_SAVE_UNCHANGED;
    }
    console_xoff();
    flash_status_t status = journal_save(page, bytes);
    console_xon();
    tick_forgive();
    if (status == FLASH_ERR_NO_WRITER) {
        return PAGE_SAVE_ERR_NO_WRITER;
    }
    return status == FLASH_OK ? PAGE_SAVE_OK : PAGE_SAVE_ERR_VERIFY;   /* the journal reads each flash page back */
}

void page_save_by_mailbox(uint8_t page, uint8_t bytes[PAGE_BYTES])
{
    page_seal(bytes);
    (void)!page_service_post(page, bytes);
}
