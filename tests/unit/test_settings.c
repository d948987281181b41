/* SPDX-License-Identifier: MIT
 * Settings in EEPROM: defaults, several copies, worn-out bytes, and a power cut at every write. */
#include "crc16.h"
#include "eeprom.h"
#include "fake_eeprom.h"
#include "memory_map.h"
#include "settings.h"
#include "unity.h"

#include <setjmp.h>
#include <stdio.h>
#include <string.h>

#define COPIES 4u

static settings_t settings;
static settings_store_t store;

void setUp(void)
{
    fake_eeprom_reset();
    memset(&store, 0xEE, sizeof store);
    settings_defaults(&settings);
}

static void save(settings_store_t *to, const settings_t *what)
{
    to->settings = *what;
    settings_save_start(to);
    settings_save_finish(to);
}

static settings_item_t item(const char *name)
{
    settings_item_t found;
    for (uint8_t i = 0; i < SETTINGS_ITEMS; i++) {
        settings_item(i, &found);
        if (strcmp(found.name, name) == 0) {
            return found;
        }
    }
    TEST_FAIL_MESSAGE(name);
    return found;
}

static void test_crc_of_the_record_has_the_known_answer(void)
{
    TEST_ASSERT_EQUAL_HEX16(0x29B1, crc16_bytes(CRC16_START, "123456789", 9));
}

static void test_defaults_are_the_documented_ones(void)
{
    TEST_ASSERT_EQUAL(0, settings.law);
    TEST_ASSERT_EQUAL(0, settings.remote_mode);
    TEST_ASSERT_EQUAL(60, settings.approach_deg_s);
    TEST_ASSERT_EQUAL(SETTINGS_FAULT_HOLD, settings.fault_rule);
    TEST_ASSERT_EQUAL(2, settings.pair[1]);
    TEST_ASSERT_EQUAL(1, settings.pair[2]);
    TEST_ASSERT_EQUAL(18, settings.pair[17]);
    TEST_ASSERT_EQUAL(17, settings.pair[18]);
    TEST_ASSERT_EQUAL(SETTINGS_NO_PARTNER, settings.pair[0]);
    TEST_ASSERT_EQUAL(SETTINGS_NO_PARTNER, settings.pair[19]);
}

static void test_erased_eeprom_gives_defaults(void)
{
    TEST_ASSERT_EQUAL(SETTINGS_EMPTY, settings_load(&store));
    TEST_ASSERT_EQUAL_MEMORY(&settings, &store.settings, sizeof settings);
}

static void test_garbage_gives_defaults_and_says_so(void)
{
    for (uint16_t i = 0; i < EEPROM_BYTES; i++) {
        fake_eeprom_bytes()[i] = (uint8_t)(i * 7u);
    }
    TEST_ASSERT_EQUAL(SETTINGS_DAMAGED, settings_load(&store));
    TEST_ASSERT_EQUAL_MEMORY(&settings, &store.settings, sizeof settings);
}

static void test_saved_settings_come_back(void)
{
    (void)settings_load(&store);
    for (uint8_t i = 0; i < 5; i++) {
        settings.approach_deg_s = (uint8_t)(10u + i);
        save(&store, &settings);
        settings_store_t again;
        TEST_ASSERT_EQUAL(SETTINGS_OK, settings_load(&again));
        TEST_ASSERT_EQUAL_MEMORY(&settings, &again.settings, sizeof settings);
    }
}

static void test_sequence_goes_on_over_its_wrap(void)
{
    (void)settings_load(&store);
    for (uint16_t i = 0; i < 600; i++) {
        settings.battery_low_dv = (uint8_t)(i % 200u);
        save(&store, &settings);
        (void)settings_load(&store);
        TEST_ASSERT_EQUAL(i % 200u, store.settings.battery_low_dv);
    }
}

static void test_only_the_settings_area_is_written(void)
{
    (void)settings_load(&store);
    save(&store, &settings);
    save(&store, &settings);
    for (uint16_t i = MEM_EE_SETTINGS_END; i < EEPROM_BYTES; i++) {
        TEST_ASSERT_EQUAL(0, fake_eeprom_wear(i));
    }
    TEST_ASSERT_TRUE(fake_eeprom_writes() > 0);
}

static void test_damaged_newer_copy_falls_back_to_the_older(void)
{
    (void)settings_load(&store);
    settings.law = 0;
    save(&store, &settings);
    settings.law = 1;
    save(&store, &settings);
    uint16_t newer = (uint16_t)(MEM_EE_SETTINGS + 64u * store.newest);
    fake_eeprom_bytes()[newer + 10u] ^= 1u;
    TEST_ASSERT_EQUAL(SETTINGS_OK, settings_load(&store));
    TEST_ASSERT_EQUAL(0, store.settings.law);
}

static void test_field_out_of_range_is_damage(void)
{
    (void)settings_load(&store);
    settings.law = 9;
    save(&store, &settings);
    TEST_ASSERT_EQUAL(SETTINGS_DAMAGED, settings_load(&store));
    TEST_ASSERT_EQUAL(0, store.settings.law);
    fake_eeprom_reset();
    (void)settings_load(&store);
    settings.law = 1;
    settings.pair[3] = SETTINGS_JOINTS;
    save(&store, &settings);
    TEST_ASSERT_EQUAL(SETTINGS_DAMAGED, settings_load(&store));
    TEST_ASSERT_EQUAL(4, store.settings.pair[3]);
}

/* Written by version 1.0.0: 41 bytes of settings. The CRC is Python's binascii.crc_hqx(all bytes before it, 0xFFFF). */
static void test_record_of_an_older_program_keeps_its_settings(void)
{
    static const uint8_t written[] = {
        'S', 1, 5, 41, 1, 1, 77, 2, 88, 66, 1, 0, 0, 0,
        0xFF, 2, 1, 4, 3, 6, 5, 8, 7, 10, 9, 12, 11, 14, 13, 16, 15, 18, 17,
        0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0x2E, 0xFA
    };
    TEST_ASSERT_EQUAL(47, sizeof written);
    memcpy(fake_eeprom_bytes() + MEM_EE_SETTINGS, written, sizeof written);
    TEST_ASSERT_EQUAL(SETTINGS_OK, settings_load(&store));
    TEST_ASSERT_EQUAL(1, store.settings.law);
    TEST_ASSERT_EQUAL(77, store.settings.approach_deg_s);
    TEST_ASSERT_EQUAL(0, store.settings.talk);
    TEST_ASSERT_EQUAL(17, store.settings.pair[18]);
    TEST_ASSERT_EQUAL(1, store.settings.centre_page);   /* defaults of settings that it did not have */
    TEST_ASSERT_EQUAL(10, store.settings.drive_ds);
}

/* A newer program may have more settings, up to what fits into the place of a record. A longer record is none. */
static void test_record_of_a_newer_program_gives_the_settings_that_are_known(void)
{
    uint8_t *record = fake_eeprom_bytes() + MEM_EE_SETTINGS;
    const uint8_t most = 64u - 4u - 2u;
    const uint8_t head[] = {'S', 1, 5, most};
    memset(record, 0, 64);
    memcpy(record, head, sizeof head);
    settings.law = 1;
    memcpy(record + sizeof head, &settings, sizeof settings);
    const uint16_t crc = crc16_bytes(CRC16_START, record, 62);
    record[62] = (uint8_t)crc;
    record[63] = (uint8_t)(crc >> 8);
    TEST_ASSERT_EQUAL(SETTINGS_OK, settings_load(&store));
    TEST_ASSERT_EQUAL_MEMORY(&settings, &store.settings, sizeof settings);
    record[3] = (uint8_t)(most + 1u);
    TEST_ASSERT_EQUAL(SETTINGS_DAMAGED, settings_load(&store));
    record[3] = (uint8_t)(most + 2u);
    TEST_ASSERT_EQUAL(SETTINGS_DAMAGED, settings_load(&store));
}

static void test_saving_in_steps_never_blocks_and_ends(void)
{
    uint16_t calls = 0;
    (void)settings_load(&store);
    fake_eeprom_set_busy_calls(3);
    settings_save_start(&store);
    while (store.left != 0) {
        const uint32_t before = fake_eeprom_writes();
        settings_save_poll(&store);
        TEST_ASSERT_TRUE(fake_eeprom_writes() - before <= 1);
        TEST_ASSERT_TRUE(++calls < 1000);
    }
    TEST_ASSERT_EQUAL(SETTINGS_OK, settings_load(&store));
}

/* Saves `old`, then cuts a second save at its n-th EEPROM write with a given torn byte. Returns whether the cut
 * happened. */
static bool cut_save(uint32_t operation, int torn, settings_t *old, settings_t *fresh)
{
    jmp_buf power;
    fake_eeprom_reset();
    settings_defaults(old);
    (void)settings_load(&store);
    old->approach_deg_s = 33;
    for (uint8_t i = 0; i < COPIES; i++) {
        save(&store, old);
    }
    *fresh = *old;
    fresh->law = 1;
    fresh->approach_deg_s = 77;
    fresh->pair[5] = SETTINGS_NO_PARTNER;
    if (setjmp(power) == 0) {
        fake_eeprom_cut(operation, torn, &power);
        save(&store, fresh);
        fake_eeprom_cut(0, 0, &power);
        return false;
    }
    return true;
}

static void test_power_cut_at_every_write_leaves_old_or_new(void)
{
    static const int torn_values[] = { -1, 0x00, 0xFF, 0x5A, 'S', 256 };
    settings_t old, fresh;
    uint16_t cuts = 0, olds = 0, news = 0;
    for (uint8_t t = 0; t < sizeof torn_values / sizeof *torn_values; t++) {
        for (uint32_t operation = 1; cut_save(operation, torn_values[t], &old, &fresh); operation++) {
            settings_store_t again;
            TEST_ASSERT_EQUAL(SETTINGS_OK, settings_load(&again));
            bool is_old = memcmp(&again.settings, &old, sizeof old) == 0;
            bool is_new = memcmp(&again.settings, &fresh, sizeof fresh) == 0;
            TEST_ASSERT_TRUE(is_old || is_new);
            cuts++;
            olds = (uint16_t)(olds + is_old);
            news = (uint16_t)(news + is_new);
            save(&again, &fresh);
            TEST_ASSERT_EQUAL(SETTINGS_OK, settings_load(&again));
            TEST_ASSERT_EQUAL_MEMORY(&fresh, &again.settings, sizeof fresh);
        }
    }
    TEST_ASSERT_TRUE(olds > 10 && news > 0);
    printf("settings: %u power cuts, %u old, %u new, 0 other\n", cuts, olds, news);
}

/* Changes the settings again when the last byte of a save has begun, and cuts at the n-th EEPROM write from there on. */
static bool cut_save_after_save(uint32_t operation, const settings_t *first, const settings_t *second)
{
    jmp_buf power;
    fake_eeprom_reset();
    (void)settings_load(&store);
    save(&store, &settings);
    store.settings = *first;
    settings_save_start(&store);
    while (fake_eeprom_bytes()[MEM_EE_SETTINGS + 64u] != 'S') {
        settings_save_poll(&store);
    }
    if (setjmp(power) == 0) {
        fake_eeprom_cut(operation, -1, &power);
        save(&store, second);
        fake_eeprom_cut(0, 0, &power);
        return false;
    }
    return true;
}

static void test_power_cut_after_a_save_that_followed_at_once_keeps_one_of_them(void)
{
    settings_t first = settings, second = settings;
    first.approach_deg_s = 33;
    second.approach_deg_s = 77;
    for (uint32_t operation = 1; cut_save_after_save(operation, &first, &second); operation++) {
        TEST_ASSERT_EQUAL(SETTINGS_OK, settings_load(&store));
        TEST_ASSERT_TRUE(store.settings.approach_deg_s == 33 || store.settings.approach_deg_s == 77);
    }
    TEST_ASSERT_EQUAL(SETTINGS_OK, settings_load(&store));
    TEST_ASSERT_EQUAL_MEMORY(&second, &store.settings, sizeof second);
}

/* Cuts a first save at its n-th EEPROM write. Returns whether the cut happened. */
static bool cut_first_save(uint32_t operation, int torn)
{
    jmp_buf power;
    fake_eeprom_reset();
    (void)settings_load(&store);
    if (setjmp(power) == 0) {
        fake_eeprom_cut(operation, torn, &power);
        save(&store, &store.settings);
        fake_eeprom_cut(0, 0, &power);
        return false;
    }
    return true;
}

/* There were no settings to lose. */
static void test_first_save_that_is_cut_off_is_no_damage(void)
{
    static const int torn_values[] = { -1, 0xFF };
    for (uint8_t t = 0; t < sizeof torn_values / sizeof *torn_values; t++) {
        for (uint32_t operation = 1; cut_first_save(operation, torn_values[t]); operation++) {
            TEST_ASSERT_NOT_EQUAL(SETTINGS_DAMAGED, settings_load(&store));
            TEST_ASSERT_EQUAL_MEMORY(&settings, &store.settings, sizeof settings);
        }
    }
}

static void test_copy_under_way_has_no_magic(void)
{
    settings_t old, fresh;
    TEST_ASSERT_TRUE(cut_save(2, -1, &old, &fresh));
    const uint8_t *copies = fake_eeprom_bytes() + MEM_EE_SETTINGS;
    TEST_ASSERT_NOT_EQUAL('S', copies[0]);
    TEST_ASSERT_EQUAL('S', copies[64]);
}

/* ---- worn-out bytes ---- */

/* Each copy has been written when `at` wears out; the next save would write copy 0. */
static void wear_out(uint16_t at)
{
    fake_eeprom_reset();
    (void)settings_load(&store);
    for (uint8_t i = 0; i < COPIES; i++) {
        settings.approach_deg_s = (uint8_t)(200u + i);
        save(&store, &settings);
    }
    fake_eeprom_wear_out(MEM_EE_SETTINGS + at);
}

static void test_byte_that_is_worn_out_loses_no_settings(void)
{
    for (uint16_t at = 0; at < COPIES * 64u; at++) {
        wear_out(at);
        for (uint8_t value = 0; value < 150; value++) {   /* an old copy must not seem new when the sequence has wrapped */
            settings.approach_deg_s = value;
            settings.pair[0] = (uint8_t)(value % SETTINGS_JOINTS);
            save(&store, &settings);
            TEST_ASSERT_FALSE(store.failed);
            TEST_ASSERT_EQUAL(SETTINGS_OK, settings_load(&store));
            TEST_ASSERT_EQUAL_MEMORY_MESSAGE(&settings, &store.settings, sizeof settings, "after the start");
        }
    }
}

/* Cuts a save that meets a worn-out byte at its n-th EEPROM write. Returns whether the cut happened. */
static bool cut_worn_save(uint32_t operation, const settings_t *fresh)
{
    jmp_buf power;
    wear_out(6);
    if (setjmp(power) == 0) {
        fake_eeprom_cut(operation, -1, &power);
        save(&store, fresh);
        fake_eeprom_cut(0, 0, &power);
        return false;
    }
    return true;
}

static void test_power_cut_over_a_byte_that_is_worn_out_leaves_old_or_new(void)
{
    settings_t fresh = settings;
    fresh.approach_deg_s = 33;
    for (uint32_t operation = 1; cut_worn_save(operation, &fresh); operation++) {
        TEST_ASSERT_EQUAL(SETTINGS_OK, settings_load(&store));
        TEST_ASSERT_TRUE(store.settings.approach_deg_s == 33 || store.settings.approach_deg_s == settings.approach_deg_s);
    }
    TEST_ASSERT_EQUAL(SETTINGS_OK, settings_load(&store));
    TEST_ASSERT_EQUAL_MEMORY(&fresh, &store.settings, sizeof fresh);
}

/* The newest copy is spared, so that a start finds it. */
static void test_save_without_a_sound_place_is_reported_and_keeps_the_old_settings(void)
{
    wear_out(6);
    fake_eeprom_wear_out(MEM_EE_SETTINGS + 64u + 2u);
    fake_eeprom_wear_out(MEM_EE_SETTINGS + 2u * 64u + 4u + sizeof settings);
    const settings_t old = settings;
    for (uint8_t i = 0; i < 3; i++) {
        settings.approach_deg_s = (uint8_t)(100u + i);
        save(&store, &settings);
        TEST_ASSERT_TRUE(store.failed);
        TEST_ASSERT_EQUAL(SETTINGS_OK, settings_load(&store));
        TEST_ASSERT_EQUAL_MEMORY(&old, &store.settings, sizeof old);
    }
}

static void test_items_are_set_within_their_range_only(void)
{
    settings_item_t approach = item("approach");
    TEST_ASSERT_TRUE(settings_set(&settings, &approach, 240));
    TEST_ASSERT_EQUAL(240, settings.approach_deg_s);
    TEST_ASSERT_FALSE(settings_set(&settings, &approach, 241));
    TEST_ASSERT_FALSE(settings_set(&settings, &approach, 0x100 + 60));
    TEST_ASSERT_EQUAL(240, settings.approach_deg_s);
    settings_item_t law = item("law");
    TEST_ASSERT_FALSE(settings_set(&settings, &law, 2));
    TEST_ASSERT_EQUAL(240, settings_value(&settings, &approach));
}

static void test_pairs_stay_symmetric(void)
{
    settings_pair(&settings, 1, 4);
    TEST_ASSERT_EQUAL(4, settings.pair[1]);
    TEST_ASSERT_EQUAL(1, settings.pair[4]);
    TEST_ASSERT_EQUAL(SETTINGS_NO_PARTNER, settings.pair[2]);
    TEST_ASSERT_EQUAL(SETTINGS_NO_PARTNER, settings.pair[3]);
    settings_pair(&settings, 1, 1);
    TEST_ASSERT_EQUAL(SETTINGS_NO_PARTNER, settings.pair[1]);
    TEST_ASSERT_EQUAL(SETTINGS_NO_PARTNER, settings.pair[4]);
}
