/* SPDX-License-Identifier: MIT
 * test_law_work.c - what a play notes of the work between two of its steps, by which the pieces of both plays are spread
 * over the ticks (law.h, LAW_WORK_). Looked at in a page layer that is ticked alone. */
#include "law.h"
#include "layers_stage.h"
#include "unity.h"

#define WALK 1u
#define WAVE 2u
#define WAVE_TICKS 30u

/* Two steps of 30 ticks each, round and round, without ramps: no section begins where a step ends. */
static void make_page(uint8_t page, uint16_t one_pos, uint16_t other_pos)
{
    sparse_step(page, WAVE_TICKS, 0, one_pos);
    sparse_step(page, WAVE_TICKS, 0, other_pos);
    sparse_pages[page].next = page;
    sparse_pages[page].accel = 0;
}

void setUp(void)
{
    sparse_clear();
    make_page(WALK, 512, 520);
    make_page(WAVE, 600, 500);
    layers_stage_reset();
}

void tearDown(void)
{
}

/* A wave of these joints over a walk, under the exact law. */
static void start(uint32_t wave_joints)
{
    layers_stage_start(WALK, PLAYER_LAW_EXACT);
    TEST_ASSERT_EQUAL(LAYERS_OK, layers_start(&layers, WAVE, wave_joints));
}

/* One tick of the layer alone; what it notes goes to *work. */
static uint8_t tick(uint8_t *work)
{
    link_t link;
    link_init(&link, LINK_LATCH);
    layers.play.work = 0;
    const uint8_t events = player_tick(&layers.play, &link);
    *work = layers.play.work;
    return events;
}

/* The notes of the last tick of a step and of the first of the next. */
static void at_the_end_of_a_step(uint8_t *last, uint8_t *first)
{
    uint8_t work = 0, events = 0;
    (void)tick(&work); /* the first step's own first tick */
    for (uint8_t ticks = 1; (events & PLAYER_EV_STEP) == 0; ticks++) {
        TEST_ASSERT_LESS_OR_EQUAL(WAVE_TICKS, ticks);
        *last = work;
        events = tick(&work);
    }
    *first = work;
}

/* One joint is planned with the taking: the next step's first tick has nothing left. */
static void test_law_work_of_the_last_tick_is_the_taking_and_a_joint(void)
{
    uint8_t last = 0, first = 0;
    start(4);
    at_the_end_of_a_step(&last, &first);
    TEST_ASSERT_EQUAL_UINT8(LAW_WORK_TAKE + LAW_WORK_PLAN_JOINT, last);
    TEST_ASSERT_EQUAL_UINT8(0, first);
}

/* More joints are more work, beside what planning them costs: each is set on its target. */
static void test_law_work_of_the_taking_grows_with_the_joints(void)
{
    uint8_t last = 0, first = 0;
    start(15);
    at_the_end_of_a_step(&last, &first);
    TEST_ASSERT_EQUAL_UINT8(4, layers.play.own_joints);
    /* planned in the tick before, and in the one behind */
    const uint8_t ahead = 4u / 3u, rest = first / LAW_WORK_PLAN_JOINT;
    TEST_ASSERT_GREATER_THAN_UINT8(LAW_WORK_TAKE + LAW_WORK_PLAN_JOINT * (4u - ahead - rest), last);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_law_work_of_the_last_tick_is_the_taking_and_a_joint);
    RUN_TEST(test_law_work_of_the_taking_grows_with_the_joints);
    return UNITY_END();
}
