/* SPDX-License-Identifier: MIT
 * The performer: driving by a program, and shaping a play from outside. */
#include "performer_stage.h"

#include "unity.h"

#define SECOND 128u

static void drive(int8_t blend, uint16_t rate, uint8_t amplitude)
{
    performer_drive(&performer, blend, rate, amplitude);
}

static void test_drive_sets_all_three(void)
{
    drive(-40, 150, 60);
    TEST_ASSERT_EQUAL_INT8(-40, performer.shape.blend_percent);
    TEST_ASSERT_EQUAL_UINT16(150, performer.shape.rate_percent);
    TEST_ASSERT_EQUAL_UINT8(60, performer.shape.amplitude_percent[0]);
    TEST_ASSERT_EQUAL_UINT8(60, performer.shape.amplitude_percent[30]);
}

static void test_drive_that_falls_silent_ends_through_the_exit_page(void)
{
    settings.drive_ds = 10;
    start(2, 0);
    reach(PERFORMER_PLAY);
    drive(0, 100, 100);
    ticks(SECOND - 1);
    TEST_ASSERT_FALSE(has_event(PERFORMER_EV_DRIVE_LOST));
    ticks(1);
    TEST_ASSERT_TRUE(has_event(PERFORMER_EV_DRIVE_LOST));
    reach(PERFORMER_IDLE);
    TEST_ASSERT_EQUAL_UINT8(3, performer.page);
    TEST_ASSERT_EQUAL_UINT16(412, fake_servo_link.goal_pos[1]); /* target of the exit page */
    TEST_ASSERT_EQUAL_UINT8(PERFORMER_END_STOPPED, end_reason());
}

static void test_drive_again_and_again_goes_on(void)
{
    settings.drive_ds = 10;
    start(2, 0);
    reach(PERFORMER_PLAY);
    for (uint8_t i = 0; i < 20; i++) {
        drive(0, 100, 100);
        ticks(SECOND - 1);
    }
    TEST_ASSERT_EQUAL_UINT8(PERFORMER_PLAY, performer.state);
}

static void test_drive_without_watchdog_goes_on(void)
{
    settings.drive_ds = 0;
    start(2, 0);
    reach(PERFORMER_PLAY);
    drive(0, 100, 100);
    ticks(10 * SECOND);
    TEST_ASSERT_EQUAL_UINT8(PERFORMER_PLAY, performer.state);
}

static void test_drive_lost_on_the_way_to_the_first_pose_breaks(void)
{
    settings.drive_ds = 1;
    make_page(2, 912, 2, 3);
    start(2, 0);
    reach(PERFORMER_APPROACH);
    drive(0, 100, 100);
    ticks(13);
    reach(PERFORMER_IDLE);
    TEST_ASSERT_LESS_THAN_UINT16(912, fake_servo_link.goal_pos[1]);
    TEST_ASSERT_EQUAL_UINT8(PERFORMER_END_BROKEN, end_reason());
}

static void test_what_drive_has_set_ends_with_the_play(void)
{
    settings.drive_ds = 10;
    start(1, 0);
    reach(PERFORMER_PLAY);
    drive(30, 200, 50);
    reach(PERFORMER_IDLE);
    TEST_ASSERT_TRUE(shape_is_neutral(&performer.shape));
    start(2, 0);
    reach(PERFORMER_PLAY);
    ticks(5 * SECOND); /* this play is not driven */
    TEST_ASSERT_EQUAL_UINT8(PERFORMER_PLAY, performer.state);
}

static void test_drive_that_falls_silent_before_a_play_is_over(void)
{
    settings.drive_ds = 10;
    drive(30, 200, 50);
    ticks(SECOND);
    TEST_ASSERT_TRUE(shape_is_neutral(&performer.shape));
    TEST_ASSERT_FALSE(has_event(PERFORMER_EV_DRIVE_LOST));
}

static void test_rate_set_by_hand_outlives_the_play(void)
{
    performer.shape.rate_percent = 200;
    start(1, 0);
    reach(PERFORMER_PLAY);
    uint16_t count = 0;
    for (; performer.state == PERFORMER_PLAY; count++) {
        ticks(1);
    }
    TEST_ASSERT_UINT16_WITHIN(2, 32, count); /* 64 ticks at 200 % */
    TEST_ASSERT_EQUAL_UINT16(612, fake_servo_link.goal_pos[1]);
    TEST_ASSERT_EQUAL_UINT16(200, performer.shape.rate_percent);
}

/* 412 is 362 at 150 % about 512. The approach goes on, as slowly, to the pose as it is stored. */
static void test_shape_reset_on_the_way_to_the_first_pose_makes_no_leap(void)
{
    make_page(1, 512, 0, 0);
    settings.centre_page = 1;
    page_set_pos(pages[3], 0, 2, 512);
    page_set_pos(pages[3], 0, 3, 512);
    page_seal(pages[3]);
    shape_set_amplitude(&performer.shape, 150, SERVO_LINK_ALL);
    start(3, 0);
    reach(PERFORMER_APPROACH);
    ticks(20);
    shape_reset(&performer.shape);
    uint16_t last = fake_servo_link.goal_pos[1], lowest = last;
    while (performer.state == PERFORMER_APPROACH) {
        ticks(1);
        const uint16_t now = fake_servo_link.goal_pos[1];
        TEST_ASSERT_UINT16_WITHIN(2, last, now); /* 60 degrees/s are 1.6 units a tick */
        lowest = now < lowest ? now : lowest;
        last = now;
    }
    TEST_ASSERT_EQUAL_UINT16(362, lowest);
    TEST_ASSERT_EQUAL_UINT16(412, last);
}

static void test_limit_follows_the_voltage(void)
{
    ticks(1);
    TEST_ASSERT_EQUAL_UINT8(0, performer.shape.top_speed_q4_4);
    servos.voltage_dv = 111;
    ticks(1);
    TEST_ASSERT_UINT8_WITHIN(1, 125, performer.shape.top_speed_q4_4); /* 0.9 * 8.7 units a tick, in sixteenths */
    servos.voltage_dv = 96;
    ticks(1);
    TEST_ASSERT_UINT8_WITHIN(1, 108, performer.shape.top_speed_q4_4); /* 0.9 * 7.5 */
}

static void test_centre_page_is_that_of_the_settings(void)
{
    settings.centre_page = 7;
    start(1, 0);
    TEST_ASSERT_EQUAL_UINT8(7, performer.shape.centre_page);
}

/* ---- joints moved by code ---- */

/* The end of the break frees all joints, so OK would be a promise that is not kept. */
static void test_joint_is_not_taken_for_code_while_a_break_slows_down(void)
{
    start(2, 0);
    reach(PERFORMER_PLAY);
    ticks(10);
    TEST_ASSERT_EQUAL(LAYERS_OK, performer_take_for_code(&performer, 2));
    performer_break(&performer);
    ticks(1);
    TEST_ASSERT_EQUAL(PERFORMER_PLAY, performer.state);
    TEST_ASSERT_EQUAL(LAYERS_ERR_BUSY, performer_take_for_code(&performer, 2));
    reach(PERFORMER_IDLE);
    TEST_ASSERT_EQUAL(LAYERS_OK, performer_take_for_code(&performer, 2));
}
