/* SPDX-License-Identifier: MIT
 * The page codec and the page store on any 512 bytes: option byte (bit 0: seal the page), then the page. */
#include "fuzz.h"
#include "fake_flash.h"
#include "page.h"
#include "page_store.h"
#include "trap.h"

#include <string.h>

#define NUMBER 77u

/* Repeats page_check piecewise, by the table in PAGE_FORMAT.md. */
static page_status_t check_in_pieces(const uint8_t *page)
{
    uint8_t sum = 0;
    for (uint16_t at = 0; at < PAGE_BYTES; at = (uint16_t)(at + PAGE_STEP_BYTES)) {
        sum = page_sum(sum, &page[at], PAGE_STEP_BYTES);
    }
    if (sum != PAGE_CHECKSUM_SUM) {
        return PAGE_ERR_CHECKSUM;
    }
    page_status_t status = page_check_header(page);
    for (unsigned step = 0; status == PAGE_OK && step < page[PAGE_AT_STEPS]; step++) {
        status = page_check_step(&page[PAGE_AT_STEP0 + step * PAGE_STEP_BYTES]);
    }
    return status;
}

static void must_be_sound(const uint8_t *page)
{
    ASSERT(page[20] <= 7 && (page[16] == 0 || page[16] == 10) && page[22] != 0);
    for (unsigned step = 0; step < page[20]; step++) {
        for (unsigned joint = 0; joint < 31; joint++) {
            const unsigned word = page[64 + 64 * step + 2 * joint] | page[65 + 64 * step + 2 * joint] << 8;
            ASSERT(word <= 1023 || (word & 0x6000) != 0);
        }
    }
}

static void must_come_back(const uint8_t *page)
{
    uint8_t copy[PAGE_BYTES];
    memset(copy, 0xA5, sizeof copy);
    memcpy(copy, page, PAGE_STEP_BYTES);
    for (uint8_t step = 0; step < PAGE_STEPS; step++) {
        for (uint8_t joint = 0; joint < PAGE_JOINTS; joint++) {
            page_set_pos(copy, step, joint, page_pos(page, step, joint));
        }
        memcpy(&copy[64 * step + 126], &page[64 * step + 126], 2);
    }
    ASSERT(memcmp(copy, page, PAGE_BYTES) == 0);
    page_seal(copy);
    ASSERT(page_check(copy) != PAGE_ERR_CHECKSUM);
    copy[PAGE_AT_CHECKSUM] = page[PAGE_AT_CHECKSUM];
    ASSERT(memcmp(copy, page, PAGE_BYTES) == 0);
}

static void must_store(const uint8_t *page, page_status_t status)
{
    static page_store_t store;
    char name[PAGE_NAME_BYTES];
    int16_t trim[PAGE_JOINTS];
    static uint8_t ready;
    if (ready++ == 0) {
        fake_flash_reset();
        page_store_init(&store);
    }
    memcpy(fake_flash_bytes() + page_store_addr(NUMBER), page, PAGE_BYTES);
    memcpy(fake_flash_bytes() + page_store_addr(0), page, PAGE_BYTES);
    page_store_refresh(&store, NUMBER);
    page_store_refresh(&store, 0);
    ASSERT(page_store_is_good(&store, NUMBER) == (status == PAGE_OK));
    ASSERT(page_store_check(&store, NUMBER) == status);
    page_store_name(NUMBER, name);
    for (unsigned i = 0; i < strlen(name); i++) {
        ASSERT(name[i] >= ' ' && name[i] <= '~');
    }
    const uint8_t found = page_store_find(&store, name, 0);
    ASSERT(found == 0 || (found == NUMBER && status == PAGE_OK));
    const uint8_t called = page_store_find_code(&store, page[PAGE_AT_PLAY_CODE]);
    ASSERT(called == 0 || (called == NUMBER && status == PAGE_OK && page_is_playable(page)));
    const bool trimmed = page_store_trim(&store, trim);
    ASSERT(trimmed == (status == PAGE_OK));
    for (unsigned i = 0; i < PAGE_JOINTS && !trimmed; i++) {
        ASSERT(trim[i] == 0);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_t fuzz = {data, data + size};
    const uint8_t options = fuzz_byte(&fuzz);
    uint8_t page[PAGE_BYTES];
    fuzz_bytes(&fuzz, page, sizeof page);
    if ((options & 1) != 0) {
        page_seal(page);
    }
    const page_status_t status = page_check(page);
    ASSERT(status == check_in_pieces(page));
    if (status == PAGE_OK) {
        must_be_sound(page);
    }
    must_come_back(page);
    must_store(page, status);
    return 0;
}
