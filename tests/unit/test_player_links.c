/* SPDX-License-Identifier: MIT
 * Joints, pages and links of a play; both laws. */
#include "player_stage.h"
#include "unity.h"

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
        TEST_ASSERT_EQUAL_UINT16(512, player_goal(&player, 3));
        TEST_ASSERT_EQUAL_UINT16(512, player_goal(&player, 2));
        TEST_ASSERT_EQUAL_HEX32(0x3, player.joints);
    }
    for (uint8_t tick = 0; tick < 30; tick++) {
        (void)player_tick(&player, &l);
    }
    TEST_ASSERT_EQUAL_HEX32(0xF, player.joints);
    TEST_ASSERT_UINT16_WITHIN(law == PLAYER_LAW_CLASSIC ? 2 : 0, 700, player_goal(&player, 3));
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
    player_goals(&player, UINT32_MAX, pose);
    TEST_ASSERT_EQUAL_UINT16(900, pose[3]);
    TEST_ASSERT_EQUAL_HEX32(0x7, player.joints);
}

/* The joint may be present at the next play. */
static void test_player_does_not_move_an_absent_joint(void)
{
    sparse_step(1, 16, 0, 700);
    pose[3] = 900;
    TEST_ASSERT_EQUAL(PLAYER_OK, player_start(&player, &l, 1, PLAYER_LAW_EXACT, pose, 0x7));
    TEST_ASSERT_EQUAL_UINT16(16, run_to_end());
    player_goals(&player, UINT32_MAX, pose);
    TEST_ASSERT_EQUAL_UINT16(700, pose[2]);
    TEST_ASSERT_EQUAL_UINT16(900, pose[3]);
    TEST_ASSERT_EQUAL_HEX32(0x7, player.joints);
    TEST_ASSERT_EQUAL(PLAYER_OK, player_start(&player, &l, 1, PLAYER_LAW_EXACT, pose, 0xF));
    TEST_ASSERT_EQUAL_UINT16(16, run_to_end());
    TEST_ASSERT_EQUAL_UINT16(700, player_goal(&player, 3));
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
    uint16_t goal_pos[PAGE_JOINTS];
    player_goals(&player, UINT32_MAX, goal_pos);
    const uint16_t at = goal_pos[1];
    TEST_ASSERT_GREATER_THAN_UINT16(520, at);
    player_drop_joints(&player, 1ul << 1);
    for (uint16_t tick = 0; player_is_moving(&player) && tick < TICKS_MAX; tick++) {
        (void)player_tick(&player, &l);
        player_goals(&player, UINT32_MAX, goal_pos);
        TEST_ASSERT_EQUAL_UINT16(at, goal_pos[1]);
    }
    TEST_ASSERT_EQUAL_HEX32(0xD, player.joints);
    TEST_ASSERT_UINT16_WITHIN(law == PLAYER_LAW_CLASSIC ? 3 : 0, 300, player_goal(&player, 0));
}

static void test_player_dropped_joint_keeps_its_goal(void)
{
    dropped_joint_stays(PLAYER_LAW_EXACT);
    setUp();
    dropped_joint_stays(PLAYER_LAW_CLASSIC);
}

/* Its speed would add up in every tick, and its position would run out of the 32 bits after some steps. */
static void test_player_dropped_joint_does_not_move_on(void)
{
    sparse_step(1, 30, 0, 700);
    start_law(1, PLAYER_LAW_EXACT);
    for (uint8_t tick = 0; tick < 12; tick++) {
        (void)player_tick(&player, &l);
    }
    player_drop_joints(&player, 1ul << 1);
    const int32_t at_q16_16 = player.joint[1].exact.pos_q16_16;
    (void)player_tick(&player, &l);
    TEST_ASSERT_EQUAL_INT32(at_q16_16, player.joint[1].exact.pos_q16_16);
}

static void test_player_first_pose_tells_the_joints_of_step_1(void)
{
    sparse_step(1, 30, 0, 700);
    sparse_pages[1].step[0].pos[2] = 0x4000;
    TEST_ASSERT_EQUAL_HEX32(0xB, player_first_pose(&sparse_source, NULL, 1, pose));
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
            TEST_ASSERT_EQUAL_UINT8(1, player.now.page);
        }
    } while ((seen & PLAYER_EV_LINK) == 0);
    TEST_ASSERT_EQUAL_UINT8(3, repetition);
    TEST_ASSERT_EQUAL_UINT8(2, player.link_page);
    TEST_ASSERT_EQUAL(LINK_NEXT, player.link_taken);
    (void)run_until(PLAYER_EV_PAGE, &seen);
    TEST_ASSERT_EQUAL_UINT8(2, player.now.page);
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
    TEST_ASSERT_EQUAL_UINT8(3, player.link_page);
    (void)run_to_end();
    TEST_ASSERT_EQUAL_UINT8(3, player.now.page);
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
    link_code(&l, 4); /* the link is decided in the last tick but one of the step before the last */
    (void)run_until(PLAYER_EV_LINK, &seen);
    TEST_ASSERT_EQUAL(LINK_LINKED1, player.link_taken);
    TEST_ASSERT_EQUAL_UINT8(2, player.link_page);
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
    TEST_ASSERT_EQUAL_UINT8(3, player.now.page);
    setUp();
    sparse_step(2, 10, 0, 700);
    sparse_pages[2].count = 0;
    sparse_pages[2].next = 3;
    sparse_step(3, 10, 0, 800);
    start(2);
    TEST_ASSERT_EQUAL_UINT8(3, player.next.page);
    setUp();
    sparse_step(4, 10, 0, 700);
    sparse_pages[4].count = 0;
    TEST_ASSERT_EQUAL(PLAYER_ERR_EMPTY, player_start(&player, NULL, 4, PLAYER_LAW_EXACT, pose, ALL));
    TEST_ASSERT_EQUAL_UINT8(4, player.fault_page);
    TEST_ASSERT_EQUAL_UINT8(PAGE_EMPTY, player.fault);
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
    TEST_ASSERT_UINT16_WITHIN(2, 600, player_goal(&player, 0));
}

static void test_player_ends_standing_before_a_page_that_cannot_be_played(void)
{
    bad_next_page_ends_the_play(PLAYER_LAW_EXACT, true);
    setUp();
    bad_next_page_ends_the_play(PLAYER_LAW_EXACT, false);
    setUp();
    bad_next_page_ends_the_play(PLAYER_LAW_CLASSIC, true);
}

/* LAWS.md: "a link above 127 counts as 0". 127 is a valid number; these tests have no such page, so it counts as
 * damaged. */
static void link_to(player_law_t law, uint8_t named, uint8_t link_page, uint8_t fault)
{
    sparse_clear();
    setUp();
    sparse_step(1, 10, 0, 600);
    sparse_pages[1].next = named;
    start_law(1, law);
    (void)run_to_end();
    TEST_ASSERT_EQUAL_UINT8(link_page, player.link_page);
    TEST_ASSERT_EQUAL_UINT8(fault, player.fault);
    TEST_ASSERT_EQUAL_UINT8(fault == PAGE_OK ? 0 : named, player.fault_page);
}

static void test_player_link_above_127_counts_as_none(void)
{
    for (uint8_t law = PLAYER_LAW_EXACT; law <= PLAYER_LAW_CLASSIC; law++) {
        link_to((player_law_t)law, 128, 0, PAGE_OK);
        link_to((player_law_t)law, 255, 0, PAGE_OK);
    }
    link_to(PLAYER_LAW_EXACT, 127, 127, PAGE_ERR_CHECKSUM);
}
