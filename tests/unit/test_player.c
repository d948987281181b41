/* SPDX-License-Identifier: MIT
 * test_player.c - time, links, events and joints of a play; both laws where they agree. */
#include "player.h"
#include "sparse_pages.h"
#include "unity.h"

#define ALL 0x7FFFFFFFul
#define TICKS_MAX 4000u

static player_t player;
static link_t l;
static uint16_t pose[PAGE_JOINTS];

void setUp(void)
{
    sparse_clear();
    for (uint8_t i = 0; i < PAGE_JOINTS; i++) {
        pose[i] = 512;
    }
    player_init(&player, &sparse_source);
    link_init(&l, LINK_LATCH);
}

void tearDown(void)
{
}

static void start_law(uint8_t page, player_law_t law)
{
    TEST_ASSERT_EQUAL(PLAYER_OK, player_start(&player, &l, page, law, pose, ALL));
}

static void start(uint8_t page)
{
    start_law(page, PLAYER_LAW_EXACT);
}

/* Ticks until one of `events`; that tick's events in *seen. */
static uint16_t run_until(uint8_t events, uint8_t *seen)
{
    for (uint16_t tick = 1; tick < TICKS_MAX; tick++) {
        *seen = player_tick(&player, &l);
        if ((*seen & events) != 0) {
            return tick;
        }
    }
    TEST_FAIL_MESSAGE("never");
    return 0;
}

static uint16_t run_to_end(void)
{
    uint8_t seen;
    return run_until(PLAYER_EV_ENDED, &seen);
}

/* --- time -------------------------------------------------------------------------------------------------------- */

static void test_player_exact_time_base_takes_time_ticks_and_ends_with_the_last_output(void)
{
    sparse_step(1, 40, 0, 700);
    start(1);
    for (uint8_t tick = 1; tick < 40; tick++) {
        TEST_ASSERT_EQUAL_HEX8(PLAYER_EV_OUTPUT, player_tick(&player, &l) & (PLAYER_EV_OUTPUT | PLAYER_EV_ENDED));
        TEST_ASSERT_LESS_OR_EQUAL_UINT16(tick < 38 ? 699 : 700, player.goal_pos[0]);
    }
    TEST_ASSERT_EQUAL_HEX8(PLAYER_EV_OUTPUT | PLAYER_EV_ENDED, player_tick(&player, &l));
    TEST_ASSERT_EQUAL_UINT16(700, player.goal_pos[0]);
    TEST_ASSERT_EQUAL_HEX8(0, player_tick(&player, &l));
    TEST_ASSERT_FALSE(player_is_moving(&player));
}

/* 40 units of way * 40 * 32 / (3 * 100 * 32): 120 units at speed 100 are 16 ticks. */
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
    TEST_ASSERT_EQUAL_UINT16(520, player.goal_pos[2]);
    TEST_ASSERT_EQUAL_UINT16(2, run_until(PLAYER_EV_OUTPUT, &seen) + run_until(PLAYER_EV_OUTPUT, &seen));
    TEST_ASSERT_EQUAL_UINT16(500, player.goal_pos[2]);
    TEST_ASSERT_EQUAL_UINT16(1, run_to_end());
    TEST_ASSERT_EQUAL_UINT16(400, player.goal_pos[2]);
}

/* pause * speed / 32 in time base, pause * 32 / speed in speed base; nothing is made meanwhile. */
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
    uint16_t before = player.goal_pos[0];
    (void)player_tick(&player, &l);
    TEST_ASSERT_EQUAL_UINT16(612, player.goal_pos[0]);
    TEST_ASSERT_UINT16_WITHIN(1, 3, 612 - before); /* the mean speed of both steps: 100 / 32 */
    (void)player_tick(&player, &l);
    TEST_ASSERT_UINT16_WITHIN(1, 3, player.goal_pos[0] - 612);
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
        uint16_t before = player.goal_pos[0], target = sparse_pages[1].step[step].pos[0];
        (void)player_tick(&player, &l);
        TEST_ASSERT_EQUAL_UINT16(target, player.goal_pos[0]);
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
    TEST_ASSERT_EQUAL_UINT8(2, player.page);
    TEST_ASSERT_UINT16_WITHIN(1, 615, player.goal_pos[0]);
}

static uint16_t noise(void)
{
    static uint32_t state = 12345;
    state = state * 1664525u + 1013904223u;
    return (uint16_t)(state >> 16);
}

/* Joint 1 mirrors joint 0 (1023 - p). Nothing passes its way-point; each step ends on it. */
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
            uint16_t before = player.goal_pos[0];
            if ((player_tick(&player, &l) & PLAYER_EV_STEP) != 0) {
                TEST_ASSERT_EQUAL_UINT16(target, before);
                target = sparse_pages[1].step[player.step - 1].pos[0];
                low = before < target ? before : target;
                high = before < target ? target : before;
            }
            TEST_ASSERT_TRUE(player.goal_pos[0] >= low && player.goal_pos[0] <= high);
            TEST_ASSERT_EQUAL_UINT16(1023 - player.goal_pos[0], player.goal_pos[1]);
        }
        TEST_ASSERT_FALSE(player_is_moving(&player));
        TEST_ASSERT_EQUAL_UINT16(target, player.goal_pos[0]);
    }
}

/* player.md section 1, rules 7 and 8, where the speed wraps: 800 units in one tick without ramps are K / 4 = 170666 / 4 =
 * 42666, as int16 -22870, limited to -1023; with that speed, left standing, the next page begins. */
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
    TEST_ASSERT_EQUAL_UINT16(900 + way, player.goal_pos[0]);
}

/* --- joints ------------------------------------------------------------------------------------------------------ */

static void unused_joint_waits(player_law_t law)
{
    sparse_step(1, 30, 0, 600);
    sparse_step(1, 30, 0, 700);
    sparse_pages[1].step[0].pos[3] = 0x43FF;
    sparse_pages[1].step[0].pos[2] = 0x2200;
    start_law(1, law);
    for (uint8_t tick = 0; tick < 30; tick++) {
        (void)player_tick(&player, &l);
        TEST_ASSERT_EQUAL_UINT16(512, player.goal_pos[3]);
        TEST_ASSERT_EQUAL_UINT16(512, player.goal_pos[2]);
        TEST_ASSERT_EQUAL_HEX32(tick < 29 ? 0x3 : 0xF, player.joints); /* from the step's beginning, when it is reached */
    }
    for (uint8_t tick = 0; tick < 30; tick++) {
        (void)player_tick(&player, &l);
    }
    TEST_ASSERT_EQUAL_HEX32(0xF, player.joints);
    TEST_ASSERT_UINT16_WITHIN(law == PLAYER_LAW_CLASSIC ? 2 : 0, 700, player.goal_pos[3]);
}

static void test_player_unused_joint_keeps_its_target_and_starts_from_there(void)
{
    unused_joint_waits(PLAYER_LAW_EXACT);
    setUp();
    unused_joint_waits(PLAYER_LAW_CLASSIC);
}

static void test_player_absent_joint_is_never_touched_nor_timed(void)
{
    sparse_pages[1].schedule = PAGE_SCHEDULE_SPEED;
    sparse_step(1, 100, 0, 512 + 120);
    sparse_pages[1].step[0].pos[3] = 0;
    pose[3] = 900;
    TEST_ASSERT_EQUAL(PLAYER_OK, player_start(&player, &l, 1, PLAYER_LAW_EXACT, pose, 0x7));
    TEST_ASSERT_EQUAL_UINT16(16, run_to_end());
    TEST_ASSERT_EQUAL_UINT16(900, player.goal_pos[3]);
    TEST_ASSERT_EQUAL_HEX32(0x7, player.joints);
}

static void dropped_joint_stays(player_law_t law)
{
    sparse_step(1, 30, 0, 700);
    sparse_step(1, 30, 0, 500);
    sparse_step(1, 30, 0, 300);
    start_law(1, law);
    for (uint8_t tick = 0; tick < 12; tick++) {
        (void)player_tick(&player, &l);
    }
    uint16_t at = player.goal_pos[1];
    TEST_ASSERT_GREATER_THAN_UINT16(520, at);
    player_drop_joints(&player, 1ul << 1);
    for (uint16_t tick = 0; player_is_moving(&player) && tick < TICKS_MAX; tick++) {
        (void)player_tick(&player, &l);
        TEST_ASSERT_EQUAL_UINT16(at, player.goal_pos[1]);
    }
    TEST_ASSERT_EQUAL_HEX32(0xD, player.joints);
    TEST_ASSERT_UINT16_WITHIN(law == PLAYER_LAW_CLASSIC ? 3 : 0, 300, player.goal_pos[0]);
}

static void test_player_dropped_joint_keeps_its_goal(void)
{
    dropped_joint_stays(PLAYER_LAW_EXACT);
    setUp();
    dropped_joint_stays(PLAYER_LAW_CLASSIC);
}

static void test_player_first_pose_tells_the_joints_of_step_1(void)
{
    sparse_step(1, 30, 0, 700);
    sparse_pages[1].step[0].pos[2] = 0x4000;
    TEST_ASSERT_EQUAL_HEX32(0xB, player_first_pose(&sparse_source, 1, pose));
    TEST_ASSERT_EQUAL_UINT16(700, pose[3]);
    TEST_ASSERT_EQUAL_UINT16(512, pose[2]);
}

/* --- pages and links --------------------------------------------------------------------------------------------- */

static void test_player_refuses_what_cannot_be_played(void)
{
    sparse_step(2, 10, 0, 600);
    sparse_pages[2].damaged = true;
    sparse_pages[3].count = 0;
    sparse_pages[3].next = 3;
    TEST_ASSERT_EQUAL(PLAYER_ERR_RANGE, player_start(&player, &l, 0, PLAYER_LAW_EXACT, pose, ALL));
    TEST_ASSERT_EQUAL(PLAYER_ERR_RANGE, player_start(&player, &l, 128, PLAYER_LAW_EXACT, pose, ALL));
    TEST_ASSERT_EQUAL(PLAYER_ERR_PAGE, player_start(&player, &l, 2, PLAYER_LAW_EXACT, pose, ALL));
    TEST_ASSERT_EQUAL(PAGE_ERR_CHECKSUM, player.fault);
    TEST_ASSERT_EQUAL_UINT8(2, player.fault_page);
    TEST_ASSERT_EQUAL(PLAYER_ERR_EMPTY, player_start(&player, &l, 1, PLAYER_LAW_EXACT, pose, ALL));
    TEST_ASSERT_EQUAL(PLAYER_ERR_EMPTY, player_start(&player, &l, 3, PLAYER_LAW_EXACT, pose, ALL));
    sparse_step(1, 10, 0, 600);
    start(1);
    TEST_ASSERT_EQUAL(PLAYER_ERR_BUSY, player_start(&player, &l, 1, PLAYER_LAW_EXACT, pose, ALL));
}

static void repetitions_then_link(player_law_t law)
{
    uint8_t seen, repetition = 0;
    sparse_step(1, 10, 0, 600);
    sparse_step(1, 10, 0, 500);
    sparse_pages[1].count = 3;
    sparse_pages[1].next = 2;
    sparse_step(2, 10, 0, 550);
    start_law(1, law);
    do {
        (void)run_until(PLAYER_EV_PAGE | PLAYER_EV_LINK, &seen);
        if ((seen & PLAYER_EV_PAGE) != 0) {
            TEST_ASSERT_EQUAL_UINT8(++repetition, player.repetition);
            TEST_ASSERT_EQUAL_UINT8(1, player.page);
        }
    } while ((seen & PLAYER_EV_LINK) == 0);
    TEST_ASSERT_EQUAL_UINT8(3, repetition);
    TEST_ASSERT_EQUAL_UINT8(2, player.next_page);
    TEST_ASSERT_EQUAL(LINK_NEXT, player.link_taken);
    (void)run_until(PLAYER_EV_PAGE, &seen);
    TEST_ASSERT_EQUAL_UINT8(2, player.page);
    TEST_ASSERT_EQUAL_UINT8(1, player.repetition);
    (void)run_to_end();
    TEST_ASSERT_EQUAL(PAGE_OK, player.fault);
}

static void test_player_plays_a_page_play_count_times_before_its_link(void)
{
    repetitions_then_link(PLAYER_LAW_EXACT);
    setUp();
    repetitions_then_link(PLAYER_LAW_CLASSIC);
}

static void test_player_stop_ends_the_repetitions_through_the_exit_page(void)
{
    uint8_t seen;
    sparse_step(1, 10, 0, 600);
    sparse_step(1, 10, 0, 500);
    sparse_pages[1].count = 200;
    sparse_pages[1].exit = 3;
    sparse_step(3, 10, 0, 512);
    start(1);
    for (uint8_t tick = 0; tick < 42; tick++) {
        (void)player_tick(&player, &l);
    }
    link_stop(&l);
    TEST_ASSERT_LESS_OR_EQUAL_UINT16(20, run_until(PLAYER_EV_LINK, &seen));
    TEST_ASSERT_EQUAL(LINK_EXIT, player.link_taken);
    TEST_ASSERT_EQUAL_UINT8(3, player.next_page);
    (void)run_to_end();
    TEST_ASSERT_EQUAL_UINT8(3, player.page);
}

static void test_player_code_that_comes_during_the_step_before_the_last_counts(void)
{
    uint8_t seen;
    sparse_step(1, 10, 0, 600);
    sparse_step(1, 10, 0, 500);
    sparse_pages[1].next = 1;
    sparse_pages[1].link1 = 2;
    sparse_pages[1].code1 = 4;
    sparse_step(2, 10, 0, 512);
    start(1);
    for (uint8_t tick = 0; tick < 8; tick++) {
        (void)player_tick(&player, &l);
    }
    link_code(&l, 4); /* the link is decided in the last tick but one of the step before */
    (void)run_until(PLAYER_EV_LINK, &seen);
    TEST_ASSERT_EQUAL(LINK_LINKED1, player.link_taken);
    TEST_ASSERT_EQUAL_UINT8(2, player.next_page);
}

static void test_player_passes_pages_with_play_count_0(void)
{
    uint8_t seen;
    sparse_step(1, 10, 0, 600);
    sparse_pages[1].next = 2;
    sparse_step(2, 10, 0, 700);
    sparse_pages[2].count = 0;
    sparse_pages[2].next = 3;
    sparse_step(3, 10, 0, 800);
    start(1);
    (void)run_until(PLAYER_EV_PAGE, &seen);
    TEST_ASSERT_EQUAL_UINT16(10, run_until(PLAYER_EV_PAGE, &seen));
    TEST_ASSERT_EQUAL_UINT8(3, player.page);
    setUp();
    sparse_pages[2].count = 0;
    sparse_pages[2].next = 3;
    sparse_step(3, 10, 0, 800);
    start(2);
    TEST_ASSERT_EQUAL_UINT8(3, player.page);
}

static void bad_next_page_ends_the_play(player_law_t law, bool damaged)
{
    uint8_t seen;
    sparse_step(1, 30, 0, 600);
    sparse_pages[1].next = 2;
    sparse_pages[2].damaged = damaged;
    start_law(1, law);
    (void)run_until(PLAYER_EV_ENDED, &seen);
    TEST_ASSERT_EQUAL_UINT8(2, player.fault_page);
    TEST_ASSERT_EQUAL(damaged ? PAGE_ERR_CHECKSUM : PAGE_EMPTY, player.fault);
    TEST_ASSERT_UINT16_WITHIN(2, 600, player.goal_pos[0]);
}

static void test_player_ends_standing_before_a_page_that_cannot_be_played(void)
{
    bad_next_page_ends_the_play(PLAYER_LAW_EXACT, true);
    setUp();
    bad_next_page_ends_the_play(PLAYER_LAW_EXACT, false);
    setUp();
    bad_next_page_ends_the_play(PLAYER_LAW_CLASSIC, true);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_player_exact_time_base_takes_time_ticks_and_ends_with_the_last_output);
    RUN_TEST(test_player_exact_speed_base_takes_the_time_of_the_longest_way);
    RUN_TEST(test_player_exact_carries_fractions_of_ticks);
    RUN_TEST(test_player_exact_plays_steps_of_one_and_two_ticks);
    RUN_TEST(test_player_pause_scales_with_the_schedule);
    RUN_TEST(test_player_exact_runs_through_a_way_point_on_its_way);
    RUN_TEST(test_player_exact_stands_at_a_turning_point_a_pause_and_the_end);
    RUN_TEST(test_player_exact_joins_repetitions_and_pages_like_steps);
    RUN_TEST(test_player_exact_mirrors_and_never_overshoots_whatever_the_page);
    RUN_TEST(test_player_classic_speed_wraps_before_it_is_limited);
    RUN_TEST(test_player_unused_joint_keeps_its_target_and_starts_from_there);
    RUN_TEST(test_player_absent_joint_is_never_touched_nor_timed);
    RUN_TEST(test_player_dropped_joint_keeps_its_goal);
    RUN_TEST(test_player_first_pose_tells_the_joints_of_step_1);
    RUN_TEST(test_player_refuses_what_cannot_be_played);
    RUN_TEST(test_player_plays_a_page_play_count_times_before_its_link);
    RUN_TEST(test_player_stop_ends_the_repetitions_through_the_exit_page);
    RUN_TEST(test_player_code_that_comes_during_the_step_before_the_last_counts);
    RUN_TEST(test_player_passes_pages_with_play_count_0);
    RUN_TEST(test_player_ends_standing_before_a_page_that_cannot_be_played);
    return UNITY_END();
}
