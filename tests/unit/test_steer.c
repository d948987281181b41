/* SPDX-License-Identifier: MIT
 * Driving with the remote: left and right steer a page with partners. */
#include "inputs_stage.h"
#include "unity.h"

#include <string.h>

/* Holds `buttons` for `count` ticks: the remote repeats its packet. */
static void hold(uint16_t buttons, uint8_t count)
{
    for (; count > 0; count--) {
        if (count % 8u == 0) {
            remote(buttons);
        }
        ticks(1);
    }
}

static void drive_mode(uint8_t partner_page)
{
    performer.link.mode = LINK_DRIVE;
    partner = partner_page;
    performer.state = PERFORMER_PLAY;
    performer.page = 4;
}

static void test_steer_left_and_right_steer_to_the_full_in_a_second_and_back(void)
{
    drive_mode(6);
    hold(REMOTE_RIGHT, 64);
    TEST_ASSERT_INT_WITHIN(6, 50, performer.shape.blend_percent);
    hold(REMOTE_RIGHT, 72);
    TEST_ASSERT_EQUAL_INT8(100, performer.shape.blend_percent);
    hold(0, 64);
    TEST_ASSERT_INT_WITHIN(6, 50, performer.shape.blend_percent);
    hold(0, 72);
    TEST_ASSERT_EQUAL_INT8(0, performer.shape.blend_percent);
    hold(REMOTE_LEFT, 136);
    TEST_ASSERT_EQUAL_INT8(-100, performer.shape.blend_percent);
    ticks(200); /* no packets from the remote: all buttons count as released */
    TEST_ASSERT_EQUAL_INT8(0, performer.shape.blend_percent);
}

static void test_steer_what_steers_is_no_part_of_the_code(void)
{
    drive_mode(6);
    remote(REMOTE_UP | REMOTE_LEFT);
    remote(REMOTE_BUTTON1 | REMOTE_RIGHT);
    TEST_ASSERT_EQUAL_STRING("code 1 0;code 16 0;", told);
}

static void test_steer_on_the_way_to_the_first_pose_is_no_part_of_the_code_and_steers_from_there_on(void)
{
    drive_mode(6);
    performer.state = PERFORMER_APPROACH;
    hold(REMOTE_RIGHT, 64);
    TEST_ASSERT_EQUAL_INT8(0, performer.shape.blend_percent);
    performer.state = PERFORMER_PLAY;
    hold(REMOTE_RIGHT, 64);
    TEST_ASSERT_NULL(strstr(told, "code 8"));
    TEST_ASSERT_INT_WITHIN(6, 50, performer.shape.blend_percent);
}

static void test_steer_a_move_is_not_steered(void)
{
    drive_mode(6);
    performer.state = PERFORMER_APPROACH;
    performer.page = 0;
    hold(REMOTE_RIGHT, 8);
    TEST_ASSERT_EQUAL_STRING("code 8 0;", told);
}

static void test_steer_page_without_partners_is_not_steered(void)
{
    drive_mode(0);
    hold(REMOTE_LEFT, 16);
    TEST_ASSERT_EQUAL_INT8(0, performer.shape.blend_percent);
    TEST_ASSERT_EQUAL_STRING("code 4 0;code 4 0;", told);
}

static void test_steer_only_a_play_in_drive_mode_steers(void)
{
    drive_mode(6);
    performer.link.mode = LINK_LATCH;
    hold(REMOTE_LEFT, 8);
    TEST_ASSERT_EQUAL_INT8(0, performer.shape.blend_percent);
    TEST_ASSERT_EQUAL_STRING("code 4 0;", told);
}

static void test_steer_nobody_steers_leaves_the_blend_alone(void)
{
    drive_mode(6);
    performer.shape.blend_percent = 40;
    hold(REMOTE_UP, 64);
    TEST_ASSERT_EQUAL_INT8(40, performer.shape.blend_percent);
}
