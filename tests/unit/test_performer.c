/* SPDX-License-Identifier: MIT
 * The performer with the real player, links and approach over fake servos: from start to end, torque. */
#include "performer_stage.h"
#include "unity.h"

/* ---- start ---- */

static void test_performer_start_refuses_what_cannot_be_played(void)
{
    TEST_ASSERT_EQUAL_UINT8(PERFORMER_ERR_RANGE, performer_start(&performer, 0, 0));
    TEST_ASSERT_EQUAL_UINT8(PERFORMER_ERR_RANGE, performer_start(&performer, 128, 0));
    TEST_ASSERT_EQUAL_UINT8(PERFORMER_ERR_EMPTY, performer_start(&performer, 4, 0));
    pages[5][100] ^= 1;
    TEST_ASSERT_EQUAL_UINT8(PERFORMER_ERR_PAGE, performer_start(&performer, 5, 0));
    TEST_ASSERT_EQUAL_UINT8(PAGE_ERR_CHECKSUM, performer.fault);
    TEST_ASSERT_TRUE(performer_is_idle(&performer));
    ticks(10);
    TEST_ASSERT_EQUAL_UINT16(0, fake_servo_link.frames);
}

static void test_performer_start_refuses_without_servos(void)
{
    fake_servo_link_reset(&servos, 0);
    TEST_ASSERT_EQUAL_UINT8(PERFORMER_ERR_NO_SERVOS, performer_start(&performer, 1, 0));
    fake_servo_link_reset(&servos, ALL_THREE);
    performer_off(&performer, ALL_THREE);
    TEST_ASSERT_EQUAL_UINT8(PERFORMER_ERR_RELEASED, performer_start(&performer, 1, 0));
}

static void test_performer_start_refuses_a_second_play(void)
{
    start(2, 0);
    TEST_ASSERT_EQUAL_UINT8(PERFORMER_ERR_BUSY, performer_start(&performer, 1, 0));
    reach(PERFORMER_PLAY);
    TEST_ASSERT_EQUAL_UINT8(PERFORMER_ERR_BUSY, performer_start(&performer, 1, 0));
    TEST_ASSERT_EQUAL_UINT8(2, performer.page);
}

/* Two polls per servo: torque, then pose. */
static void test_performer_asks_one_servo_at_a_time_and_moves_nobody_meanwhile(void)
{
    start(1, 0);
    performer_poll(&performer);
    TEST_ASSERT_EQUAL_HEX32(SERVO_LINK_BIT(1), servos.torque);
    for (uint8_t i = 0; i < 2; i++) {
        TEST_ASSERT_EQUAL_UINT8(PERFORMER_READY, performer.state);
        performer_poll(&performer);
    }
    TEST_ASSERT_EQUAL_HEX32(ALL_THREE, servos.torque);
    TEST_ASSERT_EQUAL_UINT16(0, fake_servo_link.frames);
    performer_poll(&performer);
    TEST_ASSERT_EQUAL_UINT8(PERFORMER_APPROACH, performer.state);
    TEST_ASSERT_EQUAL_UINT16(3, fake_servo_link.engagements);
}

/* 60 degrees/s are 60 / 300 * 1024 / 128 = 1.6 units a tick. 100 units take 62.5 ticks at that speed, plus ramps. */
static void test_performer_approach_keeps_to_the_speed_limit(void)
{
    start(1, 0);
    reach(PERFORMER_APPROACH);
    TEST_ASSERT_EQUAL_UINT8(1, expect_event(PERFORMER_EV_APPROACH).a);
    uint16_t last = 512, count = 0;
    while (performer.state == PERFORMER_APPROACH) {
        ticks(1);
        const uint16_t now = fake_servo_link.goal_pos[1];
        TEST_ASSERT_TRUE(now >= last && now <= last + 2);
        last = now;
        count++;
    }
    TEST_ASSERT_EQUAL_UINT16(612, last);
    TEST_ASSERT_GREATER_THAN_UINT16(62, count);
}

/* Joint 1 goes from where it stands, outside the range, to the target: 2 units a tick at most, from the first goal on. */
static void expect_slow_way(int last, int target)
{
    for (uint16_t count = 0; last != target; count++) {
        TEST_ASSERT_LESS_THAN_UINT16(2000, count);
        const uint16_t frames = fake_servo_link.frames;
        ticks(1);
        const int now = fake_servo_link.frames != frames ? (int16_t)fake_servo_link.goal_pos[1] : last;
        TEST_ASSERT_TRUE(target < last ? now <= last && now >= last - 2 : now >= last && now <= last + 2);
        last = now;
    }
}

static void test_performer_approach_begins_outside_the_range(void)
{
    static const int16_t poses[] = {1110, -130};
    for (uint8_t i = 0; i < 2; i++) {
        setUp();
        fake_servo_link.pose_pos[1] = (uint16_t)poses[i];
        start(1, 0);
        expect_slow_way(poses[i], 612);
        setUp();
        fake_servo_link.pose_pos[1] = (uint16_t)poses[i];
        const uint16_t to[PAGE_JOINTS] = {[1] = 512};
        TEST_ASSERT_EQUAL_UINT8(PERFORMER_OK, performer_move(&performer, to, SERVO_LINK_BIT(1), 60));
        expect_slow_way(poses[i], 512);
        setUp();
        fake_servo_link.pose_pos[1] = (uint16_t)poses[i];
        TEST_ASSERT_EQUAL(LAYERS_OK, performer_take_for_code(&performer, 1));
        TEST_ASSERT_EQUAL(LAYERS_OK, layers_aim(&layers, 1, 512, 60));
        expect_slow_way(poses[i], 512);
    }
}

/* Page 4 passes over to page 3, with code 2 to page 1. The code comes on the way to page 3's first pose. */
static void test_performer_begins_with_the_page_that_it_has_approached(void)
{
    make_page(4, 0, 3, 0);
    pages[4][PAGE_AT_PLAY_COUNT] = 0;
    pages[4][PAGE_AT_LINKED1_PAGE] = 1;
    pages[4][PAGE_AT_LINKED1_CODE] = 2;
    page_seal(pages[4]);
    start(4, 0);
    reach(PERFORMER_APPROACH);
    performer_code(&performer, 2);
    reach(PERFORMER_PLAY);
    TEST_ASSERT_EQUAL_UINT16(412, fake_servo_link.goal_pos[1]);
    reach(PERFORMER_IDLE);
    TEST_ASSERT_EQUAL_UINT8(3, expect_event(PERFORMER_EV_STEP).a);
    TEST_ASSERT_EQUAL_UINT16(412, fake_servo_link.goal_pos[1]);
}

static void test_performer_needs_no_approach_when_it_is_there(void)
{
    fake_servo_link.pose_pos[1] = 612;
    start(1, 0);
    reach(PERFORMER_PLAY);
    TEST_ASSERT_FALSE(has_event(PERFORMER_EV_APPROACH));
}

static void test_performer_without_approach_plays_from_the_present_pose(void)
{
    settings.approach_deg_s = 0;
    start(1, 0);
    reach(PERFORMER_PLAY);
    TEST_ASSERT_EQUAL_UINT16(0, fake_servo_link.frames);
    reach(PERFORMER_IDLE);
    TEST_ASSERT_EQUAL_UINT16(64, fake_servo_link.frames); /* one step of 64 ticks */
    TEST_ASSERT_EQUAL_UINT16(612, fake_servo_link.goal_pos[1]);
}

static void test_performer_drives_only_who_is_there_and_used(void)
{
    page_set_pos(pages[1], 0, 20, 700); /* absent */
    page_seal(pages[1]);
    start(1, 0);
    reach(PERFORMER_IDLE);
    TEST_ASSERT_EQUAL_HEX16(0xFFFF, fake_servo_link.goal_pos[20]);
    TEST_ASSERT_EQUAL_UINT16(612, fake_servo_link.goal_pos[1]);
    TEST_ASSERT_EQUAL_HEX16(0xFFFF, fake_servo_link.goal_pos[2]); /* unused */
    TEST_ASSERT_EQUAL_HEX32(SERVO_LINK_BIT(1), fake_servo_link.joints);
}

static void test_performer_leaves_alone_who_was_switched_off(void)
{
    page_set_pos(pages[1], 0, 2, 700);
    page_seal(pages[1]);
    performer_off(&performer, SERVO_LINK_BIT(2));
    start(1, 0);
    reach(PERFORMER_IDLE);
    TEST_ASSERT_EQUAL_HEX16(0xFFFF, fake_servo_link.goal_pos[2]);
    TEST_ASSERT_EQUAL_HEX32(0, servos.torque & SERVO_LINK_BIT(2));
    TEST_ASSERT_EQUAL_HEX32(SERVO_LINK_BIT(2), performer_on(&performer, SERVO_LINK_BIT(2)));
    start(1, 0);
    reach(PERFORMER_IDLE);
    TEST_ASSERT_EQUAL_UINT16(700, fake_servo_link.goal_pos[2]);
}

static void test_performer_sends_the_compliance_of_the_page(void)
{
    pages[1][PAGE_AT_COMPLIANCE + 1] = 0x37;
    page_seal(pages[1]);
    start(1, 0);
    reach(PERFORMER_IDLE);
    TEST_ASSERT_EQUAL_UINT16(1, fake_servo_link.slopes);
    TEST_ASSERT_EQUAL_HEX8(0x37, fake_servo_link.compliance[1]);
}

/* ---- events, ends ---- */

static void test_performer_tells_steps_links_and_the_end(void)
{
    make_page(1, 612, 3, 0);
    start(1, 0);
    reach(PERFORMER_IDLE);
    performer_event_t event = expect_event(PERFORMER_EV_STEP);
    TEST_ASSERT_EQUAL_UINT8(1, event.a);
    TEST_ASSERT_EQUAL_UINT8(1, event.b);
    TEST_ASSERT_EQUAL_UINT8(1, event.c);
    event = expect_event(PERFORMER_EV_LINK);
    TEST_ASSERT_EQUAL_UINT8(3, event.a);
    TEST_ASSERT_EQUAL_UINT8(LINK_NEXT, event.b);
    TEST_ASSERT_EQUAL_UINT8(3, expect_event(PERFORMER_EV_STEP).a);
    event = expect_event(PERFORMER_EV_ENDED);
    TEST_ASSERT_EQUAL_UINT8(3, event.a);
    TEST_ASSERT_EQUAL_UINT8(PERFORMER_END_DONE, event.c);
}

static void test_performer_counts_repetitions(void)
{
    pages[1][PAGE_AT_PLAY_COUNT] = 2;
    page_seal(pages[1]);
    start(1, 0);
    reach(PERFORMER_IDLE);
    TEST_ASSERT_EQUAL_UINT8(1, expect_event(PERFORMER_EV_STEP).c);
    TEST_ASSERT_EQUAL_UINT8(2, expect_event(PERFORMER_EV_STEP).c);
}

static void test_performer_names_the_damaged_page_a_link_leads_to(void)
{
    make_page(1, 612, 5, 0);
    pages[5][100] ^= 1;
    start(1, 0);
    reach(PERFORMER_IDLE);
    const performer_event_t event = expect_event(PERFORMER_EV_ENDED);
    TEST_ASSERT_EQUAL_UINT8(PERFORMER_END_PAGE, event.c);
    TEST_ASSERT_EQUAL_UINT8(5, event.a);
    TEST_ASSERT_EQUAL_UINT8(PAGE_ERR_CHECKSUM, event.b);
}

static void test_performer_full_queue_keeps_the_end(void)
{
    pages[1][PAGE_AT_PLAY_COUNT] = 60;
    pages[1][PAGE_AT_STEP0 + PAGE_STEP_AT_SPEED] = 4;
    page_seal(pages[1]);
    start(1, 0);
    reach(PERFORMER_IDLE);
    TEST_ASSERT_EQUAL_UINT8(PERFORMER_END_DONE, end_reason());
    performer_event_t event;
    TEST_ASSERT_TRUE(performer_next_event(&performer, &event));
    TEST_ASSERT_EQUAL_UINT8(PERFORMER_EV_LOST, event.kind);
    TEST_ASSERT_GREATER_THAN_UINT8(40, event.a);
    TEST_ASSERT_FALSE(performer_next_event(&performer, &event));
}

static void test_performer_queue_full_of_faults_keeps_the_end(void)
{
    start(2, 0);
    reach(PERFORMER_PLAY);
    for (uint8_t i = 0; i < 2u * PERFORMER_EVENTS; i++) {
        fake_servo_link_fault(&servos, 1, i & 1u ? SERVO_FAULT_BACK : SERVO_FAULT_SILENT, 0);
        performer_poll(&performer);
    }
    reach(PERFORMER_IDLE);
    TEST_ASSERT_EQUAL_UINT8(PERFORMER_END_SERVO, end_reason());
}

/* ---- torque, moves ---- */

static void test_performer_off_takes_a_joint_out_of_the_play(void)
{
    make_page(2, 912, 2, 0);
    page_set_pos(pages[2], 0, 2, 112);
    page_seal(pages[2]);
    start(2, 0);
    reach(PERFORMER_APPROACH);
    ticks(10);
    performer_off(&performer, SERVO_LINK_BIT(1));
    const uint16_t held = fake_servo_link.goal_pos[1];
    ticks(100);
    TEST_ASSERT_EQUAL_UINT16(held, fake_servo_link.goal_pos[1]);
    TEST_ASSERT_FALSE(performer_is_idle(&performer));
    performer_off(&performer, ALL_THREE);
    ticks(1);
    TEST_ASSERT_TRUE(performer_is_idle(&performer));
    TEST_ASSERT_EQUAL_HEX32(0, servos.torque);
}

static void test_performer_on_waits_for_the_end_of_a_play(void)
{
    start(2, 0);
    TEST_ASSERT_EQUAL_HEX32(0, performer_on(&performer, ALL_THREE));
}

static void test_performer_move_goes_there_and_touches_nobody_else(void)
{
    uint16_t to[PAGE_JOINTS] = {0};
    to[2] = 600;
    TEST_ASSERT_EQUAL_UINT8(PERFORMER_OK, performer_move(&performer, to, SERVO_LINK_BIT(2), 120));
    TEST_ASSERT_FALSE(performer_pause(&performer));
    reach(PERFORMER_IDLE);
    TEST_ASSERT_EQUAL_UINT16(600, fake_servo_link.goal_pos[2]);
    TEST_ASSERT_EQUAL_UINT16(512, fake_servo_link.pose_pos[1]);
    TEST_ASSERT_EQUAL_HEX32(SERVO_LINK_BIT(2), servos.torque);
    TEST_ASSERT_EQUAL_UINT8(PERFORMER_END_THERE, end_reason());
}
