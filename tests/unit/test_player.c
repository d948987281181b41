/* SPDX-License-Identifier: MIT
 * Times and way-points of a play; both laws where they agree. */
#include "player_stage.h"
#include "unity.h"

/* --- time -------------------------------------------------------------------------------------------------------- */

static void test_player_exact_time_base_takes_time_ticks_and_ends_with_the_last_output(void)
{
    sparse_step(1, 40, 0, 700);
    start(1);
    for (uint8_t tick = 1; tick < 40; tick++) {
        TEST_ASSERT_EQUAL_HEX8(PLAYER_EV_OUTPUT, player_tick(&player, &l) & (PLAYER_EV_OUTPUT | PLAYER_EV_ENDED));
        TEST_ASSERT_LESS_OR_EQUAL_UINT16(tick < 38 ? 699 : 700, player_goal(&player, 0));
    }
    TEST_ASSERT_EQUAL_HEX8(PLAYER_EV_OUTPUT | PLAYER_EV_ENDED, player_tick(&player, &l));
    TEST_ASSERT_EQUAL_UINT16(700, player_goal(&player, 0));
    TEST_ASSERT_EQUAL_HEX8(0, player_tick(&player, &l));
    TEST_ASSERT_FALSE(player_is_moving(&player));
}

/* Distance 120: 40 * 120 * 32 / (3 * 100 * 32) = 16 ticks at speed 100. */
static void test_player_exact_speed_base_takes_the_time_of_the_longest_way(void)
{
    sparse_pages[1].schedule = PAGE_SCHEDULE_SPEED;
    sparse_step(1, 100, 0, 512 + 120);
    sparse_pages[1].step[0].pos[1] = 512 - 7;
    start(1);
    TEST_ASSERT_EQUAL_UINT16(16, run_to_end());
}

/* 7 steps of 3 * 48 / 32 = 4.5 ticks are 31.5 ticks. */
static void test_player_exact_carries_fractions_of_ticks(void)
{
    sparse_pages[1].speed = 48;
    for (uint8_t step = 0; step < 7; step++) {
        sparse_step(1, 3, 0, (uint16_t)(520 + 10 * step));
    }
    start(1);
    TEST_ASSERT_UINT16_WITHIN(1, 31, run_to_end());
}

static void test_player_exact_plays_steps_of_one_and_two_ticks(void)
{
    uint8_t seen;
    sparse_step(1, 1, 0, 520);
    sparse_step(1, 2, 0, 500);
    sparse_step(1, 1, 0, 400);
    start(1);
    (void)player_tick(&player, &l);
    TEST_ASSERT_EQUAL_UINT16(520, player_goal(&player, 2));
    TEST_ASSERT_EQUAL_UINT16(2, run_until(PLAYER_EV_OUTPUT, &seen) + run_until(PLAYER_EV_OUTPUT, &seen));
    TEST_ASSERT_EQUAL_UINT16(500, player_goal(&player, 2));
    TEST_ASSERT_EQUAL_UINT16(1, run_to_end());
    TEST_ASSERT_EQUAL_UINT16(400, player_goal(&player, 2));
}

/* pause * speed / 32 in time base, pause * 32 / speed in speed base; no output during the pause. */
static void test_player_pause_scales_with_the_schedule(void)
{
    sparse_pages[1].speed = 64;
    sparse_step(1, 10, 15, 600);
    start(1);
    TEST_ASSERT_EQUAL_UINT16(20 + 30, run_to_end());
    setUp();
    sparse_pages[1].speed = 64;
    sparse_pages[1].schedule = PAGE_SCHEDULE_SPEED;
    sparse_step(1, 50, 15, 512 + 120);
    start(1);
    TEST_ASSERT_UINT16_WITHIN(1, 16 + 7, run_to_end()); /* 7.5 */
    uint8_t seen;
    setUp();
    sparse_step(1, 10, 5, 600);
    start(1);
    for (uint8_t tick = 1; tick <= 10; tick++) {
        TEST_ASSERT_BITS(PLAYER_EV_OUTPUT, PLAYER_EV_OUTPUT, player_tick(&player, &l));
    }
    for (uint8_t tick = 1; tick < 5; tick++) {
        TEST_ASSERT_EQUAL_HEX8(0, player_tick(&player, &l));
    }
    TEST_ASSERT_EQUAL_UINT16(1, run_until(PLAYER_EV_ENDED, &seen));
    TEST_ASSERT_EQUAL_HEX8(PLAYER_EV_ENDED, seen);
}

/* --- way-points -------------------------------------------------------------------------------------------------- */

static void test_player_exact_runs_through_a_way_point_on_its_way(void)
{
    sparse_step(1, 32, 0, 612);
    sparse_step(1, 32, 0, 712);
    start(1);
    for (uint8_t tick = 1; tick < 32; tick++) {
        (void)player_tick(&player, &l);
    }
    uint16_t before = player_goal(&player, 0);
    (void)player_tick(&player, &l);
    TEST_ASSERT_EQUAL_UINT16(612, player_goal(&player, 0));
    TEST_ASSERT_UINT16_WITHIN(1, 3, 612 - before); /* the mean speed of both steps: 100 / 32 */
    (void)player_tick(&player, &l);
    TEST_ASSERT_UINT16_WITHIN(1, 3, player_goal(&player, 0) - 612);
}

static void test_player_exact_stands_at_a_turning_point_a_pause_and_the_end(void)
{
    sparse_step(1, 32, 0, 712);
    sparse_step(1, 32, 1, 512);
    sparse_step(1, 32, 0, 312);
    start(1);
    for (uint8_t step = 0; step < 3; step++) {
        for (uint8_t tick = 1; tick < 32; tick++) {
            (void)player_tick(&player, &l);
        }
        uint16_t before = player_goal(&player, 0), target = sparse_pages[1].step[step].pos[0];
        (void)player_tick(&player, &l);
        TEST_ASSERT_EQUAL_UINT16(target, player_goal(&player, 0));
        TEST_ASSERT_UINT16_WITHIN(1, target, before); /* the last of 16 decelerating ticks: 400 / 32 / 16 / 2 units */
        if (step == 1) {
            (void)player_tick(&player, &l);
        }
    }
}

static void test_player_exact_joins_repetitions_and_pages_like_steps(void)
{
    uint8_t seen;
    sparse_pages[1].next = 2;
    sparse_step(1, 32, 0, 612);
    sparse_step(2, 32, 0, 712);
    start(1);
    (void)run_until(PLAYER_EV_STEP, &seen);
    TEST_ASSERT_EQUAL_UINT16(32, run_until(PLAYER_EV_STEP, &seen));
    TEST_ASSERT_BITS(PLAYER_EV_PAGE, PLAYER_EV_PAGE, seen);
    TEST_ASSERT_EQUAL_UINT8(2, player.now.page);
    TEST_ASSERT_UINT16_WITHIN(1, 615, player_goal(&player, 0));
}

static uint16_t noise(void)
{
    static uint32_t state = 12345;
    state = state * 1664525u + 1013904223u;
    return (uint16_t)(state >> 16);
}

/* Joint 1 mirrors joint 0 (1023 - p). No joint passes its way-point; each step ends on it. */
static void test_player_exact_mirrors_and_never_overshoots_whatever_the_page(void)
{
    for (uint8_t round = 0; round < 40; round++) {
        setUp();
        sparse_pages[1].accel = (uint8_t)noise();
        sparse_pages[1].speed = (uint8_t)(1 + noise() % 64);
        sparse_pages[1].schedule = noise() % 2 != 0 ? PAGE_SCHEDULE_TIME : PAGE_SCHEDULE_SPEED;
        for (uint8_t step = 0; step < 7; step++) {
            sparse_step(1, (uint8_t)(1 + noise() % 90), noise() % 4 != 0 ? 0 : 3, noise() % 1024);
            sparse_pages[1].step[step].pos[1] = (uint16_t)(1023 - sparse_pages[1].step[step].pos[0]);
        }
        pose[0] = 300;
        pose[1] = 723;
        start(1);
        uint16_t low = 0, high = 1023, target = 300;
        for (uint16_t tick = 0; player_is_moving(&player) && tick < 20000u; tick++) {
            uint16_t before = player_goal(&player, 0);
            if ((player_tick(&player, &l) & PLAYER_EV_STEP) != 0) {
                TEST_ASSERT_EQUAL_UINT16(target, before);
                target = sparse_pages[1].step[player.now.step - 1].pos[0];
                low = before < target ? before : target;
                high = before < target ? target : before;
            }
            TEST_ASSERT_TRUE(player_goal(&player, 0) >= low && player_goal(&player, 0) <= high);
            TEST_ASSERT_EQUAL_UINT16(1023 - player_goal(&player, 0), player_goal(&player, 1));
        }
        TEST_ASSERT_FALSE(player_is_moving(&player));
        TEST_ASSERT_EQUAL_UINT16(target, player_goal(&player, 0));
    }
}

/* LAWS.md section 1, rules 7 and 8, where the speed wraps: 800 units in one tick without ramps are K / 4 = 170666 / 4 =
 * 42666, as int16 -22870, limited to -1023. The next page starts with that speed, because nothing resets it. */
static void test_player_classic_speed_wraps_before_it_is_limited(void)
{
    pose[0] = 100;
    sparse_pages[1].accel = 0;
    sparse_pages[1].next = 2;
    sparse_step(1, 1, 0, 900);
    sparse_pages[2].accel = 4;
    sparse_step(2, 20, 0, 700);
    start_law(1, PLAYER_LAW_CLASSIC);
    uint8_t seen;
    (void)run_until(PLAYER_EV_STEP, &seen);
    (void)run_until(PLAYER_EV_STEP, &seen);
    int32_t carried = -1023, units = (700 - 900) * 2560l / 12, speed = (units - carried * 2 * 4) / (4 * (20 - 4));
    int32_t change = (speed - carried) * 1 / 4;
    int32_t way = ((carried + (change >> 1)) * 1 * 144 / 15) >> 9;
    TEST_ASSERT_EQUAL_UINT16(900 + way, player_goal(&player, 0));
}
