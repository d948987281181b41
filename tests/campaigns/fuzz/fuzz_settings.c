/* SPDX-License-Identifier: MIT
 * Settings from an EEPROM with any contents. Input: option byte (bit 0, 1: the copy gets its CRC), then the EEPROM. */
#include "fuzz.h"
#include "crc16.h"
#include "eeprom.h"
#include "fake_eeprom.h"
#include "memory_map.h"
#include "settings.h"
#include "trap.h"

#include <string.h>

#define COPY_BYTES 64u
#define RECORD_BYTES (4u + sizeof(settings_t) + 2u)

static void seal(uint8_t *record)
{
    const uint16_t crc = crc16_bytes(CRC16_START, record, (uint16_t)(RECORD_BYTES - 2));
    record[RECORD_BYTES - 2] = (uint8_t)crc;
    record[RECORD_BYTES - 1] = (uint8_t)(crc >> 8);
}

/* Ranges of settings.h. */
static void must_be_sound(const settings_t *settings)
{
    ASSERT(settings->law <= 1 && settings->remote_mode <= SETTINGS_REMOTE_DRIVE);
    ASSERT(settings->approach_deg_s <= 240 && settings->fault_rule <= 2);
    ASSERT(settings->battery_low_dv <= 200 && settings->hot_degrees <= 100 && settings->neutral <= 1);
    ASSERT(settings->flow <= 1 && settings->fast_line <= 1 && settings->talk <= 1);
    ASSERT(settings->centre_page <= 127 && settings->drive_ds <= 250);
    for (unsigned i = 0; i < SETTINGS_JOINTS; i++) {
        ASSERT(settings->pair[i] < SETTINGS_JOINTS || settings->pair[i] == SETTINGS_NO_PARTNER);
    }
}

static void change(settings_t *settings, fuzz_t *fuzz)
{
    settings_item_t item;
    settings_item(fuzz_byte(fuzz) % SETTINGS_ITEMS, &item);
    const uint8_t before = settings_value(settings, &item);
    const uint16_t value = fuzz_word(fuzz);
    const bool done = settings_set(settings, &item, value);
    ASSERT(settings_value(settings, &item) == (done ? value : before));
    const uint8_t a = fuzz_byte(fuzz) % SETTINGS_JOINTS, b = fuzz_byte(fuzz) % SETTINGS_JOINTS;
    settings_pair(settings, a, b);
    ASSERT(a == b ? settings->pair[a] == SETTINGS_NO_PARTNER : settings->pair[a] == b && settings->pair[b] == a);
    must_be_sound(settings);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_t fuzz = {data, data + size};
    settings_store_t store;
    settings_t loaded, again;
    fake_eeprom_reset();
    uint8_t *bytes = fake_eeprom_bytes() + MEM_EE_SETTINGS;
    const uint8_t options = fuzz_byte(&fuzz);
    fuzz_bytes(&fuzz, bytes, 2 * COPY_BYTES);
    for (unsigned copy = 0; copy < 2; copy++) {
        if ((options & 1u << copy) != 0) {
            seal(bytes + copy * COPY_BYTES);
        }
    }
    const settings_status_t status = settings_load(&store, &loaded);
    ASSERT(status != SETTINGS_EMPTY || (bytes[0] == 0xFF && bytes[COPY_BYTES] == 0xFF));
    must_be_sound(&loaded);
    if (status != SETTINGS_OK) {
        settings_defaults(&again);
        ASSERT(memcmp(&again, &loaded, sizeof again) == 0);
    }
    for (unsigned i = 0; i < 3; i++) {
        change(&loaded, &fuzz);
    }
    settings_save_start(&store);
    settings_save_finish(&store, &loaded);
    ASSERT(settings_load(&store, &again) == SETTINGS_OK && memcmp(&again, &loaded, sizeof again) == 0);
    for (unsigned i = 2 * COPY_BYTES; i < EEPROM_BYTES - MEM_EE_SETTINGS; i++) {
        ASSERT(bytes[i] == 0xFF);
    }
    return 0;
}
