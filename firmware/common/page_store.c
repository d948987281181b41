/* SPDX-License-Identifier: MIT */
#include "page_store.h"
#include "flash.h"
#include "memory_map.h"
#include "target.h"
#include "system.h"

#include <string.h>

STATIC_ASSERT(TARGET_FLASH_END - TARGET_MOTION_START == (uint32_t)PAGE_BYTES * PAGE_COUNT,
              "the pages are the last that may be written");

uint32_t page_store_addr(uint8_t page)
{
    return TARGET_MOTION_START + (uint32_t)(page * PAGE_BYTES);
}

void page_store_read(uint8_t page, uint16_t offset, void *to, uint16_t count)
{
    flash_read(page_store_addr(page) + offset, to, count);
}

uint8_t page_store_byte(uint8_t page, uint16_t offset)
{
    uint8_t byte;
    page_store_read(page, offset, &byte, 1);
    return byte;
}

static void source_read(void *context, uint8_t page, uint16_t offset, void *to, uint8_t count)
{
    page_store_read(page, offset, to, count);
}

static uint8_t source_check(void *context, uint8_t page)
{
    return page_store_check(context, page);
}

/* Reads 64 bytes at a time, so that it needs no RAM for a whole page. */
page_status_t page_store_look(uint8_t page)
{
    uint8_t block[PAGE_STEP_BYTES];
    uint8_t sum = 0, steps = 0;
    page_status_t header = PAGE_OK, position = PAGE_OK;
    for (uint16_t offset = 0; offset < PAGE_BYTES; offset += PAGE_STEP_BYTES) {
        page_store_read(page, offset, block, PAGE_STEP_BYTES);
        sum = page_sum(sum, block, PAGE_STEP_BYTES);
        if (offset == 0) {
            header = page_check_header(block);
            steps = block[PAGE_AT_STEPS];
        } else if (position == PAGE_OK && offset / PAGE_STEP_BYTES <= steps) {
            position = page_check_step(block);
        }
    }
    if (sum != PAGE_CHECKSUM_SUM) {
        return PAGE_ERR_CHECKSUM;
    }
    return header != PAGE_OK ? header : position;
}

void page_store_refresh(page_store_t *store, uint8_t page)
{
    uint8_t bit = 1u << (page & 7u);
    if (page_store_look(page) == PAGE_OK) {
        store->good[page >> 3] |= bit;
    } else {
        store->good[page >> 3] &= ~bit;
    }
}

void page_store_init(page_store_t *store)
{
    store->source.context = store;
    store->source.read = source_read;
    store->source.check = source_check;
    for (uint16_t page = 0; page < PAGE_COUNT; page++) {
        page_store_refresh(store, (uint8_t)page);
        system_kick();
    }
}

bool page_store_is_good(const page_store_t *store, uint8_t page)
{
    return page_is_there(page) && (store->good[page >> 3] & (1u << (page & 7u)));
}

page_status_t page_store_check(const page_store_t *store, uint8_t page)
{
    return page_store_is_good(store, page) ? PAGE_OK : page_store_look(page);
}

bool page_store_is_erased(uint8_t page)
{
    for (uint16_t offset = 0; offset < PAGE_BYTES; offset++) {
        if (page_store_byte(page, offset) != 0xFF) {
            return false;
        }
    }
    return true;
}

bool page_store_is_damaged(const page_store_t *store, uint8_t page)
{
    return !page_store_is_good(store, page) && !page_store_is_erased(page);
}

void page_store_name(uint8_t page, char name[PAGE_NAME_BYTES])
{
    uint8_t length = 0;
    page_store_read(page, PAGE_AT_NAME, name, PAGE_NAME_BYTES);
    while (length < PAGE_NAME_BYTES - 1u && name[length] >= ' ' && name[length] <= '~') {
        length++;
    }
    memset(name + length, 0, PAGE_NAME_BYTES - length);
}

uint8_t page_store_find(const page_store_t *store, const char *name, uint8_t after)
{
    char found[PAGE_NAME_BYTES];
    for (uint16_t number = after + 1u; number < PAGE_COUNT; number++) {
        const uint8_t page = (uint8_t)number;
        if (page_store_is_good(store, page)) {
            page_store_name(page, found);
            if (strcasecmp(name, found) == 0) {
                return page;
            }
        }
    }
    return 0;
}

uint8_t page_store_find_code(const page_store_t *store, uint8_t code)
{
    uint8_t header[PAGE_AT_PLAY_CODE + 1u];
    for (uint16_t number = 1; number < PAGE_COUNT; number++) {
        const uint8_t page = (uint8_t)number;
        if (page_store_byte(page, PAGE_AT_PLAY_CODE) == code && page_store_is_good(store, page)) {
            page_store_read(page, 0, header, sizeof header);
            if (page_is_playable(header)) {
                return page;
            }
        }
    }
    return 0;
}

bool page_store_trim(const page_store_t *store, int16_t trim_pos[PAGE_JOINTS])
{
    memset(trim_pos, 0, PAGE_JOINTS * sizeof *trim_pos);
    if (!page_store_is_good(store, 0)) {
        return false;
    }
    page_store_read(0, PAGE_AT_STEP0 + 2u * PAGE_STEP_BYTES, trim_pos, PAGE_JOINTS * sizeof *trim_pos);
    for (uint8_t joint = 0; joint < PAGE_JOINTS; joint++) {
        const uint16_t value = page_word((const uint8_t *)&trim_pos[joint]);
        trim_pos[joint] = (value & 0xE000u) != PAGE_POS_UNUSED ? (int16_t)value : 0;
    }
    return true;
}
