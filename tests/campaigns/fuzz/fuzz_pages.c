/* SPDX-License-Identifier: MIT */
#include "fuzz_pages.h"
#include "trap.h"

#include <stdbool.h>
#include <string.h>

uint8_t fuzz_pages[FUZZ_PAGES + 1][PAGE_BYTES];

static void read_page(void *context, uint8_t page, uint16_t offset, void *to, uint8_t count)
{
    (void)context;
    ASSERT(page < PAGE_COUNT && offset + count <= PAGE_BYTES);
    if (page <= FUZZ_PAGES) {
        memcpy(to, &fuzz_pages[page][offset], count);
    } else {
        memset(to, 0xFF, count);
    }
}

static uint8_t check_page(void *context, uint8_t page)
{
    (void)context;
    ASSERT(page < PAGE_COUNT);
    return page <= FUZZ_PAGES ? (uint8_t)page_check(fuzz_pages[page]) : PAGE_ERR_CHECKSUM;
}

const page_source_t fuzz_pages_source = {.read = read_page, .check = check_page};

static void make_step(uint8_t *page, uint8_t step, bool wild, fuzz_t *fuzz)
{
    static const uint8_t joints[] = {0, 1, 17, 30};
    uint8_t *at = &page[PAGE_AT_STEP0 + step * PAGE_STEP_BYTES];
    at[PAGE_STEP_AT_PAUSE] = fuzz_byte(fuzz);
    at[PAGE_STEP_AT_SPEED] = fuzz_byte(fuzz);
    for (unsigned i = 0; i < sizeof joints; i++) {
        const uint16_t word = fuzz_word(fuzz);
        page_set_pos(page, step, joints[i], wild ? word : word & 0x63FF);
    }
}

static void make_page(uint8_t *page, fuzz_t *fuzz)
{
    const uint8_t options = fuzz_byte(fuzz);
    const bool wild = (options & 7) >= 5;
    page_clear(page);
    for (unsigned at = PAGE_AT_PLAY_COUNT; at < PAGE_AT_CHECKSUM; at++) {
        page[at] = at < PAGE_AT_STEPS && at > PAGE_AT_SCHEDULE ? 0 : fuzz_byte(fuzz);
    }
    if (!wild) {
        page[PAGE_AT_SCHEDULE] = page[PAGE_AT_SCHEDULE] & 1 ? PAGE_SCHEDULE_TIME : PAGE_SCHEDULE_SPEED;
        page[PAGE_AT_STEPS] &= 7;
        page[PAGE_AT_SPEED] |= page[PAGE_AT_SPEED] == 0;
        for (unsigned at = PAGE_AT_NEXT_PAGE; at <= PAGE_AT_LINKED2_PAGE; at++) {
            page[at] = at == PAGE_AT_LINKED1_CODE ? page[at] : page[at] % (FUZZ_PAGES + 2);
        }
    }
    memset(&page[PAGE_AT_COMPLIANCE], options, 4);
    for (uint8_t step = 0; step < PAGE_STEPS && step < page[PAGE_AT_STEPS]; step++) {
        make_step(page, step, wild, fuzz);
    }
    page_seal(page);
    if ((options & 7) == 7) {
        page[PAGE_AT_CHECKSUM] = fuzz_byte(fuzz);
    }
}

void fuzz_pages_make(fuzz_t *fuzz)
{
    memset(fuzz_pages, 0, sizeof fuzz_pages);
    for (unsigned page = 1; page <= FUZZ_PAGES; page++) {
        make_page(fuzz_pages[page], fuzz);
    }
}

void fuzz_pages_set(uint8_t page, uint8_t at, uint8_t byte)
{
    const bool is_good = page_check(fuzz_pages[page]) == PAGE_OK;
    fuzz_pages[page][at] = byte;
    if (is_good) {
        page_seal(fuzz_pages[page]);
    }
}
