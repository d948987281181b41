/* SPDX-License-Identifier: MIT
 * The page journal on a strict fake flash: its state after a save and after every power cut. */
#include "fake_flash.h"
#include "crc16.h"
#include "journal.h"
#include "memory_map.h"
#include "unity.h"

#include <stdio.h>
#include <string.h>

#define PAGE 120u
#define PAGE_ADDR (MEM_MOTION_START + 512u * PAGE)

static uint8_t old_page[512], new_page[512], work[JOURNAL_TARGET_BYTES];
static uint8_t before[MEM_BOOT_END];

static void fill(uint8_t *page, uint32_t seed)
{
    for (uint16_t i = 0; i < 512; i++) {
        seed = seed * 1103515245u + 12345u;
        page[i] = (uint8_t)(seed >> 16);
    }
}

static const uint8_t *target(uint8_t page)
{
    return fake_flash_bytes() + MEM_MOTION_START + 512u * page;
}

void setUp(void)
{
    fake_flash_reset();
    fill(old_page, 1);
    fill(new_page, 2);
    memcpy(fake_flash_bytes() + PAGE_ADDR, old_page, 512);
}

static void test_crc16_known_answer(void)
{
    TEST_ASSERT_EQUAL_HEX16(0x29B1, crc16_bytes(CRC16_START, "123456789", 9));
}

static void test_save_replaces_the_page_and_nothing_else(void)
{
    memcpy(before, fake_flash_bytes(), sizeof before);
    TEST_ASSERT_EQUAL(FLASH_OK, journal_save(PAGE, new_page));
    TEST_ASSERT_EQUAL_MEMORY(new_page, target(PAGE), 512);
    TEST_ASSERT_EQUAL_MEMORY(before, fake_flash_bytes(), MEM_JOURNAL_START);
    TEST_ASSERT_EQUAL_MEMORY(before + MEM_JOURNAL_END, fake_flash_bytes() + MEM_JOURNAL_END, PAGE_ADDR - MEM_JOURNAL_END);
    TEST_ASSERT_EQUAL_MEMORY(before + PAGE_ADDR + 512, fake_flash_bytes() + PAGE_ADDR + 512, MEM_BOOT_END - PAGE_ADDR - 512);
    TEST_ASSERT_EQUAL(JOURNAL_CLEAN, journal_recover(work));
}

static void test_save_takes_at_most_eleven_operations_of_4_5_ms(void)
{
    fake_flash_cut(0, FAKE_FLASH_BEFORE, 0, NULL);
    TEST_ASSERT_EQUAL(FLASH_OK, journal_save(PAGE, new_page));
    TEST_ASSERT_EQUAL_UINT32(11, fake_flash_ops());
}

static void test_save_of_equal_contents_leaves_the_page_alone(void)
{
    TEST_ASSERT_EQUAL(FLASH_OK, journal_save(PAGE, old_page));
    TEST_ASSERT_EQUAL_UINT32(0, fake_flash_wear(PAGE_ADDR / 256) + fake_flash_wear(PAGE_ADDR / 256 + 1));
    TEST_ASSERT_FALSE(journal_is_pending());
}

static void test_save_skips_an_equal_half(void)
{
    memcpy(new_page + 256, old_page + 256, 256);
    TEST_ASSERT_EQUAL(FLASH_OK, journal_save(PAGE, new_page));
    TEST_ASSERT_EQUAL_MEMORY(new_page, target(PAGE), 512);
    TEST_ASSERT_EQUAL_UINT32(1, fake_flash_wear(PAGE_ADDR / 256));
    TEST_ASSERT_EQUAL_UINT32(0, fake_flash_wear(PAGE_ADDR / 256 + 1));
}

static void test_save_beyond_the_last_page_is_refused(void)
{
    TEST_ASSERT_EQUAL(FLASH_ERR_RANGE, journal_save(128, new_page));
    TEST_ASSERT_EQUAL_UINT32(0, fake_flash_ops());
}

static void test_first_and_last_page_can_be_saved(void)
{
    TEST_ASSERT_EQUAL(FLASH_OK, journal_save(0, new_page));
    TEST_ASSERT_EQUAL(FLASH_OK, journal_save(127, old_page));
    TEST_ASSERT_EQUAL_MEMORY(new_page, target(0), 512);
    TEST_ASSERT_EQUAL_MEMORY(old_page, target(127), 512);
}

static void test_wear_is_even_over_the_slots(void)
{
    for (uint32_t i = 0; i < 1000; i++) {
        fill(new_page, i);
        TEST_ASSERT_EQUAL(FLASH_OK, journal_save((uint8_t)(i % 128), new_page));
    }
    for (uint16_t page = 0; page < JOURNAL_SLOTS * JOURNAL_SLOT_PAGES; page++) {
        TEST_ASSERT_UINT32_WITHIN(1, 1000 / JOURNAL_SLOTS, fake_flash_wear((uint16_t)(MEM_JOURNAL_START / 256 + page)));
    }
}

/* Either half of the page does not take the data: the save says that it is pending, and it is. */
static void test_a_page_that_does_not_take_the_data_is_reported_as_pending(void)
{
    static const uint16_t bad[] = {PAGE_ADDR / 256, PAGE_ADDR / 256 + 1};
    for (uint8_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        setUp();
        fake_flash_break(bad[i], 2);
        TEST_ASSERT_EQUAL(JOURNAL_ERR_PENDING, journal_save(PAGE, new_page));
        TEST_ASSERT_TRUE(journal_is_pending());
        TEST_ASSERT_EQUAL(JOURNAL_RESTORED, journal_recover(work));
        TEST_ASSERT_EQUAL_MEMORY(new_page, target(PAGE), 512);
    }
}

/* No slot takes the record: the old page stays, also behind the next start. */
static void test_a_save_that_failed_before_its_record_is_dropped(void)
{
    fake_flash_break_all(MEM_JOURNAL_START / 256, MEM_JOURNAL_END / 256);
    TEST_ASSERT_EQUAL(FLASH_ERR_VERIFY, journal_save(PAGE, new_page));
    TEST_ASSERT_FALSE(journal_is_pending());
    TEST_ASSERT_EQUAL(JOURNAL_CLEAN, journal_recover(work));
    TEST_ASSERT_EQUAL_MEMORY(old_page, target(PAGE), 512);
}

static void test_a_slot_that_is_worn_out_blocks_no_save(void)
{
    for (uint16_t worn = 0; worn < JOURNAL_SLOT_PAGES; worn++) {
        setUp();
        fake_flash_break((uint16_t)(MEM_JOURNAL_START / 256 + 3 * JOURNAL_SLOT_PAGES + worn), UINT8_MAX);
        for (uint32_t i = 0; i < 4 * JOURNAL_SLOTS; i++) {
            fill(new_page, i);
            TEST_ASSERT_EQUAL(FLASH_OK, journal_save(PAGE, new_page));
            TEST_ASSERT_EQUAL_MEMORY(new_page, target(PAGE), 512);
            TEST_ASSERT_FALSE(journal_is_pending());
        }
    }
}

/* Cuts a save at operation `op`. Returns true if the cut came before the end of the save. */
static bool save_is_cut(uint32_t op, fake_flash_phase_t phase, uint32_t seed)
{
    jmp_buf cut;
    fake_flash_cut(op, phase, seed, &cut);
    if (setjmp(cut) != 0) {
        return true;
    }
    TEST_ASSERT_EQUAL(FLASH_OK, journal_save(PAGE, new_page));
    fake_flash_cut(0, phase, 0, NULL);
    return false;
}

static bool recovery_is_cut(uint32_t op, fake_flash_phase_t phase, uint32_t seed)
{
    jmp_buf cut;
    fake_flash_cut(op, phase, seed, &cut);
    if (setjmp(cut) != 0) {
        return true;
    }
    journal_result_t result = journal_recover(work);
    fake_flash_cut(0, phase, 0, NULL);
    TEST_ASSERT_TRUE(result == JOURNAL_CLEAN || result == JOURNAL_RESTORED);
    return false;
}

static bool is_old_or_new(void)
{
    return memcmp(target(PAGE), old_page, 512) == 0 || memcmp(target(PAGE), new_page, 512) == 0;
}

/* The first slot is worn out: the save takes the second one. */
static void test_power_cut_beside_a_worn_slot_leaves_the_old_page_or_the_new_one(void)
{
    for (uint32_t op = 1, cuts = 0;; op++) {
        for (int phase = FAKE_FLASH_BEFORE; phase <= FAKE_FLASH_AFTER; phase++) {
            setUp();
            fake_flash_break((uint16_t)(MEM_JOURNAL_START / 256 + op % JOURNAL_SLOT_PAGES), UINT8_MAX);
            if (!save_is_cut(op, (fake_flash_phase_t)phase, op)) {
                TEST_ASSERT_GREATER_THAN_UINT32(3 * 11, cuts);
                return;
            }
            cuts++;
            TEST_ASSERT_FALSE(recovery_is_cut(0, FAKE_FLASH_BEFORE, 0));
            TEST_ASSERT_TRUE(is_old_or_new());
            TEST_ASSERT_EQUAL(FLASH_OK, journal_save(PAGE, new_page));
            TEST_ASSERT_EQUAL_MEMORY(new_page, target(PAGE), 512);
        }
    }
}

/* The page is old or new, nothing else has changed, and the next save works. */
static void check_after_cut(void)
{
    TEST_ASSERT_TRUE_MESSAGE(is_old_or_new(), "neither the old page nor the new one");
    TEST_ASSERT_FALSE(journal_is_pending());
    TEST_ASSERT_EQUAL(JOURNAL_CLEAN, journal_recover(work));
    for (uint32_t addr = 0; addr < MEM_BOOT_END; addr += 256) {
        bool journal = addr >= MEM_JOURNAL_START && addr < MEM_JOURNAL_END;
        bool page = addr >= PAGE_ADDR && addr < PAGE_ADDR + 512;
        if (!journal && !page) {
            TEST_ASSERT_EQUAL_MEMORY(before + addr, fake_flash_bytes() + addr, 256);
        }
    }
    uint8_t third[512];
    fill(third, 3);
    TEST_ASSERT_EQUAL(FLASH_OK, journal_save(PAGE, third));
    TEST_ASSERT_EQUAL_MEMORY(third, target(PAGE), 512);
    TEST_ASSERT_EQUAL(JOURNAL_CLEAN, journal_recover(work));
    TEST_ASSERT_EQUAL_MEMORY(third, target(PAGE), 512);
}

/* Every starting slot, every operation of the save, every phase; then every operation of the recovery. */
static void test_power_cut_anywhere_leaves_the_old_page_or_the_new_one(void)
{
    uint32_t cuts = 0, recovery_cuts = 0;
    for (uint32_t history = 0; history < 12; history++) {
        setUp();
        for (uint32_t i = 0; i < history; i++) {
            uint8_t other[512];
            fill(other, 100 + i);
            TEST_ASSERT_EQUAL(FLASH_OK, journal_save((uint8_t)i, other));
        }
        memcpy(before, fake_flash_bytes(), sizeof before);
        for (int phase = FAKE_FLASH_BEFORE; phase <= FAKE_FLASH_AFTER; phase++) {
            for (uint32_t op = 1;; op++) {
                memcpy(fake_flash_bytes(), before, sizeof before);
                if (!save_is_cut(op, (fake_flash_phase_t)phase, op + history)) {
                    break;
                }
                cuts++;
                TEST_ASSERT_TRUE(journal_is_pending() || is_old_or_new());
                static uint8_t torn[MEM_BOOT_END];
                memcpy(torn, fake_flash_bytes(), sizeof torn);
                for (uint32_t again = 1;; again++) {
                    memcpy(fake_flash_bytes(), torn, sizeof torn);
                    bool was_cut = recovery_is_cut(again, (fake_flash_phase_t)((uint32_t)phase % 3u), again * 7 + op);
                    recovery_cuts += was_cut;
                    if (was_cut) {
                        (void)recovery_is_cut(1, FAKE_FLASH_TORN, op);
                        TEST_ASSERT_FALSE(recovery_is_cut(0, FAKE_FLASH_BEFORE, 0));
                    }
                    check_after_cut();
                    if (!was_cut) {
                        break;
                    }
                }
            }
        }
    }
    printf("journal: %u cuts of a save, %u cuts of a recovery, each cut once more\n", (unsigned)cuts,
           (unsigned)recovery_cuts);
    TEST_ASSERT_EQUAL_UINT32(12 * 3 * 11, cuts);
}

static void test_the_sequence_wraps(void)
{
    for (uint32_t i = 0; i < 66000; i++) {
        fill(new_page, i);
        TEST_ASSERT_EQUAL(FLASH_OK, journal_save((uint8_t)(i % 128), new_page));
    }
    TEST_ASSERT_EQUAL_MEMORY(new_page, target(65999 % 128), 512);
    TEST_ASSERT_EQUAL(JOURNAL_CLEAN, journal_recover(work));
    TEST_ASSERT_EQUAL_MEMORY(new_page, target(65999 % 128), 512);
    TEST_ASSERT_TRUE(save_is_cut(7, FAKE_FLASH_BEFORE, 1)); /* record complete, target page unchanged */
    TEST_ASSERT_EQUAL(JOURNAL_RESTORED, journal_recover(work));
    TEST_ASSERT_EQUAL_MEMORY(new_page, target(PAGE), 512);
}

static void test_a_download_can_void_a_pending_page(void)
{
    TEST_ASSERT_TRUE(save_is_cut(7, FAKE_FLASH_BEFORE, 1)); /* record complete, target page unchanged */
    TEST_ASSERT_TRUE(journal_is_pending());
    TEST_ASSERT_EQUAL(FLASH_OK, journal_void());
    TEST_ASSERT_FALSE(journal_is_pending());
    TEST_ASSERT_EQUAL(JOURNAL_CLEAN, journal_recover(work));
    TEST_ASSERT_EQUAL_MEMORY(old_page, target(PAGE), 512);
}

static void test_rotten_slot_data_is_not_restored(void)
{
    TEST_ASSERT_TRUE(save_is_cut(7, FAKE_FLASH_BEFORE, 1));
    fake_flash_bytes()[MEM_JOURNAL_START + 5] ^= 1;
    TEST_ASSERT_EQUAL(JOURNAL_LOST, journal_recover(work));
    TEST_ASSERT_EQUAL_MEMORY(old_page, target(PAGE), 512);
    TEST_ASSERT_EQUAL(JOURNAL_CLEAN, journal_recover(work));
}

/* Page 128 would be the boot section. */
static void test_a_record_of_a_page_beyond_the_last_counts_as_none(void)
{
    TEST_ASSERT_TRUE(save_is_cut(7, FAKE_FLASH_BEFORE, 1));
    uint8_t *record = fake_flash_bytes() + MEM_JOURNAL_START + 512;
    record[4] = 128;
    uint16_t crc = crc16_bytes(CRC16_START, record, 8);
    record[8] = (uint8_t)crc;
    record[9] = (uint8_t)(crc >> 8);
    fake_flash_cut(0, FAKE_FLASH_BEFORE, 0, NULL);
    TEST_ASSERT_EQUAL(JOURNAL_CLEAN, journal_recover(work));
    TEST_ASSERT_EQUAL_UINT32(0, fake_flash_ops());
}

static void test_a_full_of_noise_area_is_an_empty_journal(void)
{
    uint8_t *area = fake_flash_bytes() + MEM_JOURNAL_START;
    for (uint16_t i = 0; i < 8192; i++) {
        area[i] = (uint8_t)(i * 37u);
    }
    TEST_ASSERT_EQUAL(JOURNAL_CLEAN, journal_recover(work));
    TEST_ASSERT_EQUAL(FLASH_OK, journal_save(PAGE, new_page));
    TEST_ASSERT_EQUAL_MEMORY(new_page, target(PAGE), 512);
}

/* The layout of journal.h, byte by byte, as a tool would read it. */
static void test_the_record_is_laid_out_as_documented(void)
{
    TEST_ASSERT_EQUAL(FLASH_OK, journal_save(PAGE, new_page));
    const uint8_t *slot = fake_flash_bytes() + MEM_JOURNAL_START;
    const uint8_t *record = slot + 512;
    uint16_t crc = crc16_bytes(CRC16_START, new_page, 512), own = crc16_bytes(CRC16_START, record, 8);
    TEST_ASSERT_EQUAL_MEMORY(new_page, slot, 512);
    const uint8_t expected[12] = {'M', 'J', record[2], record[3], PAGE, 1, (uint8_t)crc, (uint8_t)(crc >> 8),
                                  (uint8_t)own, (uint8_t)(own >> 8), 0, 0};
    TEST_ASSERT_EQUAL_MEMORY(expected, record, 12);
    TEST_ASSERT_EQUAL_HEX8(0xFF, record[12]);
}
