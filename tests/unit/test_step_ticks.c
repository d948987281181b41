/* SPDX-License-Identifier: MIT
 * test_step_ticks.c - the lengths of a step and its pause (PAGE_FORMAT.md; LAWS.md, section 1 rules 3 and 5, section 2
 * rule 1): values by hand, and plays of the longest ones. */
#include <stdlib.h>
#include "sparse_pages.h"
#include "step_ticks.h"
#include "unity.h"

#define BASE_TIME PAGE_SCHEDULE_TIME
#define BASE_SPEED PAGE_SCHEDULE_SPEED
#define MOST STEP_TICKS_MAX

/* A step over `way` units with its pause, and the expected ticks. */
typedef struct {
    player_law_t law;
    uint8_t schedule, page_speed, time, pause;
    uint16_t rate_percent, way, step_ticks, pause_ticks;
} length_t;

static const length_t lengths[] = {
    {PLAYER_LAW_EXACT, BASE_TIME, 32, 40, 8, 100, 300, 40, 8},
    {PLAYER_LAW_EXACT, BASE_TIME, 64, 40, 8, 200, 300, 40, 8},
    {PLAYER_LAW_EXACT, BASE_SPEED, 32, 100, 8, 100, 300, 40, 8}, /* 40 * 300 * 32 / (3 * 100 * 32) */
    {PLAYER_LAW_EXACT, BASE_SPEED, 64, 100, 8, 100, 300, 20, 4},
    {PLAYER_LAW_CLASSIC, BASE_TIME, 64, 40, 8, 100, 300, 80, 4},
    {PLAYER_LAW_CLASSIC, BASE_SPEED, 32, 100, 8, 100, 300, 40, 8},
    /* The longest. */
    {PLAYER_LAW_EXACT, BASE_TIME, 255, 224, 224, 10, 1000, 17850, 17850}, /* 224 * 255 / 32 / 10 % */
    {PLAYER_LAW_EXACT, BASE_SPEED, 1, 1, 1, 100, 1000, MOST, 32},         /* 426,666 */
    {PLAYER_LAW_EXACT, BASE_SPEED, 1, 1, 255, 100, 1000, MOST, 8160},
    {PLAYER_LAW_EXACT, BASE_SPEED, 1, 1, 255, 10, 1000, MOST, MOST},      /* 4,266,666 and 81,600 */
    {PLAYER_LAW_EXACT, BASE_SPEED, 1, 255, 255, 10, 2, 33, MOST},         /* 40 * 2 * 32 / (3 * 255) / 10 % */
    {PLAYER_LAW_CLASSIC, BASE_SPEED, 1, 1, 255, 100, 1000, 13333, 8160},
    {PLAYER_LAW_CLASSIC, BASE_SPEED, 1, 1, 255, 10, 1000, STEP_TICKS_CLASSIC_MAX, MOST},
    {PLAYER_LAW_CLASSIC, BASE_TIME, 1, 255, 255, 10, 300, 70, MOST},      /* 255 / 32 = 7, / 10 % */
};
#define LENGTHS (sizeof lengths / sizeof lengths[0])

static player_t player;
static player_joint_t joints[PAGE_JOINTS];
static uint16_t pose_pos[PAGE_JOINTS];
static link_t l;
static shape_t shape;

void setUp(void)
{
    sparse_clear();
    shape_init(&shape);
}

static uint16_t step_ticks(const length_t *length, const player_step_t *step)
{
    uint16_t carry = STEP_TICKS_CARRY_START;
    return length->law == PLAYER_LAW_EXACT ? step_ticks_exact(step, length->way, &carry)
                                           : step_ticks_classic(step, length->way, &carry);
}

static uint16_t pause_ticks(const length_t *length, const player_step_t *step)
{
    uint16_t carry = STEP_TICKS_CARRY_START;
    return length->law == PLAYER_LAW_EXACT ? step_ticks_exact_hold(step, &carry) : step_ticks_classic_hold(step, &carry);
}

static void test_step_ticks_lengths_by_hand(void)
{
    for (const length_t *length = lengths; length < &lengths[LENGTHS]; length++) {
        const player_step_t step = {.schedule = length->schedule, .page_speed = length->page_speed, .pause = length->pause,
                                    .time = length->time, .rate_percent = length->rate_percent};
        TEST_ASSERT_EQUAL_UINT16_MESSAGE(length->step_ticks, step_ticks(length, &step), "step");
        TEST_ASSERT_EQUAL_UINT16_MESSAGE(length->pause_ticks, pause_ticks(length, &step), "pause");
    }
}

/* Ticks from the start of the first step to that of the second. No joint jumps: in a step of N ticks over M units it
 * moves at most 2 M / N a tick (section 2, rule 2), plus one unit of rounding. */
static uint32_t play_first_step(const length_t *length)
{
    const int most = 2 * length->way / length->step_ticks + 1;
    uint32_t ticks = 0, begun = 0;
    TEST_ASSERT_EQUAL(PLAYER_OK, player_start(&player, &l, 1, length->law, pose_pos, 0xF));
    while (begun < 2 && ticks <= 2u * UINT16_MAX) {
        const int before_pos = player_goal(&player, 0);
        begun += (player_tick(&player, &l) & PLAYER_EV_STEP) != 0;
        ticks += begun == 1;
        TEST_ASSERT_LESS_OR_EQUAL_MESSAGE(most, abs(player_goal(&player, 0) - before_pos), "a joint leaps");
    }
    return ticks;
}

/* The second step is as slow, so cutting the first one short shows as a jump or a wrong length. */
static void test_step_ticks_longest_steps_are_played_whole(void)
{
    for (const length_t *length = lengths; length < &lengths[LENGTHS]; length++) {
        setUp();
        sparse_pages[1].schedule = length->schedule;
        sparse_pages[1].speed = length->page_speed;
        sparse_step(1, length->time, length->pause, length->way);
        sparse_step(1, length->time, 0, 0);
        shape.rate_percent = length->rate_percent;
        player_init(&player, &sparse_source, joints);
        player.shape = &shape;
        link_init(&l, LINK_LATCH);
        const uint32_t ticks = (uint32_t)length->step_ticks + length->pause_ticks;
        TEST_ASSERT_EQUAL_UINT32_MESSAGE(ticks, play_first_step(length), "ticks");
    }
}
