/* SPDX-License-Identifier: MIT
 * Files instead of flash and EEPROM (hal/host/memory.c). The PC loses power at each write in turn. The current write
 * then becomes a random mixture of old and new bytes, and writes before it that are not yet durable may be lost. */
#include <setjmp.h>
#include <string.h>
#include "eeprom.h"
#include "fake_machine.h"
#include "host.h"
#include "journal.h"
#include "linker/memory_map.h"
#include "page_service.h"
#include "settings.h"
#include "target.h"
#include "unity.h"

#define PAGE_BYTES JOURNAL_TARGET_BYTES
#define SEEDS 20u
#define FEW_SEEDS 4u   /* for two saves, which have more writes to cut */
#define LAST_PAGE 255u

static uint8_t old[PAGE_BYTES], new[PAGE_BYTES];

void setUp(void)
{
    fake_machine_reset();
    fake_machine_cut(0, 0, NULL);
    for (uint16_t i = 0; i < PAGE_BYTES; i++) {
        old[i] = (uint8_t)(i * 7u);
        new[i] = (uint8_t)(i * 13u + 5u);
    }
}

/* Starts the program as firmware/host/main.c does. */
static journal_result_t begin(void)
{
    uint8_t work[PAGE_BYTES];
    host_recall("record", 6);
    TEST_ASSERT_EQUAL(PAGE_SERVICE_OURS, page_service_init(NULL));
    return journal_recover(work);
}

static void read_page(uint16_t page, uint8_t bytes[PAGE_BYTES])
{
    flash_read((uint32_t)TARGET_MOTION_START + (uint32_t)page * PAGE_BYTES, bytes, PAGE_BYTES);
}

static void test_a_new_robot_has_empty_pages(void)
{
    uint8_t bytes[PAGE_BYTES];
    TEST_ASSERT_EQUAL(JOURNAL_CLEAN, begin());
    read_page(LAST_PAGE, bytes);
    TEST_ASSERT_EACH_EQUAL_HEX8(0xFF, bytes, PAGE_BYTES);
}

static void test_what_is_saved_is_there_the_next_time(void)
{
    uint8_t bytes[PAGE_BYTES];
    (void)begin();
    TEST_ASSERT_EQUAL(FLASH_OK, journal_save(5, new));
    TEST_ASSERT_EQUAL(FLASH_OK, journal_save((uint8_t)LAST_PAGE, old));
    TEST_ASSERT_EQUAL(JOURNAL_CLEAN, begin());
    read_page(5, bytes);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(new, bytes, PAGE_BYTES);
    read_page(LAST_PAGE, bytes);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(old, bytes, PAGE_BYTES);
}

/* Cuts a save at write number `write`. Returns false if the save has fewer writes. */
static bool save_with_cut(uint32_t write, uint32_t seed)
{
    uint8_t bytes[PAGE_BYTES], neighbour[PAGE_BYTES];
    jmp_buf cut;
    setUp();
    (void)begin();
    TEST_ASSERT_EQUAL(FLASH_OK, journal_save(6, old));
    TEST_ASSERT_EQUAL(FLASH_OK, journal_save(5, old));
    fake_machine_cut(write, seed, &cut);
    if (setjmp(cut) == 0) {
        TEST_ASSERT_EQUAL(FLASH_OK, journal_save(5, new));
        fake_machine_cut(0, 0, NULL);
        return false;
    }
    TEST_ASSERT_NOT_EQUAL(JOURNAL_FAILED, begin());
    read_page(5, bytes);
    read_page(6, neighbour);
    TEST_ASSERT_TRUE_MESSAGE(memcmp(bytes, old, PAGE_BYTES) == 0 || memcmp(bytes, new, PAGE_BYTES) == 0, "old or new");
    TEST_ASSERT_EQUAL_HEX8_ARRAY(old, neighbour, PAGE_BYTES);
    TEST_ASSERT_EQUAL(FLASH_OK, journal_save(5, new));
    TEST_ASSERT_EQUAL(JOURNAL_CLEAN, begin());
    read_page(5, bytes);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(new, bytes, PAGE_BYTES);
    return true;
}

static void test_a_power_cut_at_any_write_leaves_the_old_page_or_the_new_one(void)
{
    for (uint32_t seed = 0; seed < SEEDS; seed++) {
        uint32_t write = 1;
        while (save_with_cut(write, seed)) {
            write++;
        }
        TEST_ASSERT_TRUE(write > 5);
    }
}

/* As in a motion: nothing is settled between the saves of 44 (and 55). */
static bool set_with_cut(uint32_t write, uint32_t seed, uint8_t last)
{
    static settings_store_t store;   /* static: kept across longjmp */
    jmp_buf cut;
    setUp();
    (void)begin();
    (void)settings_load(&store);
    store.settings.approach_deg_s = 33;
    settings_save_start(&store);
    settings_save_finish(&store);
    host_settle();
    fake_machine_cut(write, seed, &cut);
    if (setjmp(cut) == 0) {
        for (uint8_t approach_deg_s = 44; approach_deg_s <= last; approach_deg_s += 11u) {
            store.settings.approach_deg_s = approach_deg_s;
            settings_save_start(&store);
            settings_save_finish(&store);
        }
        fake_machine_cut(0, 0, NULL);
        return false;
    }
    (void)begin();
    (void)settings_load(&store);
    const uint8_t found = store.settings.approach_deg_s;
    TEST_ASSERT_TRUE_MESSAGE(found == 33 || found == 44 || found == last, "old or new");
    return true;
}

static void cut_at_each_write(uint32_t seeds, uint8_t last)
{
    for (uint32_t seed = 0; seed < seeds; seed++) {
        uint32_t write = 1;
        while (set_with_cut(write, seed, last)) {
            write++;
        }
        TEST_ASSERT_TRUE(write > 2);
    }
}

static void test_a_power_cut_at_any_byte_leaves_the_old_settings_or_the_new_ones(void)
{
    cut_at_each_write(SEEDS, 44);
}

static void test_a_power_cut_after_two_saves_in_one_motion_leaves_one_of_them(void)
{
    cut_at_each_write(FEW_SEEDS, 55);
}

static void test_what_is_no_page_is_not_written(void)
{
    uint8_t bytes[FLASH_PAGE_BYTES] = {0};
    (void)begin();
    TEST_ASSERT_EQUAL(FLASH_ERR_RANGE, flash_write(TARGET_FLASH_END / FLASH_PAGE_BYTES, bytes, sizeof bytes));
    TEST_ASSERT_EQUAL(FLASH_ERR_RANGE, flash_write(0, bytes, sizeof bytes));
    TEST_ASSERT_EQUAL(0, fake_machine_writes());
}
