/* SPDX-License-Identifier: MIT
 * Motion pages in fake flash: which are valid, their names, codes and trim. */
#include "fake_flash.h"
#include "fake_system.h"
#include "memory_map.h"
#include "page_store.h"
#include "unity.h"

#include <string.h>

static page_store_t store;
static uint8_t page[PAGE_BYTES];

/* Address of page n: 0x0E000 + 512 n (BOARD.md). */
static uint8_t *flash_of(uint8_t number)
{
    return fake_flash_bytes() + 0x0E000 + 512u * number;
}

static void put(uint8_t number, const char *name, uint8_t steps, uint8_t code)
{
    page_clear(page);
    memcpy(page + PAGE_AT_NAME, name, strlen(name));
    page[PAGE_AT_STEPS] = steps;
    page[PAGE_AT_PLAY_CODE] = code;
    page_seal(page);
    memcpy(flash_of(number), page, PAGE_BYTES);
}

void setUp(void)
{
    fake_flash_reset();
    fake_system_reset();
    memset(&store, 0xEE, sizeof store);
}

static void test_good_pages_are_found_at_the_ends_and_across_64_KiB(void)
{
    put(0, "Offset", 0, 0);
    put(15, "Before", 1, 0);   /* 0x0FE00..0x0FFFF */
    put(16, "After", 1, 0);    /* 0x10000.. */
    put(127, "Last", 7, 0);
    page_store_init(&store);
    for (uint8_t number = 0; number < PAGE_COUNT; number++) {
        bool good = number == 0 || number == 15 || number == 16 || number == 127;
        TEST_ASSERT_EQUAL(good, page_store_is_good(&store, number));
    }
    TEST_ASSERT_FALSE(page_store_is_good(&store, 128));
    TEST_ASSERT_EQUAL_HEX32(0x1DE00, page_store_addr(127));
}

static void test_watchdog_is_kicked_while_pages_are_checked(void)
{
    page_store_init(&store);
    TEST_ASSERT_TRUE(fake_system_kicks() >= 128);
}

static void test_check_names_the_fault_as_page_check_does(void)
{
    put(1, "Sum", 1, 0);
    flash_of(1)[100] ^= 0x10;
    page_store_init(&store);
    TEST_ASSERT_EQUAL(PAGE_ERR_CHECKSUM, page_store_check(&store, 1));

    put(2, "Steps", 8, 0);
    put(3, "Position", 2, 0);
    page_set_pos(page, 1, 30, 1024);
    page_seal(page);
    memcpy(flash_of(3), page, PAGE_BYTES);
    put(4, "Unused step", 1, 0);
    page_set_pos(page, 1, 30, 1024);   /* after the last step, so never played */
    page_seal(page);
    memcpy(flash_of(4), page, PAGE_BYTES);
    page_store_init(&store);
    TEST_ASSERT_EQUAL(PAGE_ERR_STEPS, page_store_check(&store, 2));
    TEST_ASSERT_EQUAL(PAGE_ERR_POSITION, page_store_check(&store, 3));
    TEST_ASSERT_EQUAL(PAGE_OK, page_store_check(&store, 4));
    for (uint8_t number = 1; number <= 4; number++) {
        TEST_ASSERT_EQUAL(page_check(flash_of(number)), page_store_check(&store, number));
    }
}

static void test_refresh_follows_a_save(void)
{
    page_store_init(&store);
    TEST_ASSERT_FALSE(page_store_is_good(&store, 9));
    put(9, "New", 1, 0);
    page_store_refresh(&store, 9);
    TEST_ASSERT_TRUE(page_store_is_good(&store, 9));
    flash_of(9)[0] ^= 1;
    page_store_refresh(&store, 9);
    TEST_ASSERT_FALSE(page_store_is_good(&store, 9));
    TEST_ASSERT_FALSE(page_store_is_good(&store, 8));
}

static void test_erased_is_not_damaged(void)
{
    put(5, "", 0, 0);
    TEST_ASSERT_TRUE(page_store_is_erased(4));
    TEST_ASSERT_FALSE(page_store_is_erased(5));
    flash_of(6)[511] = 0xFE;
    TEST_ASSERT_FALSE(page_store_is_erased(6));
    page_store_init(&store);
    TEST_ASSERT_FALSE(page_store_is_damaged(&store, 4));
    TEST_ASSERT_FALSE(page_store_is_damaged(&store, 5));
    TEST_ASSERT_TRUE(page_store_is_damaged(&store, 6));
}

static void test_names_end_at_the_first_odd_byte(void)
{
    char name[PAGE_NAME_BYTES];
    put(1, "Thirteen char", 1, 0);
    page_store_name(1, name);
    TEST_ASSERT_EQUAL_STRING("Thirteen char", name);
    memcpy(flash_of(2), "Bow\0garbage..", 14);
    page_store_name(2, name);
    TEST_ASSERT_EQUAL_STRING("Bow", name);
    memcpy(flash_of(2), "Bow~\x7Fgarbage.", 14);
    page_store_name(2, name);
    TEST_ASSERT_EQUAL_STRING("Bow~", name);
    memcpy(flash_of(3), "ABCDEFGHIJKLMNOP", 16);
    page_store_name(3, name);
    TEST_ASSERT_EQUAL_STRING("ABCDEFGHIJKLM", name);
    page_store_name(4, name);
    TEST_ASSERT_EQUAL_STRING("", name);
}

static void test_find_by_name_skips_bad_pages_and_goes_on(void)
{
    put(3, "walk", 1, 0);
    put(5, "Walk", 1, 0);
    put(7, "WALK", 1, 0);
    put(8, "Walking", 1, 0);
    flash_of(3)[70] ^= 1;
    page_store_init(&store);
    TEST_ASSERT_EQUAL(5, page_store_find(&store, "wALK", 0));
    TEST_ASSERT_EQUAL(7, page_store_find(&store, "walk", 5));
    TEST_ASSERT_EQUAL(0, page_store_find(&store, "walk", 7));
    TEST_ASSERT_EQUAL(0, page_store_find(&store, "wal", 0));
}

static void test_find_by_code_takes_the_lowest_playable_good_page(void)
{
    put(10, "Damaged", 1, 4);
    flash_of(10)[70] ^= 1;
    put(11, "No steps", 0, 4);
    put(9, "Not played", 1, 4);
    page[PAGE_AT_PLAY_COUNT] = 0;   /* no action (PAGE_FORMAT.md) */
    page_seal(page);
    memcpy(flash_of(9), page, PAGE_BYTES);
    put(12, "This", 1, 4);
    put(13, "Later", 1, 4);
    page_store_init(&store);
    TEST_ASSERT_EQUAL(12, page_store_find_code(&store, 4));
    TEST_ASSERT_EQUAL(0, page_store_find_code(&store, 5));
}

static void test_trim_is_signed_and_unused_words_are_none(void)
{
    int16_t trim[PAGE_JOINTS];
    page_clear(page);
    page[PAGE_AT_STEPS] = 3;
    page_set_pos(page, 2, 1, 12);
    page_set_pos(page, 2, 2, (uint16_t)-5);
    page_set_pos(page, 2, 3, 0x4000);
    page_set_pos(page, 2, 4, 0x4200);
    page_seal(page);
    memcpy(flash_of(0), page, PAGE_BYTES);
    page_store_init(&store);
    TEST_ASSERT_TRUE(page_store_trim(&store, trim));
    TEST_ASSERT_EQUAL(12, trim[1]);
    TEST_ASSERT_EQUAL(-5, trim[2]);
    TEST_ASSERT_EQUAL(0, trim[3]);
    TEST_ASSERT_EQUAL(0, trim[4]);

    flash_of(0)[100] ^= 1;
    page_store_refresh(&store, 0);
    TEST_ASSERT_FALSE(page_store_trim(&store, trim));
    TEST_ASSERT_EQUAL(0, trim[1]);
}

static void test_source_serves_the_player(void)
{
    uint8_t bytes[4];
    put(16, "Far", 3, 0);
    page_store_init(&store);
    store.source.read(store.source.context, 16, PAGE_AT_STEPS, bytes, 1);
    TEST_ASSERT_EQUAL(3, bytes[0]);
    TEST_ASSERT_EQUAL(PAGE_OK, store.source.check(store.source.context, 16));
    TEST_ASSERT_EQUAL(PAGE_ERR_CHECKSUM, store.source.check(store.source.context, 17));
}
