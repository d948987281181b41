/* SPDX-License-Identifier: MIT */
#include "page_facts.h"

#include "compiler.h"
#include "page_store.h"
#include "shape.h"
#include "step_ticks.h"

uint16_t page_facts_word(uint8_t page, uint8_t step, uint8_t joint)
{
    uint8_t word[2];
    page_store_read(page, (uint16_t)(PAGE_AT_STEP0 + PAGE_STEP_BYTES * step + 2u * joint), word, sizeof word);
    return page_word(word);
}

static void longest_way(uint8_t page, uint8_t step, page_facts_t *facts)
{
    uint8_t before = (uint8_t)((step > 0 ? step : page_store_byte(page, PAGE_AT_STEPS)) - 1u);
    facts->distance_pos = 0;
    facts->joint = 0;
    for (uint8_t joint = 0; joint < PAGE_JOINTS; joint++) {
        uint16_t to = page_facts_word(page, step, joint);
        uint16_t from = page_facts_word(page, before, joint);
        uint16_t distance = to > from ? to - from : from - to;
        if (to <= PAGE_POS_MAX && from <= PAGE_POS_MAX && distance > facts->distance_pos) {
            facts->distance_pos = distance;
            facts->joint = joint;
        }
    }
}

void page_facts_step(uint8_t page, uint8_t step, page_facts_t *facts)
{
    uint8_t header[PAGE_AT_SPEED + 1u], last[2];
    uint16_t carry_q5_11 = STEP_TICKS_CARRY_START;
    page_store_read(page, 0, header, sizeof header);
    page_store_read(page, (uint16_t)(PAGE_AT_STEP0 + PAGE_STEP_BYTES * step + PAGE_STEP_AT_PAUSE), last, sizeof last);
    player_step_t plan = { .schedule = header[PAGE_AT_SCHEDULE], .page_speed = header[PAGE_AT_SPEED],
                           .pause = last[0], .time = last[1], .rate_percent = SHAPE_NORMAL };
    longest_way(page, step, facts);
    facts->ticks = step_ticks_exact(&plan, facts->distance_pos, &carry_q5_11);
    facts->pause_ticks = step_ticks_exact_hold(&plan, &carry_q5_11);
}

uint32_t page_facts_ticks(uint8_t page)
{
    page_facts_t facts;
    uint32_t ticks = 0;
    uint8_t steps = page_store_byte(page, PAGE_AT_STEPS);
    for (uint8_t step = 0; step < steps; step++) {
        page_facts_step(page, step, &facts);
        ticks += (uint16_t)(facts.ticks + facts.pause_ticks);   /* each is STEP_TICKS_MAX at most */
    }
    return ticks;
}

/* pos / ticks * 128 ticks/s * 300 degrees / 1024 pos = 37.5 pos / ticks. */
uint16_t page_facts_deg_s(const page_facts_t *facts)
{
    return (uint16_t)((uint32_t)facts->distance_pos * 75u / 2u / facts->ticks);
}
