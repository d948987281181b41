/* SPDX-License-Identifier: MIT */
#include "page.h"
#include "compiler.h"

uint8_t page_sum(uint8_t sum, const uint8_t *bytes, uint16_t count)
{
    while (count-- > 0) {
        sum = (uint8_t)(sum + *bytes++);
    }
    return sum;
}

page_status_t page_check_header(const uint8_t header[PAGE_STEP_BYTES])
{
    if (header[PAGE_AT_STEPS] > PAGE_STEPS) {
        return PAGE_ERR_STEPS;
    }
    if (header[PAGE_AT_SCHEDULE] != PAGE_SCHEDULE_SPEED && header[PAGE_AT_SCHEDULE] != PAGE_SCHEDULE_TIME) {
        return PAGE_ERR_SCHEDULE;
    }
    return header[PAGE_AT_SPEED] == 0 ? PAGE_ERR_SPEED : PAGE_OK;
}

page_status_t page_check_step(const uint8_t step[PAGE_STEP_BYTES])
{
    for (uint8_t joint = 0; joint < PAGE_JOINTS; joint++) {
        uint16_t word = page_word(&step[2 * joint]);
        if (page_pos_is_used(word) && word > PAGE_POS_MAX) {
            return PAGE_ERR_POSITION;
        }
    }
    return PAGE_OK;
}

page_status_t page_check(const uint8_t page[PAGE_BYTES])
{
    if (page_sum(0, page, PAGE_BYTES) != PAGE_CHECKSUM_SUM) {
        return PAGE_ERR_CHECKSUM;
    }
    page_status_t status = page_check_header(page);
    for (uint8_t step = 0; status == PAGE_OK && step < page[PAGE_AT_STEPS]; step++) {
        status = page_check_step(&page[PAGE_AT_STEP0 + PAGE_STEP_BYTES * step]);
    }
    return status;
}

void page_seal(uint8_t page[PAGE_BYTES])
{
    page[PAGE_AT_CHECKSUM] = 0;
    page[PAGE_AT_CHECKSUM] = (uint8_t)(PAGE_CHECKSUM_SUM - page_sum(0, page, PAGE_BYTES));
}

void page_clear(uint8_t page[PAGE_BYTES])
{
    memset(page, 0, PAGE_BYTES);
    page[PAGE_AT_PLAY_COUNT] = 1;
    page[PAGE_AT_SCHEDULE] = PAGE_SCHEDULE_TIME;
    page[PAGE_AT_SPEED] = PAGE_SPEED_NOMINAL;
    page[PAGE_AT_ACCEL_TIME] = PAGE_ACCEL_DEFAULT;
    memset(&page[PAGE_AT_COMPLIANCE], PAGE_COMPLIANCE_DEFAULT, PAGE_JOINTS);
    for (uint8_t step = 0; step < PAGE_STEPS; step++) {
        for (uint8_t joint = 0; joint < PAGE_JOINTS; joint++) {
            page_set_pos(page, step, joint, PAGE_POS_UNUSED);
        }
    }
    page_seal(page);
}

uint16_t page_pos(const uint8_t *page, uint8_t step, uint8_t joint)
{
    return page_word(&page[PAGE_AT_STEP0 + PAGE_STEP_BYTES * step + 2u * joint]);
}

void page_set_pos(uint8_t *page, uint8_t step, uint8_t joint, uint16_t word)
{
    memcpy(&page[PAGE_AT_STEP0 + PAGE_STEP_BYTES * step + 2u * joint], &word, sizeof word);
}

bool page_set_add(uint8_t set[PAGE_COUNT / 8], uint8_t page)
{
    uint8_t *byte = &set[page % PAGE_COUNT / 8];
    const uint8_t bit = (uint8_t)(1u << (page % 8));
    const bool is_new = (*byte & bit) == 0;
    *byte |= bit;
    return is_new;
}

bool page_is_playable(const uint8_t *header)
{
    return header[PAGE_AT_STEPS] != 0 && header[PAGE_AT_PLAY_COUNT] != 0;
}
