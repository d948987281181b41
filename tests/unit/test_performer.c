/* SPDX-License-Identifier: MIT
 * The performer with the real player, links and approach above servos that only remember. */
#include "performer.h"

#include <string.h>
#include "dxl.h"
#include "fake_servo_link.h"
#include "unity.h"

#define PAGES 8u
#define ALL_THREE (SERVO_LINK_BIT(1) | SERVO_LINK_BIT(2) | SERVO_LINK_BIT(3))
#define MAX_TICKS 5000u

static uint8_t pages[PAGES][PAGE_BYTES];
static servo_link_t servos;
static settings_t settings;
static performer_t performer;

static void read_page(void *context, uint8_t page, uint16_t offset, void *to, uint8_t count)
{
    (void)context;
    memcpy(to, &pages[page % PAGES][offset], count);
}

static uint8_t check_page(void *context, uint8_t page)
{
    (void)context;
    return (uint8_t)page_check(pages[page % PAGES]);
}

static const page_source_t source = {.context = NULL, .read = read_page, .check = check_page};

/* A page with one step of 64 ticks in which joint 1 goes to `pos`; links to `next`, on stop to `exit`. */
static void make_page(uint8_t page, uint16_t pos, uint8_t next, uint8_t exit)
{
    page_clear(pages[page]);
    pages[page][PAGE_AT_STEPS] = 1;
    pages[page][PAGE_AT_NEXT_PAGE] = next;
    pages[page][PAGE_AT_EXIT_PAGE] = exit;
    page_set_pos(pages[page], 0, 1, pos);
    pages[page][PAGE_AT_STEP0 + PAGE_STEP_AT_SPEED] = 64;
    page_seal(pages[page]);
}

void setUp(void)
{
    for (uint8_t page = 0; page < PAGES; page++) {
        page_clear(pages[page]);
    }
    make_page(1, 612, 0, 0);
    make_page(2, 612, 2, 3); /* for ever, until a stop */
    make_page(3, 412, 0, 0);
    memset(&settings, 0, sizeof settings);
    settings.approach_deg_s = 60;
    settings.battery_low_dv = 100;
    settings.hot_degrees = 70;
    fake_servo_link_reset(&servos, ALL_THREE);
    performer_init(&performer, &source, &servos, &settings);
}

void tearDown(void) {}

static void ticks(uint16_t count)
{
    while (count-- > 0) {
        performer_tick(&performer);
        for (uint8_t i = 0; i < 4; i++) {
            performer_poll(&performer);
        }
    }
}

/* Runs until the state is reached. */
static void reach(uint8_t state)
{
    for (uint16_t i = 0; performer.state != state; i++) {
        TEST_ASSERT_LESS_THAN_UINT16(MAX_TICKS, i);
        ticks(1);
    }
}

static void start(uint8_t page, uint8_t code)
{
    TEST_ASSERT_EQUAL_UINT8(PERFORMER_OK, performer_start(&performer, page, code));
}

/* The next event of this kind; others are dropped. Fails when there is none. */
static performer_event_t expect_event(uint8_t kind)
{
    performer_event_t event;
    while (performer_next_event(&performer, &event)) {
        if (event.kind == kind) {
            return event;
        }
    }
    TEST_FAIL_MESSAGE("the event did not come");
    return event;
}

static bool has_event(uint8_t kind)
{
    performer_event_t event;
    while (performer_next_event(&performer, &event)) {
        if (event.kind == kind) {
            return true;
        }
    }
    return false;
}

static uint8_t end_reason(void)
{
    return expect_event(PERFORMER_EV_ENDED).c;
}

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

/* Two polls a servo: torque, then pose. */
static void test_performer_asks_one_servo_at_a_time_and_moves_nobody_meanwhile(void)
{
    start(1, 0);
    performer_poll(&performer);
    TEST_ASSERT_EQUAL_HEX32(SERVO_LINK_BIT(1), servos.torque);
    for (uint8_t i = 0; i < 5; i++) {
        TEST_ASSERT_EQUAL_UINT8(PERFORMER_READY, performer.state);
        performer_poll(&performer);
    }
    TEST_ASSERT_EQUAL_HEX32(ALL_THREE, servos.torque);
    TEST_ASSERT_EQUAL_UINT16(0, fake_servo_link.frames);
    performer_poll(&performer);
    TEST_ASSERT_EQUAL_UINT8(PERFORMER_APPROACH, performer.state);
    TEST_ASSERT_EQUAL_UINT16(3, fake_servo_link.full_speeds);
}

/* 60 degrees/s are 60 / 300 * 1024 / 128 = 1.6 units a tick; 100 units take 62.5 ticks at that speed, ramps more. */
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

/* ---- stop, break, pause ---- */

static void test_performer_stop_goes_through_the_exit_page(void)
{
    start(2, 0);
    reach(PERFORMER_PLAY);
    ticks(10);
    performer_stop(&performer);
    reach(PERFORMER_IDLE);
    TEST_ASSERT_EQUAL_UINT16(412, fake_servo_link.goal_pos[1]);
    /* Decided when the last step begins: the link of the page under way was taken before the stop. */
    TEST_ASSERT_EQUAL_UINT8(LINK_NEXT, expect_event(PERFORMER_EV_LINK).b);
    TEST_ASSERT_EQUAL_UINT8(LINK_EXIT, expect_event(PERFORMER_EV_LINK).b);
    TEST_ASSERT_EQUAL_UINT8(PERFORMER_END_STOPPED, end_reason());
}

static void test_performer_second_stop_within_a_second_is_a_break(void)
{
    make_page(2, 612, 2, 2); /* its exit link leads nowhere else */
    pages[2][PAGE_AT_STEP0 + PAGE_STEP_AT_SPEED] = 255;
    page_seal(pages[2]);
    start(2, 0);
    reach(PERFORMER_PLAY);
    ticks(10);
    performer_stop(&performer);
    ticks(127);
    TEST_ASSERT_FALSE(performer_is_idle(&performer));
    performer_stop(&performer);
    ticks(40); /* ACCEL_TIME is 32 */
    TEST_ASSERT_TRUE(performer_is_idle(&performer));
    TEST_ASSERT_EQUAL_UINT8(PERFORMER_END_BROKEN, end_reason());
}

static void test_performer_second_stop_after_a_second_is_a_stop(void)
{
    make_page(2, 612, 2, 3);
    pages[2][PAGE_AT_STEP0 + PAGE_STEP_AT_SPEED] = 255;
    page_seal(pages[2]);
    start(2, 0);
    reach(PERFORMER_PLAY);
    ticks(10);
    performer_stop(&performer);
    ticks(129);
    performer_stop(&performer);
    reach(PERFORMER_IDLE);
    TEST_ASSERT_EQUAL_UINT8(PERFORMER_END_STOPPED, end_reason());
}

static void test_performer_break_slows_down_and_holds(void)
{
    make_page(1, 912, 0, 0);
    settings.approach_deg_s = 0;
    start(1, 0);
    reach(PERFORMER_PLAY);
    ticks(32);
    uint16_t last = fake_servo_link.goal_pos[1];
    performer_break(&performer);
    uint16_t last_step = 100;
    while (!performer_is_idle(&performer)) {
        ticks(1);
        const uint16_t step = (uint16_t)(fake_servo_link.goal_pos[1] - last);
        TEST_ASSERT_LESS_OR_EQUAL_UINT16(last_step + 1, step); /* slower and slower, never back */
        last = fake_servo_link.goal_pos[1];
        last_step = step;
    }
    TEST_ASSERT_EQUAL_UINT8(PERFORMER_END_BROKEN, end_reason());
    TEST_ASSERT_EQUAL_HEX32(ALL_THREE, servos.torque);
}

static void test_performer_stop_during_the_approach_ends_there(void)
{
    start(1, 0);
    reach(PERFORMER_APPROACH);
    ticks(10);
    performer_stop(&performer);
    ticks(40);
    TEST_ASSERT_TRUE(performer_is_idle(&performer));
    TEST_ASSERT_LESS_THAN_UINT16(612, fake_servo_link.goal_pos[1]);
    TEST_ASSERT_EQUAL_UINT8(PERFORMER_END_BROKEN, end_reason());
}

static void test_performer_break_while_getting_ready_moves_nothing(void)
{
    start(1, 0);
    performer_poll(&performer);
    performer_break(&performer);
    ticks(10);
    TEST_ASSERT_TRUE(performer_is_idle(&performer));
    TEST_ASSERT_EQUAL_UINT16(0, fake_servo_link.frames);
}

static void test_performer_pause_holds_and_resume_goes_on(void)
{
    make_page(1, 912, 0, 0);
    settings.approach_deg_s = 0;
    start(1, 0);
    reach(PERFORMER_PLAY);
    ticks(20);
    TEST_ASSERT_TRUE(performer_pause(&performer));
    ticks(60);
    TEST_ASSERT_TRUE(performer_is_paused(&performer));
    (void)expect_event(PERFORMER_EV_PAUSED);
    const uint16_t held = fake_servo_link.goal_pos[1];
    ticks(200);
    TEST_ASSERT_EQUAL_UINT16(held, fake_servo_link.goal_pos[1]);
    TEST_ASSERT_TRUE(performer_resume(&performer));
    reach(PERFORMER_IDLE);
    TEST_ASSERT_EQUAL_UINT16(912, fake_servo_link.goal_pos[1]);
    TEST_ASSERT_EQUAL_UINT8(PERFORMER_END_DONE, end_reason());
}

static void test_performer_pause_during_the_approach(void)
{
    start(1, 0);
    reach(PERFORMER_APPROACH);
    ticks(10);
    TEST_ASSERT_TRUE(performer_pause(&performer));
    reach(PERFORMER_STOOD);
    TEST_ASSERT_TRUE(performer_is_paused(&performer));
    TEST_ASSERT_FALSE(performer_pause(&performer));
    TEST_ASSERT_TRUE(performer_resume(&performer));
    reach(PERFORMER_IDLE);
    TEST_ASSERT_EQUAL_UINT8(PERFORMER_END_DONE, end_reason());
    TEST_ASSERT_EQUAL_UINT16(612, fake_servo_link.goal_pos[1]);
}

static void test_performer_stop_ends_a_pause(void)
{
    start(2, 0);
    reach(PERFORMER_PLAY);
    ticks(10);
    TEST_ASSERT_TRUE(performer_pause(&performer));
    ticks(100);
    performer_stop(&performer);
    reach(PERFORMER_IDLE);
    TEST_ASSERT_EQUAL_UINT8(PERFORMER_END_STOPPED, end_reason());
}

static void test_performer_idle_has_nothing_to_stop(void)
{
    performer_stop(&performer);
    performer_break(&performer);
    performer_code(&performer, 5);
    TEST_ASSERT_FALSE(performer_pause(&performer));
    TEST_ASSERT_FALSE(performer_resume(&performer));
    TEST_ASSERT_FALSE(has_event(PERFORMER_EV_ENDED));
}

static void test_performer_end_follows_no_link(void)
{
    start(2, 0);
    reach(PERFORMER_PLAY);
    ticks(10);
    performer_end(&performer);
    reach(PERFORMER_IDLE);
    TEST_ASSERT_EQUAL_UINT16(612, fake_servo_link.goal_pos[1]);
    TEST_ASSERT_EQUAL_UINT8(PERFORMER_END_STOPPED, end_reason());
}

/* ---- codes ---- */

static void test_performer_code_takes_the_linked_page(void)
{
    make_page(2, 612, 2, 0);
    pages[2][PAGE_AT_LINKED1_PAGE] = 3;
    pages[2][PAGE_AT_LINKED1_CODE] = 4;
    page_seal(pages[2]);
    start(2, 1);
    reach(PERFORMER_PLAY);
    ticks(10);
    performer_code(&performer, 4);
    performer_code(&performer, 0); /* latch: letting go changes nothing */
    reach(PERFORMER_IDLE);
    while (true) {
        const performer_event_t event = expect_event(PERFORMER_EV_LINK);
        if (event.b == LINK_LINKED1) {
            TEST_ASSERT_EQUAL_UINT8(3, event.a);
            return;
        }
    }
}

static void test_performer_hold_mode_stops_when_the_hand_lets_go(void)
{
    settings.remote_mode = LINK_HOLD;
    start(2, 1);
    reach(PERFORMER_PLAY);
    ticks(10);
    performer_code(&performer, 0);
    reach(PERFORMER_IDLE);
    TEST_ASSERT_EQUAL_UINT8(PERFORMER_END_STOPPED, end_reason());
}

static void test_performer_hold_mode_let_go_during_the_approach(void)
{
    settings.remote_mode = LINK_HOLD;
    start(2, 1);
    reach(PERFORMER_APPROACH);
    performer_code(&performer, 0);
    ticks(40);
    TEST_ASSERT_TRUE(performer_is_idle(&performer));
}

static void test_performer_stop_code_twice_is_a_break(void)
{
    start(2, 1);
    reach(PERFORMER_PLAY);
    ticks(5);
    performer_code(&performer, 255);
    TEST_ASSERT_FALSE(performer_is_idle(&performer));
    performer_code(&performer, 255);
    ticks(40);
    TEST_ASSERT_EQUAL_UINT8(PERFORMER_END_BROKEN, end_reason());
}

/* ---- faults ---- */

static void play_with_fault(uint8_t rule, uint8_t kind, uint8_t errors)
{
    settings.fault_rule = rule;
    start(2, 0);
    reach(PERFORMER_PLAY);
    ticks(10);
    fake_servo_link_fault(&servos, 1, kind, errors);
    ticks(1);
}

static void test_performer_fault_hold_slows_down_and_holds(void)
{
    play_with_fault(SETTINGS_FAULT_HOLD, SERVO_FAULT_SILENT, 0);
    ticks(40);
    TEST_ASSERT_TRUE(performer_is_idle(&performer));
    TEST_ASSERT_EQUAL_UINT8(1, expect_event(PERFORMER_EV_SILENT).a);
    TEST_ASSERT_EQUAL_UINT8(PERFORMER_END_SERVO, end_reason());
    TEST_ASSERT_EQUAL_HEX32(SERVO_LINK_BIT(1), performer.faulty);
    fake_servo_link_fault(&servos, 1, SERVO_FAULT_BACK, 0);
    ticks(1);
    TEST_ASSERT_EQUAL_HEX32(0, performer.faulty);
}

static void test_performer_fault_hold_sends_the_faulty_joint_nothing_more(void)
{
    pages[2][PAGE_AT_STEPS] = 2;
    page_set_pos(pages[2], 1, 1, 412);
    pages[2][PAGE_AT_STEP0 + PAGE_STEP_BYTES + PAGE_STEP_AT_SPEED] = 64;
    page_seal(pages[2]);
    start(2, 0);
    reach(PERFORMER_PLAY);
    ticks(64 + 30); /* in the middle of the second step */
    fake_servo_link_fault(&servos, 1, SERVO_FAULT_ERRORS, DXL_ERR_OVERLOAD);
    ticks(1);
    const uint16_t held = fake_servo_link.goal_pos[1];
    ticks(2);
    TEST_ASSERT_FALSE(performer_is_idle(&performer)); /* the others slow down */
    reach(PERFORMER_IDLE);
    TEST_ASSERT_EQUAL_UINT16(held, fake_servo_link.goal_pos[1]);
}

static void test_performer_fault_is_over_when_errors_go_or_torque_comes_back(void)
{
    play_with_fault(SETTINGS_FAULT_HOLD, SERVO_FAULT_ERRORS, DXL_ERR_ANGLE);
    fake_servo_link_fault(&servos, 1, SERVO_FAULT_ERRORS, 0);
    ticks(40);
    TEST_ASSERT_EQUAL_HEX32(0, performer.faulty);
    fake_servo_link_fault(&servos, 1, SERVO_FAULT_TORQUE, 0);
    servos.torque &= ~SERVO_LINK_BIT(1);
    fake_servo_link_fault(&servos, 2, SERVO_FAULT_ERRORS, DXL_ERR_VOLTAGE);
    ticks(1);
    fake_servo_link_fault(&servos, 1, SERVO_FAULT_ERRORS, 0);
    ticks(1);
    TEST_ASSERT_EQUAL_HEX32(SERVO_LINK_BIT(1) | SERVO_LINK_BIT(2), performer.faulty);
    (void)performer_on(&performer, SERVO_LINK_BIT(1));
    TEST_ASSERT_EQUAL_HEX32(SERVO_LINK_BIT(2), performer.faulty);
    start(2, 0);
    TEST_ASSERT_EQUAL_HEX32(0, performer.faulty);
}

static void test_performer_fault_limp_goes_on_without_the_joint(void)
{
    play_with_fault(SETTINGS_FAULT_LIMP, SERVO_FAULT_ERRORS, DXL_ERR_OVERLOAD);
    const uint16_t held = fake_servo_link.goal_pos[1];
    ticks(300);
    TEST_ASSERT_FALSE(performer_is_idle(&performer));
    TEST_ASSERT_EQUAL_HEX32(0, servos.torque & SERVO_LINK_BIT(1));
    TEST_ASSERT_EQUAL_UINT16(held, fake_servo_link.goal_pos[1]);
}

static void test_performer_fault_exit_leaves_through_the_exit_page(void)
{
    page_set_pos(pages[3], 0, 2, 300);
    page_seal(pages[3]);
    play_with_fault(SETTINGS_FAULT_EXIT, SERVO_FAULT_ERRORS, DXL_ERR_HEAT);
    reach(PERFORMER_IDLE);
    TEST_ASSERT_EQUAL_UINT8(PERFORMER_END_SERVO, end_reason());
    TEST_ASSERT_EQUAL_UINT16(300, fake_servo_link.goal_pos[2]);
}

static void test_performer_voltage_error_is_told_and_ends_nothing(void)
{
    play_with_fault(SETTINGS_FAULT_HOLD, SERVO_FAULT_ERRORS, DXL_ERR_VOLTAGE);
    ticks(300);
    TEST_ASSERT_FALSE(performer_is_idle(&performer));
    TEST_ASSERT_EQUAL_HEX8(DXL_ERR_VOLTAGE, expect_event(PERFORMER_EV_ERRORS).b);
}

static void test_performer_fault_of_a_joint_out_of_the_play_ends_nothing(void)
{
    performer_off(&performer, SERVO_LINK_BIT(3));
    start(2, 0);
    reach(PERFORMER_PLAY);
    fake_servo_link_fault(&servos, 3, SERVO_FAULT_SILENT, 0);
    ticks(300);
    TEST_ASSERT_FALSE(performer_is_idle(&performer));
}

static void test_performer_silent_servo_at_the_start_is_named(void)
{
    fake_servo_link.mute = SERVO_LINK_BIT(2);
    start(1, 0);
    ticks(10);
    TEST_ASSERT_TRUE(performer_is_idle(&performer));
    TEST_ASSERT_EQUAL_UINT16(0, fake_servo_link.frames);
    TEST_ASSERT_EQUAL_UINT8(2, expect_event(PERFORMER_EV_SILENT).a);
    TEST_ASSERT_EQUAL_UINT8(PERFORMER_END_SERVO, end_reason());
}

static void test_performer_silent_servo_at_the_start_may_be_left_out(void)
{
    settings.fault_rule = SETTINGS_FAULT_LIMP;
    fake_servo_link.mute = SERVO_LINK_BIT(2);
    start(1, 0);
    reach(PERFORMER_PLAY);
    reach(PERFORMER_IDLE);
    TEST_ASSERT_EQUAL_UINT8(PERFORMER_END_DONE, end_reason());
}

static void test_performer_low_battery_is_told_once_a_play(void)
{
    servos.voltage_dv = 99;
    ticks(100);
    TEST_ASSERT_EQUAL_UINT8(99, expect_event(PERFORMER_EV_BATTERY).a);
    servos.voltage_dv = 120;
    ticks(1);
    servos.voltage_dv = 98; /* it sags under load, time and again */
    ticks(100);
    TEST_ASSERT_FALSE(has_event(PERFORMER_EV_BATTERY));
    start(1, 0);
    ticks(1);
    TEST_ASSERT_EQUAL_UINT8(98, expect_event(PERFORMER_EV_BATTERY).a);
}

static void test_performer_hot_servo_is_named(void)
{
    servos.hottest_degrees = 70;
    servos.hottest_id = 3;
    ticks(2);
    TEST_ASSERT_EQUAL_UINT8(3, expect_event(PERFORMER_EV_HOT).a);
    TEST_ASSERT_FALSE(has_event(PERFORMER_EV_HOT));
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
    TEST_ASSERT_EQUAL_UINT8(PERFORMER_END_THERE, end_reason());
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_performer_start_refuses_what_cannot_be_played);
    RUN_TEST(test_performer_start_refuses_without_servos);
    RUN_TEST(test_performer_start_refuses_a_second_play);
    RUN_TEST(test_performer_asks_one_servo_at_a_time_and_moves_nobody_meanwhile);
    RUN_TEST(test_performer_approach_keeps_to_the_speed_limit);
    RUN_TEST(test_performer_needs_no_approach_when_it_is_there);
    RUN_TEST(test_performer_without_approach_plays_from_the_present_pose);
    RUN_TEST(test_performer_drives_only_who_is_there_and_used);
    RUN_TEST(test_performer_leaves_alone_who_was_switched_off);
    RUN_TEST(test_performer_sends_the_compliance_of_the_page);
    RUN_TEST(test_performer_tells_steps_links_and_the_end);
    RUN_TEST(test_performer_counts_repetitions);
    RUN_TEST(test_performer_names_the_damaged_page_a_link_leads_to);
    RUN_TEST(test_performer_full_queue_keeps_the_end);
    RUN_TEST(test_performer_stop_goes_through_the_exit_page);
    RUN_TEST(test_performer_second_stop_within_a_second_is_a_break);
    RUN_TEST(test_performer_second_stop_after_a_second_is_a_stop);
    RUN_TEST(test_performer_break_slows_down_and_holds);
    RUN_TEST(test_performer_stop_during_the_approach_ends_there);
    RUN_TEST(test_performer_break_while_getting_ready_moves_nothing);
    RUN_TEST(test_performer_pause_holds_and_resume_goes_on);
    RUN_TEST(test_performer_pause_during_the_approach);
    RUN_TEST(test_performer_stop_ends_a_pause);
    RUN_TEST(test_performer_end_follows_no_link);
    RUN_TEST(test_performer_idle_has_nothing_to_stop);
    RUN_TEST(test_performer_code_takes_the_linked_page);
    RUN_TEST(test_performer_hold_mode_stops_when_the_hand_lets_go);
    RUN_TEST(test_performer_hold_mode_let_go_during_the_approach);
    RUN_TEST(test_performer_stop_code_twice_is_a_break);
    RUN_TEST(test_performer_fault_hold_slows_down_and_holds);
    RUN_TEST(test_performer_fault_hold_sends_the_faulty_joint_nothing_more);
    RUN_TEST(test_performer_fault_is_over_when_errors_go_or_torque_comes_back);
    RUN_TEST(test_performer_fault_limp_goes_on_without_the_joint);
    RUN_TEST(test_performer_fault_exit_leaves_through_the_exit_page);
    RUN_TEST(test_performer_voltage_error_is_told_and_ends_nothing);
    RUN_TEST(test_performer_fault_of_a_joint_out_of_the_play_ends_nothing);
    RUN_TEST(test_performer_silent_servo_at_the_start_is_named);
    RUN_TEST(test_performer_silent_servo_at_the_start_may_be_left_out);
    RUN_TEST(test_performer_low_battery_is_told_once_a_play);
    RUN_TEST(test_performer_hot_servo_is_named);
    RUN_TEST(test_performer_off_takes_a_joint_out_of_the_play);
    RUN_TEST(test_performer_on_waits_for_the_end_of_a_play);
    RUN_TEST(test_performer_move_goes_there_and_touches_nobody_else);
    return UNITY_END();
}
