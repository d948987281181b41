/* SPDX-License-Identifier: MIT
 * How editing computes positions and times. */
#include "page_edit.h"
#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static void test_page_mirrored_position_is_as_far_on_the_other_side_within_the_servo(void)
{
    TEST_ASSERT_EQUAL_UINT16(512, page_edit_mirrored(512, 1024));
    TEST_ASSERT_EQUAL_UINT16(424, page_edit_mirrored(600, 1024));
    TEST_ASSERT_EQUAL_UINT16(1, page_edit_mirrored(1023, 1024));
    TEST_ASSERT_EQUAL_UINT16(1023, page_edit_mirrored(0, 1024));
    TEST_ASSERT_EQUAL_UINT16(0, page_edit_mirrored(900, 2 * 400));
    TEST_ASSERT_EQUAL_UINT16(1023, page_edit_mirrored(100, 2 * 700));
}

static void test_page_position_between_two_is_rounded_away_from_the_first(void)
{
    TEST_ASSERT_EQUAL_UINT16(513, page_edit_between(512, 513, 50));
    TEST_ASSERT_EQUAL_UINT16(512, page_edit_between(513, 512, 50));
    TEST_ASSERT_EQUAL_UINT16(400, page_edit_between(400, 800, 0));
    TEST_ASSERT_EQUAL_UINT16(800, page_edit_between(400, 800, 100));
    TEST_ASSERT_EQUAL_UINT16(256, page_edit_between(0, 1023, 25));
    TEST_ASSERT_EQUAL_UINT16(767, page_edit_between(1023, 0, 25));
}

static void must_split(uint8_t time, uint8_t percent, uint8_t first, uint8_t rest)
{
    TEST_ASSERT_EQUAL_UINT8(first, page_edit_time_split(&time, percent));
    TEST_ASSERT_EQUAL_UINT8(rest, time);
}

static void test_page_time_is_shared_and_nothing_gets_none(void)
{
    must_split(31, 50, 16, 15);
    must_split(255, 25, 64, 191);
    must_split(1, 50, 1, 1);
    must_split(9, 0, 1, 8);
    must_split(0, 50, 0, 0);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_page_mirrored_position_is_as_far_on_the_other_side_within_the_servo);
    RUN_TEST(test_page_position_between_two_is_rounded_away_from_the_first);
    RUN_TEST(test_page_time_is_shared_and_nothing_gets_none);
    return UNITY_END();
}
