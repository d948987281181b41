/* SPDX-License-Identifier: MIT
 * How editing mirrors positions. */
#include "page_edit.h"
#include "unity.h"

static void test_page_mirrored_position_is_as_far_on_the_other_side_within_the_servo(void)
{
    TEST_ASSERT_EQUAL_UINT16(512, page_edit_mirrored(512, 1024));
    TEST_ASSERT_EQUAL_UINT16(424, page_edit_mirrored(600, 1024));
    TEST_ASSERT_EQUAL_UINT16(1, page_edit_mirrored(1023, 1024));
    TEST_ASSERT_EQUAL_UINT16(1023, page_edit_mirrored(0, 1024));
    TEST_ASSERT_EQUAL_UINT16(0, page_edit_mirrored(900, 2 * 400));
    TEST_ASSERT_EQUAL_UINT16(1023, page_edit_mirrored(100, 2 * 700));
}
