/* SPDX-License-Identifier: MIT
 * A move between two poses, such as the approach: speed limit, ramps, equal time, exact end, break. LAWS.md section 2,
 * rule 6. */
#include "player.h"

#include <string.h>
#include "unity.h"

#define ALL_JOINTS 0x7FFFFFFFul
#define MAX_TICKS 40100u

static player_t player;
static player_joint_t joints[PAGE_JOINTS];
#define NEAR_POS 3

static uint16_t from[PAGE_JOINTS], goal[PAGE_JOINTS];
static uint16_t *const to = player.next_pos;

void setUp(void)
{
    memset(joints, 0xAA, sizeof joints);
    player_init(&player, NULL, joints);
    for (uint8_t i = 0; i < PAGE_JOINTS; i++) {
        from[i] = to[i] = goal[i] = 512;
    }
}

static uint16_t start(uint16_t limit_deg_s)
{
    return player_move(&player, from, ALL_JOINTS, limit_deg_s, NEAR_POS);
}

/* Runs one tick. Returns false with the last one. */
static bool tick(void)
{
    const uint8_t events = player_tick(&player, NULL);
    player_goals(&player, player.joints, goal);
    return (events & PLAYER_EV_ENDED) == 0 && player_is_moving(&player);
}

/* Runs to the end. Returns the ticks, and joint 1's largest step and largest change of step. */
static uint16_t run(int16_t *largest_step, int16_t *largest_change)
{
    uint16_t ticks = 0;
    int16_t last = (int16_t)from[1], last_step = 0;
    bool under_way = true;
    *largest_step = 0;
    *largest_change = 0;
    while (under_way && ticks < MAX_TICKS) {
        under_way = tick();
        ticks++;
        const int16_t step = (int16_t)((int16_t)goal[1] - last);
        const int16_t size = (int16_t)(step < 0 ? -step : step);
        const int16_t change = (int16_t)(step > last_step ? step - last_step : last_step - step);
        *largest_step = size > *largest_step ? size : *largest_step;
        *largest_change = change > *largest_change ? change : *largest_change;
        last = (int16_t)goal[1];
        last_step = step;
    }
    return ticks;
}

/* 60 degrees/s = 1.6 units a tick: 512 units take 320 ticks at the limit, plus one ramp. */
static void test_player_move_takes_the_time_of_the_longest_way(void)
{
    int16_t step, change;
    to[1] = 1023;
    from[1] = 511;
    TEST_ASSERT_EQUAL_UINT16(320 + 32, start(60));
    TEST_ASSERT_EQUAL_UINT16(320 + 32, run(&step, &change));
    TEST_ASSERT_EQUAL_UINT16(1023, goal[1]);
    TEST_ASSERT_EQUAL_INT16(2, step); /* 1.6, rounded to whole units */
    TEST_ASSERT_LESS_OR_EQUAL_INT16(1, change);
}

static void test_player_move_of_all_joints_ends_together_and_exactly(void)
{
    int16_t step, change;
    for (uint8_t i = 0; i < PAGE_JOINTS; i++) {
        to[i] = (uint16_t)(33 * i);
    }
    TEST_ASSERT_GREATER_THAN_UINT16(0, start(120));
    (void)run(&step, &change);
    TEST_ASSERT_EQUAL_UINT16_ARRAY(to, goal, PAGE_JOINTS);
    TEST_ASSERT_FALSE(tick());
    TEST_ASSERT_EQUAL_UINT16_ARRAY(to, goal, PAGE_JOINTS);
}

static void test_player_move_is_slow_at_both_ends(void)
{
    to[1] = 912;
    (void)start(60);
    for (uint8_t i = 0; i < 8; i++) {
        TEST_ASSERT_TRUE(tick());
    }
    TEST_ASSERT_LESS_OR_EQUAL_UINT16(512 + 2, goal[1]); /* 1.6 / 32 * 36 = 1.8 units after 8 ticks */
    while (player.tick < player.now.ticks - 8) {
        TEST_ASSERT_TRUE(tick());
    }
    TEST_ASSERT_GREATER_OR_EQUAL_UINT16(912 - 2, goal[1]);
}

static void test_player_move_mirrored_motion_is_mirrored(void)
{
    to[1] = 777;
    to[2] = 1024 - 777;
    (void)start(90);
    bool under_way = true;
    while (under_way) {
        under_way = tick();
        TEST_ASSERT_UINT16_WITHIN(1, 1024 - goal[1], goal[2]);
    }
}

static void test_player_move_needs_no_time_when_it_is_near(void)
{
    to[3] = 512 + NEAR_POS;
    TEST_ASSERT_EQUAL_UINT16(0, start(60));
    to[3]++;
    TEST_ASSERT_GREATER_THAN_UINT16(0, start(60));
    to[3] = 0;
    TEST_ASSERT_EQUAL_UINT16(0, player_move(&player, from, ~((uint32_t)1 << 3) & ALL_JOINTS, 60, NEAR_POS));
}

static void test_player_move_leaves_other_joints_alone(void)
{
    int16_t step, change;
    to[1] = to[2] = 700;
    goal[2] = 4711;
    (void)player_move(&player, from, 2, 60, NEAR_POS);
    (void)run(&step, &change);
    TEST_ASSERT_EQUAL_UINT16(700, goal[1]);
    TEST_ASSERT_EQUAL_UINT16(4711, goal[2]);
}

static void test_player_move_at_the_slowest_and_the_fastest(void)
{
    int16_t step, change;
    from[1] = 0;
    to[1] = 1023;
    TEST_ASSERT_EQUAL_UINT16(38363 + 32, start(1)); /* 1023 * 75 / 2 = 38362.5 */
    TEST_ASSERT_EQUAL_UINT16(38363 + 32, run(&step, &change));
    TEST_ASSERT_EQUAL_UINT16(1023, goal[1]);
    TEST_ASSERT_EQUAL_INT16(1, step);
    (void)start(360); /* 9.6 units a tick */
    (void)run(&step, &change);
    TEST_ASSERT_EQUAL_UINT16(1023, goal[1]);
    TEST_ASSERT_LESS_OR_EQUAL_INT16(10, step);
}

static void test_player_move_break_slows_down_without_turning_back(void)
{
    for (uint16_t at = 1; at < 100; at = (uint16_t)(at + 7)) {
        setUp();
        to[1] = 1000;
        (void)start(180);
        for (uint16_t i = 0; i < at; i++) {
            (void)tick();
        }
        player_break(&player);
        uint16_t last = goal[1], ticks = 0, last_step = 100;
        bool under_way = true;
        while (under_way) {
            under_way = tick();
            TEST_ASSERT_GREATER_OR_EQUAL_UINT16(last, goal[1]);
            TEST_ASSERT_LESS_OR_EQUAL_UINT16(last_step + 1u, goal[1] - last);
            last_step = (uint16_t)(goal[1] - last);
            last = goal[1];
            ticks++;
        }
        TEST_ASSERT_LESS_OR_EQUAL_UINT16(32, ticks);
        TEST_ASSERT_LESS_THAN_UINT16(1000, goal[1]);
    }
}

static void test_player_move_break_near_the_end_goes_on_to_it(void)
{
    to[1] = 700;
    (void)start(60);
    while (player.tick + 10 < player.now.ticks) {
        (void)tick();
    }
    player_break(&player);
    while (tick()) {
    }
    TEST_ASSERT_EQUAL_UINT16(700, goal[1]);
}

/* A pause at any tick, even in a ramp or in the shortest move, makes no joint pass its target or turn back. After the
 * resume the joint arrives exactly and within the limit: 180 degrees/s = 48 units in ten ticks. */
static void test_player_move_pause_anywhere_keeps_limit_and_target(void)
{
    static const uint16_t targets[] = {516, 530, 560, 819, 1000};
    for (uint8_t k = 0; k < sizeof targets / sizeof targets[0]; k++) {
        uint16_t total = 2;
        for (uint16_t at = 1; at < total; at = (uint16_t)(at + TEST_STRIDE)) {
            setUp();
            to[1] = targets[k];
            total = start(180);
            uint16_t last = goal[1], ten_ago[10] = {0}, ticks = 0;
            bool under_way = true;
            while (under_way && ticks < 1000) {
                if (ticks == at) {
                    player_pause(&player);
                }
                if (ticks == at + 40u) {
                    TEST_ASSERT_TRUE(player_is_paused(&player));
                    player_resume(&player);
                }
                under_way = tick();
                ticks++;
                TEST_ASSERT_GREATER_OR_EQUAL_UINT16(last, goal[1]);
                TEST_ASSERT_LESS_OR_EQUAL_UINT16(targets[k], goal[1]);
                if (ticks > 10) {
                    TEST_ASSERT_LESS_OR_EQUAL_UINT16(49, goal[1] - ten_ago[ticks % 10]);
                }
                last = ten_ago[ticks % 10] = goal[1];
            }
            TEST_ASSERT_EQUAL_UINT16(targets[k], goal[1]);
        }
    }
}

/* A joint that its trim puts outside 0..1023 begins where it is and comes back within the limit: 60 degrees/s are 1.6 units
 * a tick. A break at any tick slows it down on the way, outside the range as well. */
static void test_player_move_from_outside_the_range_begins_there(void)
{
    static const int16_t starts[] = {-300, -40, -1, 1024, 1063, 1323}, targets[] = {0, 512, 1023};
    for (uint8_t k = 0; k < 6; k++) {
        for (uint8_t t = 0; t < 3; t++) {
            uint16_t total = 2;
            for (uint16_t at = 1; at <= total; at = (uint16_t)(at + 1 + at / 3)) {
                setUp();
                from[1] = (uint16_t)starts[k];
                to[1] = (uint16_t)targets[t];
                total = start(60);
                int last = starts[k], way = 0;
                bool under_way = total != 0;
                for (uint16_t ticks = 1; under_way; ticks++) {
                    under_way = tick();
                    way = (int16_t)goal[1] - last;
                    TEST_ASSERT_TRUE(starts[k] < targets[t] ? way >= 0 && way <= 2 : way <= 0 && way >= -2);
                    last = (int16_t)goal[1];
                    if (ticks == at && at < total) {
                        player_break(&player);
                    }
                }
                TEST_ASSERT_TRUE(at < total || total == 0 || last == targets[t]);
            }
        }
    }
}
