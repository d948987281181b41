/* SPDX-License-Identifier: MIT */
#include "sparse_pages.h"
#include <string.h>

sparse_page_t sparse_pages[SPARSE_PAGES];

static uint8_t header_byte(const sparse_page_t *page, uint16_t at)
{
    switch (at) {
    case PAGE_AT_PLAY_COUNT:
        return page->count;
    case PAGE_AT_SCHEDULE:
        return page->schedule;
    case PAGE_AT_STEPS:
        return page->steps;
    case PAGE_AT_SPEED:
        return page->speed;
    case PAGE_AT_ACCEL_TIME:
        return page->accel;
    case PAGE_AT_NEXT_PAGE:
        return page->next;
    case PAGE_AT_EXIT_PAGE:
        return page->exit;
    case PAGE_AT_LINKED1_PAGE:
        return page->link1;
    case PAGE_AT_LINKED1_CODE:
        return page->code1;
    default:
        return at >= PAGE_AT_COMPLIANCE ? page->compliance : 0;
    }
}

static uint8_t step_byte(const sparse_step_t *step, uint16_t at)
{
    if (at == PAGE_STEP_AT_PAUSE) {
        return step->pause;
    }
    if (at == PAGE_STEP_AT_SPEED) {
        return step->time;
    }
    uint16_t word = at / 2 < SPARSE_JOINTS ? step->pos[at / 2] : PAGE_POS_UNUSED;
    return (uint8_t)((at & 1) != 0 ? word >> 8 : word);
}

static void read_bytes(void *context, uint8_t page, uint16_t offset, void *to, uint8_t count)
{
    (void)context;
    uint8_t *bytes = to;
    for (; count != 0; count--, offset++) {
        const sparse_page_t *from = &sparse_pages[page];
        *bytes++ = offset < PAGE_AT_STEP0
                       ? header_byte(from, offset)
                       : step_byte(&from->step[offset / PAGE_STEP_BYTES - 1], offset % PAGE_STEP_BYTES);
    }
}

static uint8_t check(void *context, uint8_t page)
{
    (void)context;
    return page >= SPARSE_PAGES || sparse_pages[page].damaged ? PAGE_ERR_CHECKSUM : PAGE_OK;
}

const page_source_t sparse_source = {0, read_bytes, check};

void sparse_clear(void)
{
    memset(sparse_pages, 0, sizeof sparse_pages);
    for (uint8_t i = 0; i < SPARSE_PAGES; i++) {
        sparse_pages[i].count = 1;
        sparse_pages[i].schedule = PAGE_SCHEDULE_TIME;
        sparse_pages[i].speed = PAGE_SPEED_NOMINAL;
        sparse_pages[i].accel = PAGE_ACCEL_DEFAULT;
        sparse_pages[i].compliance = PAGE_COMPLIANCE_DEFAULT;
    }
}

void sparse_step(uint8_t page, uint8_t time, uint8_t pause, uint16_t pos)
{
    sparse_step_t *step = &sparse_pages[page].step[sparse_pages[page].steps++];
    step->time = time;
    step->pause = pause;
    for (uint8_t i = 0; i < SPARSE_JOINTS; i++) {
        step->pos[i] = pos;
    }
}
