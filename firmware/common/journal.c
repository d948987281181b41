/* SPDX-License-Identifier: MIT */
#include "journal.h"

#include "crc16.h"
#include "memory_map.h"
#include "target.h"

#include <string.h>

#define MAGIC 0x4A4Du /* "MJ" in memory */
#define LAYOUT 1u
#define STATE_PENDING 0xFFFFu
#define STATE_DONE 0x0000u
#define FIRST_PAGE (MEM_JOURNAL_START / FLASH_PAGE_BYTES)
#define FIRST_TARGET (TARGET_MOTION_START / FLASH_PAGE_BYTES)
#define TARGET_PAGES (JOURNAL_TARGET_BYTES / FLASH_PAGE_BYTES)
#define NO_SLOT 0xFFu   /* + 1 is slot 0 */

typedef struct {
    uint16_t magic;
    uint16_t sequence;
    uint8_t target; /* motion page */
    uint8_t layout;
    uint16_t content_crc;
    uint16_t record_crc;
    uint16_t state;
} record_t;
#define RECORD_CRC_BYTES 8u
STATIC_ASSERT(sizeof(record_t) == 12, "the record is a layout in flash");

NOINLINE static uint16_t slot_page(uint8_t slot)
{
    return (uint16_t)(FIRST_PAGE + slot * JOURNAL_SLOT_PAGES);
}

static bool has_target(uint16_t page)   /* 16 bits: with the 256 pages of a PC, an 8-bit comparison is always true */
{
    return page < TARGET_MOTION_PAGES;
}

static bool read_record(uint8_t slot, record_t *record)
{
    flash_read(flash_addr(slot_page(slot) + TARGET_PAGES), record, sizeof *record);
    return record->magic == MAGIC && record->layout == LAYOUT && has_target(record->target) &&
           record->record_crc == crc16_bytes(CRC16_START, record, RECORD_CRC_BYTES);
}

/* The slot of the newest record, or NO_SLOT; then `newest` is what the last slot holds instead of a record. */
static uint8_t find_newest(record_t *newest)
{
    uint8_t found = NO_SLOT;
    uint16_t sequence = 0;
    for (uint8_t slot = 0; slot < JOURNAL_SLOTS; slot++) {
        if (read_record(slot, newest) &&
            (found == NO_SLOT || (int16_t)(newest->sequence - sequence) > 0)) {
            sequence = newest->sequence;
            found = slot;
        }
    }
    if (found != NO_SLOT) {
        (void)read_record(found, newest);
    }
    return found;
}

/* Writes the flash pages of a motion page that differ from `data`. */
static flash_status_t write_data(uint16_t page, const uint8_t data[JOURNAL_TARGET_BYTES])
{
    flash_status_t status = FLASH_OK;
    for (uint8_t i = 0; i < TARGET_PAGES && status == FLASH_OK; i++) {
        if (!flash_equals(flash_addr(page), data, FLASH_PAGE_BYTES)) {
            status = flash_write(page, data, FLASH_PAGE_BYTES);
        }
        page++;
        data += FLASH_PAGE_BYTES;
    }
    return status;
}

static flash_status_t mark_done(uint8_t slot, record_t *record)
{
    record->state = STATE_DONE;
    return flash_program(slot_page(slot) + TARGET_PAGES, (const uint8_t *)record, sizeof *record);
}

uint8_t journal_save(uint8_t motion_page, const uint8_t data[JOURNAL_TARGET_BYTES])
{
    if (!has_target(motion_page)) {
        return FLASH_ERR_RANGE;
    }
    uint16_t target = (uint16_t)(FIRST_TARGET + motion_page * TARGET_PAGES);
    record_t record;
    uint8_t slot = find_newest(&record);
    uint16_t sequence = record.sequence;   /* without a slot that of the last one: the first record may have any */
    flash_status_t status;
    uint8_t slots_left = JOURNAL_SLOTS;
    do { /* a slot that is worn out is left for the next one */
        sequence++;
        if (++slot >= JOURNAL_SLOTS) {
            slot = 0;
        }
        record.magic = MAGIC;
        record.sequence = sequence;
        record.target = motion_page;
        record.layout = LAYOUT;
        record.state = STATE_PENDING;
        record.content_crc = crc16_bytes(CRC16_START, data, JOURNAL_TARGET_BYTES);
        record.record_crc = crc16_bytes(CRC16_START, &record, RECORD_CRC_BYTES);
        status = write_data(slot_page(slot), data);
        if (status == FLASH_OK) {
            status = flash_write(slot_page(slot) + TARGET_PAGES, (const uint8_t *)&record, sizeof record);
        }
    } while (status == FLASH_ERR_VERIFY && --slots_left != 0);
    if (status != FLASH_OK) {
        return (uint8_t)status;
    }
    return write_data(target, data) == FLASH_OK && mark_done(slot, &record) == FLASH_OK ? FLASH_OK : JOURNAL_ERR_PENDING;
}

journal_result_t journal_recover(uint8_t work[JOURNAL_TARGET_BYTES])
{
    record_t record;
    uint8_t slot = find_newest(&record);
    if (slot == NO_SLOT || record.state == STATE_DONE) {
        return JOURNAL_CLEAN;
    }
    journal_result_t result = JOURNAL_CLEAN; /* if only the mark was torn */
    if (record.state == STATE_PENDING) {
        flash_read(flash_addr(slot_page(slot)), work, JOURNAL_TARGET_BYTES);
        if (crc16_bytes(CRC16_START, work, JOURNAL_TARGET_BYTES) != record.content_crc) {
            result = JOURNAL_LOST;
        } else if (write_data((uint16_t)(FIRST_TARGET + record.target * TARGET_PAGES), work) == FLASH_OK) {
            result = JOURNAL_RESTORED;
        } else {
            return JOURNAL_FAILED;
        }
    }
    return mark_done(slot, &record) == FLASH_OK ? result : JOURNAL_FAILED;
}

bool journal_is_pending(void)
{
    record_t record;
    return find_newest(&record) != NO_SLOT && record.state == STATE_PENDING;
}

flash_status_t journal_void(void)
{
    record_t record;
    uint8_t slot = find_newest(&record);
    if (slot == NO_SLOT || record.state == STATE_DONE) {
        return FLASH_OK;
    }
    return mark_done(slot, &record);
}
