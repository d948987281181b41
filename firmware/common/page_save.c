/* SPDX-License-Identifier: MIT */
#include "page_save.h"

#include "console.h"
#include "crc16.h"
#include "journal.h"
#include "page_service.h"
#include "tick.h"

/* The save of this run that is pending. */
static struct {
    bool is_there;
    uint8_t page;
    uint16_t crc;
} pending;

uint16_t page_save_crc(const uint8_t bytes[PAGE_BYTES])
{
    return crc16_bytes(CRC16_START, bytes, PAGE_BYTES);
}

page_save_status_t page_save(uint8_t page, uint8_t bytes[PAGE_BYTES])
{
    page_seal(bytes);
    if (flash_equals(page_store_addr(page), bytes, PAGE_BYTES)) {
        return PAGE_SAVE_UNCHANGED;
    }
    if (pending.is_there && page != pending.page && page_save_crc(bytes) != pending.crc) {
        return PAGE_SAVE_ERR_RESTART;
    }
    console_xoff();
    const uint8_t status = journal_save(page, bytes);   /* it reads each flash page back */
    console_xon();
    tick_forgive();
    STATIC_ASSERT((int)PAGE_SAVE_OK == (int)FLASH_OK && (int)PAGE_SAVE_ERR_VERIFY == (int)FLASH_ERR_VERIFY &&
                      (int)PAGE_SAVE_ERR_NO_WRITER == (int)FLASH_ERR_NO_WRITER &&
                      (int)PAGE_SAVE_ERR_PENDING == (int)JOURNAL_ERR_PENDING,
                  "the errors of a save are those of the journal, but FLASH_ERR_RANGE: every page has a place");
    pending.is_there = status == JOURNAL_ERR_PENDING;
    if (pending.is_there) {
        pending.page = page;
        pending.crc = page_save_crc(bytes);
    }
    return (page_save_status_t)status;
}

void page_save_by_mailbox(uint8_t page, uint8_t bytes[PAGE_BYTES])
{
    page_seal(bytes);
    (void)!page_service_post(page, bytes);
}
