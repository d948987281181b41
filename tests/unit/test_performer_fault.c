/* SPDX-License-Identifier: MIT
 * The performer: faults of servos, battery, heat. */
#include "performer_stage.h"

#include <setjmp.h>
#include "dxl.h"
#include "fake_bus.h"
#include "fake_system.h"
#include "fake_time.h"
#include "tick.h"
#include "unity.h"

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
    TEST_ASSERT_FALSE(performer_is_idle(&performer)); /* the other joints slow down */
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

/* Switching a torque off blocks the loop; two in one turn would delay the next tick's goals. */
static void test_performer_fault_limp_switches_one_joint_off_a_turn(void)
{
    settings.fault_rule = SETTINGS_FAULT_LIMP;
    start(2, 0);
    reach(PERFORMER_PLAY);
    fake_servo_link_fault(&servos, 1, SERVO_FAULT_ERRORS, DXL_ERR_OVERLOAD);
    fake_servo_link_fault(&servos, 2, SERVO_FAULT_ERRORS, DXL_ERR_OVERLOAD);
    performer_poll(&performer);
    TEST_ASSERT_EQUAL_HEX32(SERVO_LINK_BIT(2), servos.torque & (SERVO_LINK_BIT(1) | SERVO_LINK_BIT(2)));
    performer_poll(&performer);
    TEST_ASSERT_EQUAL_HEX32(0, servos.torque & (SERVO_LINK_BIT(1) | SERVO_LINK_BIT(2)));
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

/* The person who paused it may have hands at it. */
static void test_performer_fault_exit_in_a_pause_moves_nothing(void)
{
    settings.fault_rule = SETTINGS_FAULT_EXIT;
    start(2, 0);
    reach(PERFORMER_PLAY);
    ticks(10);
    TEST_ASSERT_TRUE(performer_pause(&performer));
    ticks(60);
    const uint16_t held = fake_servo_link.goal_pos[1];
    fake_servo_link_fault(&servos, 2, SERVO_FAULT_SILENT, 0);
    ticks(300);
    TEST_ASSERT_EQUAL_UINT16(held, fake_servo_link.goal_pos[1]);
    TEST_ASSERT_TRUE(performer_is_idle(&performer));
    TEST_ASSERT_EQUAL_UINT8(PERFORMER_END_SERVO, end_reason());
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
    TEST_ASSERT_EQUAL_UINT8(2, expect_event(PERFORMER_EV_UNREADY).a);
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
    servos.voltage_dv = 98; /* the battery sags under load repeatedly */
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

static void test_performer_servo_is_cool_three_degrees_below(void)
{
    servos.hottest_degrees = 70;
    ticks(2);
    for (servos.hottest_degrees = 68; servos.hottest_degrees <= 70; servos.hottest_degrees++) {
        ticks(2);
        TEST_ASSERT_FALSE(has_event(PERFORMER_EV_COOL));
    }
    servos.hottest_degrees = 67;
    ticks(2);
    (void)expect_event(PERFORMER_EV_COOL);
    TEST_ASSERT_FALSE(performer.is_hot);
}

static void test_performer_without_a_limit_no_servo_is_hot(void)
{
    servos.hottest_degrees = 70;
    ticks(2);
    TEST_ASSERT_TRUE(performer.is_hot);
    settings.hot_degrees = 0;
    servos.hottest_degrees = 255;
    ticks(2);
    TEST_ASSERT_FALSE(performer.is_hot);
}

/* ---- the computer ---- */

/* Runs the main loop for a tick that is late by `late` ticks. */
static void tick_late_by(uint16_t late)
{
    fake_time_ticks((uint16_t)(late + 1u));
    TEST_ASSERT_TRUE(tick_take());
    ticks(1);
}

static void test_performer_ticks_late_by_less_than_a_tenth_of_a_second_are_only_counted(void)
{
    fake_time_reset();
    start(2, 0);
    reach(PERFORMER_PLAY);
    tick_late_by(12);
    TEST_ASSERT_EQUAL(PERFORMER_PLAY, performer.state);
    TEST_ASSERT_FALSE(performer.leaving);
    TEST_ASSERT_EQUAL(12, tick_missed());
}

static void test_performer_tick_late_by_a_tenth_of_a_second_breaks_softly_and_says_so(void)
{
    fake_time_reset();
    start(2, 0);
    reach(PERFORMER_PLAY);
    tick_late_by(13);
    TEST_ASSERT_TRUE(performer.leaving);
    TEST_ASSERT_EQUAL(PERFORMER_PLAY, performer.state);   /* it is slowing down */
    fake_time_reset();
    ticks(60);
    TEST_ASSERT_TRUE(performer_is_idle(&performer));
    (void)expect_event(PERFORMER_EV_TICKS_LATE);
    TEST_ASSERT_EQUAL_UINT8(PERFORMER_END_BROKEN, end_reason());
}

static void test_performer_late_tick_of_a_robot_that_stands_is_nothing(void)
{
    performer_event_t event;
    fake_time_reset();
    tick_late_by(500);
    TEST_ASSERT_FALSE(performer_next_event(&performer, &event));
    fake_time_reset();
}

static void test_performer_bus_that_goes_ends_the_play_and_nobody_is_driven_before_on(void)
{
    start(2, 0);
    reach(PERFORMER_PLAY);
    ticks(10);
    fake_bus_lose();
    const uint16_t frames = fake_servo_link.frames;
    performer_poll(&performer);
    (void)expect_event(PERFORMER_EV_BUS_LOST);
    TEST_ASSERT_EQUAL_UINT8(PERFORMER_END_BROKEN, end_reason());
    ticks(200);
    TEST_ASSERT_EQUAL(frames, fake_servo_link.frames);
    TEST_ASSERT_EQUAL(PERFORMER_ERR_RELEASED, performer_start(&performer, 2, 0));
    TEST_ASSERT_NOT_EQUAL(0, performer_on(&performer, SERVO_LINK_BIT(1)));
    TEST_ASSERT_EQUAL(PERFORMER_OK, performer_start(&performer, 2, 0));
}

static void test_performer_asked_to_end_comes_to_a_stand_first(void)
{
    jmp_buf ended;
    static uint16_t ticks_to_end;   /* static: kept across longjmp */
    fake_system_reset();
    start(2, 0);
    reach(PERFORMER_PLAY);
    ticks(10);
    ticks_to_end = 0;
    if (setjmp(ended) == 0) {
        fake_system_on_restart(&ended);
        fake_system_ask_to_end();
        for (; ticks_to_end < 200; ticks_to_end++) {
            ticks(1);
        }
        TEST_FAIL_MESSAGE("it never ended");
    }
    fake_system_reset();
    TEST_ASSERT_TRUE(performer_is_idle(&performer));
    TEST_ASSERT_TRUE(ticks_to_end > 1);
    TEST_ASSERT_NOT_EQUAL(0, servos.torque);
}
