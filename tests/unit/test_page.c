/* SPDX-License-Identifier: MIT */
#include "page.h"
#include "unity.h"

static uint8_t page[PAGE_BYTES];

void setUp(void)
{
    page_clear(page);
}

/* The empty page of PAGE_FORMAT.md, field by field. Its sum without byte 31: 1 + 0x0A + 32 + 32 + 31 * 0x55 +
 * 7 * 31 * 0x40 = 75 + 2635 + 13888 = 16598 = 0x40D6; so byte 31 is 0xFF - 0xD6 = 0x29. */
static void test_page_clear_makes_the_documented_empty_page(void)
{
    TEST_ASSERT_EQUAL_HEX8(0x29, page[31]);
    TEST_ASSERT_EQUAL_UINT8(1, page[15]);
    TEST_ASSERT_EQUAL_HEX8(0x0A, page[16]);
    TEST_ASSERT_EQUAL_UINT8(32, page[22]);
    TEST_ASSERT_EQUAL_UINT8(32, page[24]);
    TEST_ASSERT_EACH_EQUAL_HEX8(0x55, &page[32], 31);
    TEST_ASSERT_EACH_EQUAL_HEX8(0, &page[0], 15);
    TEST_ASSERT_EQUAL_HEX8(0, page[63]);
    TEST_ASSERT_EQUAL_HEX8(0x00, page[64]);
    TEST_ASSERT_EQUAL_HEX8(0x40, page[65]);
    TEST_ASSERT_EQUAL_HEX8(0x40, page[64 + 6 * 64 + 61]);
    TEST_ASSERT_EQUAL_HEX8(0, page[510]);
    TEST_ASSERT_EQUAL_HEX8(0, page[511]);
    TEST_ASSERT_EQUAL(PAGE_OK, page_check(page));
    TEST_ASSERT_FALSE(page_is_playable(page));
}

static void test_page_sum_adds_modulo_256_and_continues(void)
{
    const uint8_t bytes[3] = {0xF0, 0x20, 0x01};
    TEST_ASSERT_EQUAL_HEX8(0x11, page_sum(0, bytes, 3));
    TEST_ASSERT_EQUAL_HEX8(0x11, page_sum(page_sum(0, bytes, 1), &bytes[1], 2));
}

static void test_page_check_finds_a_changed_byte(void)
{
    page[100] ^= 0x10;
    TEST_ASSERT_EQUAL(PAGE_ERR_CHECKSUM, page_check(page));
}

static void test_page_check_reports_the_first_fault_in_documented_order(void)
{
    page[PAGE_AT_STEPS] = 8;
    page[PAGE_AT_SCHEDULE] = 1;
    page[PAGE_AT_SPEED] = 0;
    page[PAGE_AT_LINKED2_PAGE] = 128;
    page_set_pos(page, 0, 0, 1024);
    TEST_ASSERT_EQUAL(PAGE_ERR_CHECKSUM, page_check(page));
    page_seal(page);
    TEST_ASSERT_EQUAL(PAGE_ERR_STEPS, page_check(page));
    page[PAGE_AT_STEPS] = 7;
    page_seal(page);
    TEST_ASSERT_EQUAL(PAGE_ERR_SCHEDULE, page_check(page));
    page[PAGE_AT_SCHEDULE] = PAGE_SCHEDULE_SPEED;
    page_seal(page);
    TEST_ASSERT_EQUAL(PAGE_ERR_SPEED, page_check(page));
    page[PAGE_AT_SPEED] = 1;
    page_seal(page);
    TEST_ASSERT_EQUAL(PAGE_ERR_POSITION, page_check(page));
}

static void test_page_check_takes_a_link_above_127_for_none(void)
{
    static const uint8_t links[4] = {PAGE_AT_NEXT_PAGE, PAGE_AT_EXIT_PAGE, PAGE_AT_LINKED1_PAGE, PAGE_AT_LINKED2_PAGE};
    for (uint8_t i = 0; i < 4; i++) {
        page[links[i]] = 128;
        TEST_ASSERT_EQUAL(PAGE_OK, page_check_header(page));
        page[links[i]] = 255;
        page_seal(page);
        TEST_ASSERT_EQUAL(PAGE_OK, page_check(page));
    }
}

static void test_page_check_ignores_positions_of_steps_not_used(void)
{
    page[PAGE_AT_STEPS] = 2;
    page_set_pos(page, 2, 5, 1024);
    page_seal(page);
    TEST_ASSERT_EQUAL(PAGE_OK, page_check(page));
    page_set_pos(page, 1, 30, 1024);
    page_seal(page);
    TEST_ASSERT_EQUAL(PAGE_ERR_POSITION, page_check(page));
}

static void test_page_position_flags_release_the_joint_whatever_is_below(void)
{
    TEST_ASSERT_TRUE(page_pos_is_used(0));
    TEST_ASSERT_TRUE(page_pos_is_used(1023));
    TEST_ASSERT_FALSE(page_pos_is_used(0x4000));
    TEST_ASSERT_FALSE(page_pos_is_used(0x43FF));
    TEST_ASSERT_FALSE(page_pos_is_used(0x2200));
    page[PAGE_AT_STEPS] = 1;
    page_set_pos(page, 0, 1, 0x5FFF);
    page_set_pos(page, 0, 2, 0x27FF);
    page_seal(page);
    TEST_ASSERT_EQUAL(PAGE_OK, page_check(page));
    page_set_pos(page, 0, 3, 0x8000);
    page_seal(page);
    TEST_ASSERT_EQUAL(PAGE_ERR_POSITION, page_check(page));
}

static void test_page_words_are_little_endian_at_documented_places(void)
{
    page_set_pos(page, 6, 30, 0x0123);
    TEST_ASSERT_EQUAL_HEX8(0x23, page[64 + 6 * 64 + 60]);
    TEST_ASSERT_EQUAL_HEX8(0x01, page[64 + 6 * 64 + 61]);
    TEST_ASSERT_EQUAL_HEX16(0x0123, page_pos(page, 6, 30));
    TEST_ASSERT_EQUAL_HEX16(0x4000, page_pos(page, 6, 29));
}

static void test_page_is_playable_needs_steps_and_a_count(void)
{
    page[PAGE_AT_STEPS] = 1;
    TEST_ASSERT_TRUE(page_is_playable(page));
    page[PAGE_AT_PLAY_COUNT] = 0;
    TEST_ASSERT_FALSE(page_is_playable(page));
}
