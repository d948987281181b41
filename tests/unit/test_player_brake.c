/* SPDX-License-Identifier: MIT
 * test_player_brake.c - break, pause and resume at every tick of a play, under both laws. */
#include "player.h"
#include "sparse_pages.h"
#include "unity.h"

#define ALL 0x7FFFFFFFul
#define ACCEL 20
#define PLAY_TICKS 150

static player_t player;
static player_joint_t joints[PAGE_JOINTS];
static link_t l;
static uint16_t pose[PAGE_JOINTS];

void setUp(void)
{
    sparse_clear();
    sparse_pages[1].accel = ACCEL;
    sparse_step(1, 60, 0, 700);
    sparse_step(1, 12, 0, 760);
    sparse_step(1, 30, 6, 400);
    sparse_step(1, 40, 0, 512);
    for (uint8_t step = 0; step < 4; step++) {
        sparse_pages[1].step[step].pos[1] = (uint16_t)(1024 - sparse_pages[1].step[step].pos[0]);
    }
    for (uint8_t i = 0; i < PAGE_JOINTS; i++) {
        pose[i] = 512;
    }
    player_init(&player, &sparse_source, joints);
    link_init(&l, LINK_LATCH);
}

static void play_to(player_law_t law, uint8_t tick)
{
    setUp();
    TEST_ASSERT_EQUAL(PLAYER_OK, player_start(&player, &l, 1, law, pose, ALL));
    while (tick-- != 0) {
        (void)player_tick(&player, &l);
    }
}

static int speed_of(uint16_t before, uint16_t after)
{
    return (int16_t)(uint16_t)(after - before);
}

static int size_of(int value)
{
    return value < 0 ? -value : value;
}

/* Checks the braking: each joint keeps its direction, its speed decreases (but for rounding), and the last tick reports
 * `end_events`. Returns the ticks. */
static uint8_t expect_braking(const uint16_t *before, uint8_t end_events)
{
    uint16_t last[2] = {before[0], before[1]};
    int speed[2] = {1000, 1000}, sign[2] = {0, 0};
    for (uint8_t ticks = 1; ticks <= 40; ticks++) {
        uint8_t events = player_tick(&player, &l);
        for (uint8_t i = 0; i < 2; i++) {
            int now = speed_of(last[i], player_goal(&player, (uint8_t)i));
            TEST_ASSERT_LESS_OR_EQUAL_INT(speed[i] + 1, size_of(now));
            if (now != 0) {
                TEST_ASSERT_TRUE(sign[i] == 0 || sign[i] == (now > 0 ? 1 : -1));
                sign[i] = now > 0 ? 1 : -1;
                speed[i] = size_of(now);
            }
            last[i] = player_goal(&player, (uint8_t)i);
        }
        if ((events & PLAYER_EV_STOPPED) != 0) {
            TEST_ASSERT_EQUAL_HEX8(end_events, events & (PLAYER_EV_STOPPED | PLAYER_EV_ENDED));
            return ticks;
        }
        TEST_ASSERT_EQUAL_HEX8(PLAYER_EV_OUTPUT, events);
    }
    TEST_FAIL_MESSAGE("does not stand");
    return 0;
}

static void break_at_every_tick(player_law_t law)
{
    for (uint8_t tick = 1; tick < PLAY_TICKS - 10; tick = (uint8_t)(tick + TEST_STRIDE)) {
        play_to(law, tick);
        if (!player_is_moving(&player)) {
            break;
        }
        uint16_t before[2] = {player_goal(&player, 0), player_goal(&player, 1)};
        player_break(&player);
        TEST_ASSERT_TRUE(player_is_moving(&player));
        TEST_ASSERT_FALSE(player_is_paused(&player));
        TEST_ASSERT_LESS_OR_EQUAL_UINT8(ACCEL, expect_braking(before, PLAYER_EV_STOPPED | PLAYER_EV_ENDED));
        TEST_ASSERT_FALSE(player_is_moving(&player));
        TEST_ASSERT_EQUAL_HEX8(0, player_tick(&player, &l));
    }
}

static void test_player_breaks_at_any_tick_of_exact_without_turning_back(void)
{
    break_at_every_tick(PLAYER_LAW_EXACT);
}

static void test_player_breaks_at_any_tick_of_classic_without_turning_back(void)
{
    break_at_every_tick(PLAYER_LAW_CLASSIC);
}

/* Pauses, waits, resumes. Returns the ticks without the wait. No jump: the page's fastest tick is 26 units under the
 * exact law, and 45 under the classic one without any pause. */
static uint16_t pause_and_go_on(player_law_t law, uint8_t tick)
{
    play_to(law, tick);
    uint16_t before[2] = {player_goal(&player, 0), player_goal(&player, 1)}, made = tick;
    player_pause(&player);
    TEST_ASSERT_TRUE(player_is_paused(&player));
    made = (uint16_t)(made + expect_braking(before, PLAYER_EV_STOPPED));
    for (uint8_t i = 0; i < 5; i++) {
        TEST_ASSERT_EQUAL_HEX8(0, player_tick(&player, &l));
    }
    player_resume(&player);
    TEST_ASSERT_FALSE(player_is_paused(&player));
    uint8_t events = 0;
    while ((events & PLAYER_EV_ENDED) == 0 && made < 1000) {
        uint16_t last = player_goal(&player, 0);
        events = player_tick(&player, &l);
        TEST_ASSERT_LESS_OR_EQUAL_INT(law == PLAYER_LAW_EXACT ? 30 : 45, size_of(speed_of(last, player_goal(&player, 0))));
        made++;
    }
    return made;
}

static void test_player_exact_goes_on_after_a_pause_in_the_time_left(void)
{
    for (uint8_t tick = 1; tick < 148; tick = (uint8_t)(tick + TEST_STRIDE)) {
        uint16_t made = pause_and_go_on(PLAYER_LAW_EXACT, tick);
        TEST_ASSERT_EQUAL_UINT16(512, player_goal(&player, 0));
        /* 148 ticks, one ramp of braking, and at most one more ramp where a step had little time left */
        TEST_ASSERT_UINT16_WITHIN(ACCEL, 148 + ACCEL, made);
    }
    /* In the middle of the first step: 60 ticks of time in all, plus the braking time. */
    TEST_ASSERT_EQUAL_UINT16(148 + ACCEL, pause_and_go_on(PLAYER_LAW_EXACT, 25));
}

static void test_player_classic_goes_on_after_a_pause_to_its_end(void)
{
    for (uint8_t tick = 1; tick < 140; tick = (uint8_t)(tick + TEST_STRIDE)) {
        (void)pause_and_go_on(PLAYER_LAW_CLASSIC, tick);
        TEST_ASSERT_FALSE(player_is_moving(&player));
        TEST_ASSERT_UINT16_WITHIN(4, 512, player_goal(&player, 0));
    }
}

/* Without ramps the law has sections that are empty. */
static void test_player_classic_without_ramps_ends_after_a_pause_at_any_tick(void)
{
    for (uint8_t tick = 1; tick < 63; tick++) {   /* the step has 60, RISE and FALL are empty and take one each */
        setUp();
        sparse_pages[1].accel = 0;
        sparse_pages[1].steps = 1;
        TEST_ASSERT_EQUAL(PLAYER_OK, player_start(&player, &l, 1, PLAYER_LAW_CLASSIC, pose, ALL));
        for (uint8_t i = 0; i < tick; i++) {
            (void)player_tick(&player, &l);
        }
        TEST_ASSERT_TRUE(player_is_moving(&player));
        player_pause(&player);
        while ((player_tick(&player, &l) & PLAYER_EV_STOPPED) == 0) {
        }
        player_resume(&player);
        for (uint8_t i = 0; i < 70; i++) {
            (void)player_tick(&player, &l);
        }
        TEST_ASSERT_FALSE(player_is_moving(&player));
    }
}

/* A resume during braking continues the play as soon as it stands, in the same number of ticks as a resume right after
 * that, without an event. A resume before the next tick cancels the pause. */
static void resume_while_slowing_down(player_law_t law)
{
    const uint16_t paused_ticks = pause_and_go_on(law, 25), plain_ticks = (uint16_t)(paused_ticks - ACCEL);
    for (uint8_t after = 0; after < ACCEL; after++) {
        uint16_t ticks = 25;
        uint8_t events = 0;
        play_to(law, 25);
        player_pause(&player);
        for (uint8_t i = 0; i < after; i++, ticks++) {
            (void)player_tick(&player, &l);
        }
        player_resume(&player);
        TEST_ASSERT_FALSE(player_is_paused(&player));
        while ((events & PLAYER_EV_ENDED) == 0 && ticks < 1000) {
            events = player_tick(&player, &l);
            TEST_ASSERT_EQUAL_HEX8(0, events & PLAYER_EV_STOPPED);
            ticks++;
        }
        TEST_ASSERT_EQUAL_UINT16(after == 0 ? plain_ticks : paused_ticks, ticks);
        TEST_ASSERT_UINT16_WITHIN(law == PLAYER_LAW_EXACT ? 0 : 4, 512, player_goal(&player, 0));
    }
}

static void test_player_resume_while_slowing_down_is_not_lost(void)
{
    resume_while_slowing_down(PLAYER_LAW_EXACT);
    resume_while_slowing_down(PLAYER_LAW_CLASSIC);
}

/* Pause, resume, pause before the play stands: the last one takes effect. The same holds for a break. */
static void test_player_pause_takes_back_a_resume(void)
{
    uint8_t events = 0;
    play_to(PLAYER_LAW_EXACT, 30);
    player_pause(&player);
    player_resume(&player);
    player_pause(&player);
    TEST_ASSERT_TRUE(player_is_paused(&player));
    for (uint8_t i = 0; i < ACCEL; i++) {
        events |= player_tick(&player, &l);
    }
    TEST_ASSERT_TRUE((events & PLAYER_EV_STOPPED) != 0 && player_is_paused(&player));
    play_to(PLAYER_LAW_EXACT, 30);
    player_pause(&player);
    player_resume(&player);
    player_break(&player);
    for (uint8_t i = 0; i < ACCEL; i++) {
        events = player_tick(&player, &l);
    }
    TEST_ASSERT_TRUE((events & PLAYER_EV_ENDED) != 0 && !player_is_moving(&player));
}

static void test_player_break_while_paused_ends_the_play_where_it_stands(void)
{
    uint8_t events = 0;
    play_to(PLAYER_LAW_EXACT, 30);
    player_pause(&player);
    while ((events & PLAYER_EV_STOPPED) == 0) {
        events = player_tick(&player, &l);
    }
    uint16_t at = player_goal(&player, 0);
    player_break(&player);
    TEST_ASSERT_EQUAL_HEX8(PLAYER_EV_STOPPED | PLAYER_EV_ENDED, player_tick(&player, &l));
    TEST_ASSERT_EQUAL_UINT16(at, player_goal(&player, 0));
    player_resume(&player);
    TEST_ASSERT_EQUAL_HEX8(0, player_tick(&player, &l));
}

static void test_player_break_near_the_end_of_the_range_stays_in_range(void)
{
    setUp();
    sparse_pages[1].accel = 8;
    sparse_pages[1].step[0].time = 10;
    sparse_pages[1].step[0].pos[0] = 1023;
    sparse_pages[1].step[0].pos[1] = 0;
    TEST_ASSERT_EQUAL(PLAYER_OK, player_start(&player, &l, 1, PLAYER_LAW_EXACT, pose, ALL));
    for (uint8_t tick = 0; tick < 8; tick++) {
        (void)player_tick(&player, &l);
    }
    player_break(&player);
    while (player_is_moving(&player)) {
        (void)player_tick(&player, &l);
        TEST_ASSERT_LESS_OR_EQUAL_UINT16(PAGE_POS_MAX, player_goal(&player, 0));
        TEST_ASSERT_LESS_OR_EQUAL_UINT16(PAGE_POS_MAX, player_goal(&player, 1));
    }
}

/* In CRUISE of the first step: v = (188 - 3.13 * 10) / 40 = 3.92 units a tick (exit at 188 / 60). It stops in 20 ticks
 * over 3.92 * 20 / 2 = 39 units. */
static void test_player_break_stops_on_half_the_way_that_its_speed_would_take(void)
{
    play_to(PLAYER_LAW_EXACT, 30);
    uint16_t before[2] = {player_goal(&player, 0), player_goal(&player, 1)};
    player_break(&player);
    (void)expect_braking(before, PLAYER_EV_STOPPED | PLAYER_EV_ENDED);
    TEST_ASSERT_UINT16_WITHIN(1, before[0] + 39, player_goal(&player, 0));
}

/* With such short steps the look-ahead to the next step, the end of the step and the pause coincide in every order. */
static void test_player_exact_goes_on_from_any_tick_of_short_steps(void)
{
    static const uint8_t times[] = {4, 3, 2, 1, 1, 5};
    for (uint8_t at = 0; at <= 16; at++) {
        uint8_t events = 0, ticks = 0, steps = 0;
        setUp();
        sparse_pages[2].accel = 4;
        for (uint8_t step = 0; step < sizeof times; step++) {
            sparse_step(2, times[step], step == 1 ? 3 : 0, (uint16_t)(step == 4 ? 480 : 520 + 8 * step));
        }
        TEST_ASSERT_EQUAL(PLAYER_OK, player_start(&player, &l, 2, PLAYER_LAW_EXACT, pose, ALL));
        for (uint8_t tick = 0; tick < at; tick++) {
            steps = (uint8_t)(steps + ((player_tick(&player, &l) & PLAYER_EV_STEP) != 0));
        }
        player_pause(&player);
        while ((events & PLAYER_EV_STOPPED) == 0) {
            events = player_tick(&player, &l);
            TEST_ASSERT_EQUAL_HEX8(0, events & PLAYER_EV_STEP);
        }
        player_resume(&player);
        while (player_is_moving(&player)) {
            steps = (uint8_t)(steps + ((player_tick(&player, &l) & PLAYER_EV_STEP) != 0));
            TEST_ASSERT_LESS_THAN_UINT8(60, ++ticks);
        }
        TEST_ASSERT_EQUAL_UINT8(sizeof times, steps); /* each step is reported exactly once */
        TEST_ASSERT_EQUAL_UINT16(520 + 8 * 5, player_goal(&player, 0));
        TEST_ASSERT_EQUAL_UINT8(PAGE_OK, player.fault);
    }
}

/* Joints that their trim puts outside 0..1023 begin where they are, under both laws, and slow down there as well. 623 and
 * 624 units in 60 ticks, two thirds of them ramps: 15.6 units a tick at most. */
static void play_from_outside(player_law_t law)
{
    for (uint8_t at = 1; at < PLAY_TICKS; at = (uint8_t)(at + TEST_STRIDE)) {
        setUp();
        pose[0] = 1323;
        pose[1] = (uint16_t)-300;
        sparse_pages[1].steps = 1;
        TEST_ASSERT_EQUAL(PLAYER_OK, player_start(&player, &l, 1, law, pose, ALL));
        uint16_t last[2] = {pose[0], pose[1]};
        for (uint8_t tick = 1; player_is_moving(&player); tick++) {
            (void)player_tick(&player, &l);
            for (uint8_t i = 0; i < 2; i++) {
                const int way = speed_of(last[i], player_goal(&player, i));
                TEST_ASSERT_LESS_OR_EQUAL_INT(16, size_of(way));
                /* The classic law has an odd last tick. */
                TEST_ASSERT_TRUE(way == 0 || (way < 0) == (i == 0) || tick > 60);
                last[i] = player_goal(&player, i);
            }
            if (tick == at) {
                player_break(&player);
            }
        }
        TEST_ASSERT_TRUE(at < 70 || (size_of(last[0] - 700) <= 4 && size_of(last[1] - 324) <= 4));
    }
}

static void test_player_from_outside_the_range_begins_there(void)
{
    play_from_outside(PLAYER_LAW_EXACT);
    play_from_outside(PLAYER_LAW_CLASSIC);
}
