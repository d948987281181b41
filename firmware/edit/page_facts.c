/* SPDX-License-Identifier: MIT */
#include "page_facts.h"

#include "page_store.h"
#include "shape.h"
#include "step_ticks.h"

static uint16_t word_of(uint8_t page, uint8_t step, uint8_t joint)
{
    uint8_t word[2];
    page_store_read(page, (uint16_t)(PAGE_AT_STEP0 + PAGE_STEP_BYTES * step + 2u * joint), word, sizeof word);
    return page_word(word);
}

/* The longest distance of a joint from the previous step (step 0: from the last one). */
static uint16_t longest_distance(uint8_t page, uint8_t step)
{
    uint8_t before = (uint8_t)((step > 0 ? step : page_store_byte(page, PAGE_AT_STEPS)) - 1u);
    uint16_t longest = 0;
    for (uint8_t joint = 0; joint < PAGE_JOINTS; joint++) {
        uint16_t to = word_of(page, step, joint);
        uint16_t from = word_of(page, before, joint);
        uint16_t distance = to > from ? to - from : from - to;
        if (to <= PAGE_POS_MAX && from <= PAGE_POS_MAX && distance > longest) {
            longest = distance;
        }
    }
    return longest;
}

/* The step and its pause. */
static uint16_t step_ticks(uint8_t page, uint8_t step)
{
    uint8_t header[PAGE_AT_SPEED + 1u], last[2];
    uint16_t carry_q5_11 = STEP_TICKS_CARRY_START;
    page_store_read(page, 0, header, sizeof header);
    page_store_read(page, (uint16_t)(PAGE_AT_STEP0 + PAGE_STEP_BYTES * step + PAGE_STEP_AT_PAUSE), last, sizeof last);
    player_step_t plan = { .schedule = header[PAGE_AT_SCHEDULE], .page_speed = header[PAGE_AT_SPEED],
                           .pause = last[0], .time = last[1], .rate_percent = SHAPE_NORMAL };
    uint16_t ticks = step_ticks_exact(&plan, longest_distance(page, step), &carry_q5_11);
    return (uint16_t)(ticks + step_ticks_exact_hold(&plan, &carry_q5_11));   /* each is STEP_TICKS_MAX at most */
}

uint32_t page_facts_ticks(uint8_t page)
{
    uint32_t ticks = 0;
    uint8_t steps = page_store_byte(page, PAGE_AT_STEPS);
    for (uint8_t step = 0; step < steps; step++) {
        ticks += step_ticks(page, step);
    }
    return ticks;
}
